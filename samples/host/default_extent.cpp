#include "samples/host/default_extent.h"

namespace walr::host {

fg::Extent defaultExtent(bool window, VkPhysicalDeviceType device) {
  constexpr fg::Extent kSmall{640, 360};
  constexpr fg::Extent kLarge{1920, 1080};
  const bool gpu = device == VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU || device == VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU;
  return window && gpu ? kLarge : kSmall;
}

}  // namespace walr::host
