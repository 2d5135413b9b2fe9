#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "framegraph/declare/graph.h"
#include "framegraph/plan/plan.h"
#include "framegraph/vulkan/instance.h"

namespace fg::vk {

/// What people and programs want to know about a device before they choose it.
struct PhysicalDevice {
  VkPhysicalDevice handle = VK_NULL_HANDLE;
  std::uint32_t index = 0;  ///< As `--device` takes it.
  std::string name;         ///< "AMD Radeon RX 7600".
  std::string driver;       ///< Driver and its version: "radv Mesa 22.3.6".
  VkPhysicalDeviceType type{};
  std::uint32_t apiVersion = 0;
  std::uint32_t computeQueueFamily = kNone;  ///< A graphics family where there is one that also does compute.
  bool synchronization2 = false;             ///< As core feature of Vulkan 1.3 or as extension.
  bool maintenance4 = false;
  VkPhysicalDeviceFeatures features{};
  std::vector<std::string> extensions;
  /// Features of optimally tiled images.
  std::function<VkFormatFeatureFlags(VkFormat)> formatFeatures;
};

/// What a host's device is and can do.
/// @param index as its owner numbers it
PhysicalDevice physicalDevice(const InstanceFunctions& functions, VkPhysicalDevice handle, std::uint32_t index = 0);

/// All devices of all drivers, in the loader's order.
/// @throws Unsupported where there is none
std::vector<PhysicalDevice> physicalDevices(const Instance& instance);

/// One line a device: index, name, driver, type and Vulkan version.
std::string listing(const std::vector<PhysicalDevice>& devices);

/// Choose a device.
/// @param choice an index, a part of a name (case does not matter), or nothing for the best: discrete before integrated
///        before virtual before software, among equals the first
/// @throws Unsupported naming the choice and what there is
const PhysicalDevice& choose(const std::vector<PhysicalDevice>& devices, std::string_view choice);

/// A use of a format that a device must offer.
struct FormatUse {
  VkFormat format = VK_FORMAT_UNDEFINED;
  VkImageUsageFlags usage = 0;
  std::string resource;  ///< Whose format it is, for the error's text.
};

/// Every use of a format in a plan.
std::vector<FormatUse> formatUses(const GraphDesc& graph, const Plan& plan);

/// What a device lacks, each with the way out; empty for a device that will do.
std::vector<std::string> missing(const PhysicalDevice& device, const std::vector<FormatUse>& formats = {});

/// @throws Unsupported with everything that `missing` finds
void require(const PhysicalDevice& device, const std::vector<FormatUse>& formats = {});

}  // namespace fg::vk
