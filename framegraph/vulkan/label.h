#pragma once

#include "framegraph/vulkan/device_context.h"

namespace fg::vk {

/// A named region of a command buffer, for captures and validation messages. Does nothing without VK_EXT_debug_utils.
class Label {
 public:
  Label(const DeviceContext& device, VkCommandBuffer commandBuffer, const char* name)
      : device_(device), commandBuffer_(commandBuffer) {
    if (device_.instance.vkCmdBeginDebugUtilsLabelEXT == nullptr) return;
    VkDebugUtilsLabelEXT label{};
    label.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT;
    label.pLabelName = name;
    device_.instance.vkCmdBeginDebugUtilsLabelEXT(commandBuffer_, &label);
  }
  ~Label() {
    if (device_.instance.vkCmdEndDebugUtilsLabelEXT != nullptr) {
      device_.instance.vkCmdEndDebugUtilsLabelEXT(commandBuffer_);
    }
  }
  Label(const Label&) = delete;
  Label& operator=(const Label&) = delete;

 private:
  const DeviceContext& device_;
  VkCommandBuffer commandBuffer_;
};

}  // namespace fg::vk
