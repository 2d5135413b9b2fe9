#pragma once

#include <span>

#include "framegraph/vulkan/device_context.h"
#include "framegraph/vulkan/physical_device.h"
#include "framegraph/vulkan/unique_handle.h"

namespace fg::vk {

/// Whether shaders compute in halves that can (`Shader::inHalves`).
enum class HalfArithmetic {
  WhereFast,       ///< On GPUs with the feature shaderFloat16. Processors convert every value to and fro.
  WhereSupported,  ///< On every device with that feature.
  Never,
};

/// A logical device with one queue, for programs that have none of their own.
///
/// It enables synchronization2 and shaderStorageImageExtendedFormats, which are required. It also enables maintenance4,
/// timelineSemaphore, shaderStorageImageWriteWithoutFormat and shaderInt16 if the physical device has them, and
/// shaderFloat16 as `HalfArithmetic` says.
class Device {
 public:
  /// @param extensions to enable in addition, for instance VK_KHR_swapchain
  /// @param features   feature structs of those extensions to enable, as a chain for `VkDeviceCreateInfo::pNext`;
  ///                   optional
  /// @throws Unsupported with a message that names what the device lacks
  Device(const Instance& instance, const PhysicalDevice& physicalDevice, std::span<const char* const> extensions = {},
         const void* features = nullptr, HalfArithmetic halves = HalfArithmetic::WhereFast);
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  [[nodiscard]] const DeviceContext& context() const { return context_; }
  [[nodiscard]] VkQueue queue() const { return queue_; }

 private:
  /// Also destroyed if construction fails later.
  UniqueHandle<VkDevice, PFN_vkDestroyDevice> handle_;
  DeviceContext context_;
  VkQueue queue_ = VK_NULL_HANDLE;
};

}  // namespace fg::vk
