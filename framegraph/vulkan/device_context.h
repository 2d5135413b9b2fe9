#pragma once

#include <cstdint>
#include <string>

#include <vulkan/vulkan_core.h>

#include "framegraph/vulkan/functions.h"

namespace fg::vk {

/// A device as its owner hands it over. Nothing here is owned, and all of it must outlive what is made from it.
///
/// The device must have been created with the synchronization2 feature (Vulkan 1.3, or VK_KHR_synchronization2).
struct DeviceView {
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;
  std::uint32_t queueFamily = 0;  ///< Family of the queue that recorded frames are submitted to; must do compute.
  const VkAllocationCallbacks* allocator = nullptr;  ///< Optional.
};

/// A device's functions and what is asked of it again and again, loaded once.
struct DeviceContext {
  DeviceContext() = default;
  /// @throws Unsupported naming a Vulkan function that is missing
  explicit DeviceContext(const DeviceView& deviceView);

  /// Give a Vulkan object a name for validation messages and captures; nothing happens without VK_EXT_debug_utils.
  template <typename Handle>
  void setName(VkObjectType type, Handle handle, const std::string& name) const {
    setName(type, reinterpret_cast<std::uint64_t>(handle), name);
  }
  void setName(VkObjectType type, std::uint64_t handle, const std::string& name) const;

  DeviceView view;
  InstanceFunctions instance;
  DeviceFunctions functions;
  VkPhysicalDeviceProperties properties{};
  VkPhysicalDeviceMemoryProperties memory{};
  std::uint32_t timestampBits = 0;  ///< Valid bits of a timestamp on the queue family; 0 where it has none.
};

}  // namespace fg::vk
