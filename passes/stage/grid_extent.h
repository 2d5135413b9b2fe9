#pragma once

#include <cstdint>

#include "framegraph/declare/graph.h"

namespace walr {

/// Extent of the grid whose square cells, of `size` pixels a side, cover an image.
inline fg::Extent gridExtent(fg::Extent pixels, std::uint32_t size) {
  return {(pixels.width + size - 1) / size, (pixels.height + size - 1) / size};
}

/// The least `maxStorageBufferRange` that Vulkan guarantees: bytes of the largest buffer that every device takes.
constexpr std::uint64_t kLargestBuffer = std::uint64_t{1} << 27;

}  // namespace walr
