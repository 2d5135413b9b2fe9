#pragma once

#include <cstdint>
#include <string>

#include <vulkan/vulkan_core.h>

#include "framegraph/vulkan/functions.h"
#include "framegraph/vulkan/memory_source.h"

namespace fg::vk {

/// A host's Vulkan device. The handles remain the host's, and must outlive everything that is created from them.
///
/// The device must have been created with the synchronization2 feature (Vulkan 1.3, or VK_KHR_synchronization2).
struct DeviceView {
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;
  std::uint32_t queueFamily = 0;  ///< Family of the queue to which frames are submitted; must support compute.
  const VkAllocationCallbacks* allocator = nullptr;  ///< For memory of the processor; optional.
  MemorySource* memorySource = nullptr;              ///< For device memory; optional.
  /// The device was created with the feature shaderFloat16, and shaders may compute in halves (`Shader::inHalves`).
  bool shaderFloat16 = false;
};

/// A device with its functions and those of its properties that are needed often. Loaded once.
struct DeviceContext {
  DeviceContext() = default;
  /// @throws Unsupported with a message that names a missing Vulkan function
  explicit DeviceContext(const DeviceView& deviceView);

  /// Name a Vulkan object for validation messages and captures. Does nothing without VK_EXT_debug_utils.
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
  std::uint32_t timestampBits = 0;  ///< Valid bits of a timestamp on the queue family; 0 if it has no timestamps.
};

}  // namespace fg::vk
