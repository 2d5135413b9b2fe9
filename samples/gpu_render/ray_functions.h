#pragma once

#include <vulkan/vulkan_core.h>

#include "framegraph/vulkan/device_context.h"

namespace walr::gpu_render {

/// The Vulkan functions of acceleration structures and push descriptors.
struct RayFunctions {
  PFN_vkGetBufferDeviceAddress vkGetBufferDeviceAddress = nullptr;
  PFN_vkCreateAccelerationStructureKHR vkCreateAccelerationStructureKHR = nullptr;
  PFN_vkDestroyAccelerationStructureKHR vkDestroyAccelerationStructureKHR = nullptr;
  PFN_vkGetAccelerationStructureBuildSizesKHR vkGetAccelerationStructureBuildSizesKHR = nullptr;
  PFN_vkGetAccelerationStructureDeviceAddressKHR vkGetAccelerationStructureDeviceAddressKHR = nullptr;
  PFN_vkCmdBuildAccelerationStructuresKHR vkCmdBuildAccelerationStructuresKHR = nullptr;
  PFN_vkCmdPushDescriptorSetKHR vkCmdPushDescriptorSetKHR = nullptr;

  /// @param device  with `GpuDevice::Options::rayQueries`
  /// @throws fg::vk::Unsupported naming the first missing function
  static RayFunctions load(const fg::vk::DeviceContext& device);
};

}  // namespace walr::gpu_render
