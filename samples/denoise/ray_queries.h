#pragma once

#include <array>
#include <string>

#include <vulkan/vulkan_core.h>

#include "framegraph/vulkan/functions.h"
#include "framegraph/vulkan/physical_device.h"

namespace walr {

/// The extensions that shaders with ray queries need, beside Vulkan 1.2.
inline constexpr std::array kRayQueryExtensions = {
    VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME, VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME,
    VK_KHR_RAY_QUERY_EXTENSION_NAME, VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME};

/// The features of those extensions, all of them on.
class RayQueryFeatures {
 public:
  RayQueryFeatures();
  RayQueryFeatures(const RayQueryFeatures&) = delete;
  RayQueryFeatures& operator=(const RayQueryFeatures&) = delete;

  /// For `fg::vk::Device`; valid as long as this.
  [[nodiscard]] void* chain() { return &addresses_; }
  /// Names of the features that are off, separated by commas.
  [[nodiscard]] std::string off() const;

 private:
  VkPhysicalDeviceBufferDeviceAddressFeatures addresses_{};
  VkPhysicalDeviceAccelerationStructureFeaturesKHR structures_{};
  VkPhysicalDeviceRayQueryFeaturesKHR queries_{};
};

/// What a device lacks to run shaders with ray queries, in words; empty if it lacks nothing.
std::string missingForRayQueries(const fg::vk::InstanceFunctions& functions, const fg::vk::PhysicalDevice& device);

}  // namespace walr
