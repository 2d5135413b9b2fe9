#pragma once

#include <cstdint>

#include "framegraph/declare/graph.h"

namespace walr {

/// Extent of the grid whose square cells, of `size` pixels a side, cover an image.
inline fg::Extent gridExtent(fg::Extent pixels, std::uint32_t size) {
  return {(pixels.width + size - 1) / size, (pixels.height + size - 1) / size};
}

}  // namespace walr
