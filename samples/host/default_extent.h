#pragma once

#include <vulkan/vulkan_core.h>

#include "framegraph/declare/graph.h"

namespace walr::host {

/// Size of the picture if the user chooses none: 1920 x 1080 in a window on a discrete or integrated GPU, otherwise
/// 640 x 360, which a software driver can show in motion.
fg::Extent defaultExtent(bool window, VkPhysicalDeviceType device);

}  // namespace walr::host
