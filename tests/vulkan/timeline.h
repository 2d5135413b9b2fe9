#pragma once

#include <cstdint>
#include <limits>

#include "framegraph/vulkan/device_context.h"
#include "framegraph/vulkan/error.h"
#include "framegraph/vulkan/timeline_point.h"

namespace fg::test {

/// A timeline semaphore that starts at 0.
class Timeline {
 public:
  explicit Timeline(const vk::DeviceContext& device) : device_(&device) {
    VkSemaphoreTypeCreateInfo type{};
    type.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO;
    type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
    VkSemaphoreCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
    info.pNext = &type;
    vk::check(function<PFN_vkCreateSemaphore>("vkCreateSemaphore")(device.view.device, &info, nullptr, &semaphore_),
              "creating a timeline semaphore");
  }
  Timeline(const Timeline&) = delete;
  Timeline& operator=(const Timeline&) = delete;
  /// The GPU must have finished what uses it.
  ~Timeline() { function<PFN_vkDestroySemaphore>("vkDestroySemaphore")(device_->view.device, semaphore_, nullptr); }

  [[nodiscard]] vk::TimelinePoint at(std::uint64_t value) const { return {semaphore_, value}; }
  [[nodiscard]] std::uint64_t value() const {
    std::uint64_t value = 0;
    vk::check(device_->functions.vkGetSemaphoreCounterValue(device_->view.device, semaphore_, &value), "reading");
    return value;
  }
  void signal(std::uint64_t value) const {
    VkSemaphoreSignalInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SIGNAL_INFO;
    info.semaphore = semaphore_;
    info.value = value;
    vk::check(function<PFN_vkSignalSemaphore>("vkSignalSemaphore")(device_->view.device, &info), "signalling");
  }
  void wait(std::uint64_t value) const {
    VkSemaphoreWaitInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO;
    info.semaphoreCount = 1;
    info.pSemaphores = &semaphore_;
    info.pValues = &value;
    vk::check(function<PFN_vkWaitSemaphores>("vkWaitSemaphores")(device_->view.device, &info,
                                                                 std::numeric_limits<std::uint64_t>::max()),
              "waiting");
  }

 private:
  template <typename Function>
  [[nodiscard]] Function function(const char* name) const {
    return reinterpret_cast<Function>(device_->instance.vkGetDeviceProcAddr(device_->view.device, name));
  }

  const vk::DeviceContext* device_;
  VkSemaphore semaphore_ = VK_NULL_HANDLE;
};

}  // namespace fg::test
