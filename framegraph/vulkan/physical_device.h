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

/// Properties of a device by which people and programs choose one.
struct PhysicalDevice {
  VkPhysicalDevice handle = VK_NULL_HANDLE;
  std::uint32_t index = 0;  ///< Argument of the option `--device`.
  std::string name;         ///< "AMD Radeon RX 7600".
  std::string driver;       ///< Driver and its version: "radv Mesa 22.3.6".
  VkPhysicalDeviceType type{};
  std::uint32_t apiVersion = 0;
  std::uint32_t maxImageSide = 0;            ///< Pixels: maxImageDimension2D.
  std::uint32_t computeQueueFamily = kNone;  ///< A family that also supports graphics if there is one.
  bool synchronization2 = false;             ///< As core feature of Vulkan 1.3 or as extension.
  bool maintenance4 = false;
  bool timelineSemaphore = false;  ///< As core feature of Vulkan 1.2 or as extension.
  bool shaderFloat16 = false;      ///< Likewise.
  VkPhysicalDeviceFeatures features{};
  std::vector<std::string> extensions;
  /// Features of optimally tiled images of a format.
  std::function<VkFormatFeatureFlags(VkFormat)> formatFeatures;

  [[nodiscard]] bool hasExtension(std::string_view name) const;
};

/// The properties of a host's device.
/// @param index the host's number for it
PhysicalDevice physicalDevice(const InstanceFunctions& functions, VkPhysicalDevice handle, std::uint32_t index = 0);

/// All devices of all drivers, in the loader's order.
/// @throws Unsupported if there is none
std::vector<PhysicalDevice> physicalDevices(const Instance& instance);

/// One line per device: index, name, driver, type and Vulkan version.
std::string listing(const std::vector<PhysicalDevice>& devices);

/// Choose a device.
/// @param choice an index or a part of a name, ignoring case; a number that is no index is a part of a name.
///        If empty, the best device is chosen: discrete before integrated before virtual before software; the first
///        among equals
/// @throws Unsupported with a message that names the choice and the available devices
const PhysicalDevice& choose(const std::vector<PhysicalDevice>& devices, std::string_view choice);

/// A use of a format that a device must support.
struct FormatUse {
  VkFormat format = VK_FORMAT_UNDEFINED;
  VkImageUsageFlags usage = 0;
  std::string resource;  ///< Resource with this format, for the error message.
  Extent extent{};       ///< Pixels of the resource.
};

/// Every use of a format in a plan, each with the extent of its resource.
std::vector<FormatUse> formatUses(const GraphDesc& graph, const Plan& plan);

/// What a device lacks, each with a remedy. Empty if it lacks nothing.
std::vector<std::string> missing(const PhysicalDevice& device, const std::vector<FormatUse>& formats = {});

/// @throws Unsupported with everything that `missing` finds
void require(const PhysicalDevice& device, const std::vector<FormatUse>& formats = {});

}  // namespace fg::vk
