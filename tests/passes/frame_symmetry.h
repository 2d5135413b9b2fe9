#pragma once

#include "tests/passes/reference/frame.h"

/// Symmetries of the image, applied to whole frames. The denoised image must follow them.
namespace walr::test {

/// A mirroring of the image and of the directions in it.
struct Symmetry {
  const char* name;
  bool flipX = false;
  bool flipY = false;
  bool transpose = false;  ///< Applied after the flips.
};

/// The position to which a symmetry moves pixel `p` of an image of this size.
glm::ivec2 mapPixel(const Symmetry& symmetry, glm::ivec2 p, glm::ivec2 size);

template <typename T>
reference::Image<T> mapImage(const Symmetry& symmetry, const reference::Image<T>& image) {
  const glm::ivec2 size = image.size();
  reference::Image<T> mapped(symmetry.transpose ? glm::ivec2(size.y, size.x) : size);
  reference::forEachPixel(size, [&](glm::ivec2 p) { mapped[mapPixel(symmetry, p, size)] = image[p]; });
  return mapped;
}

/// The frame of the mirrored world. The camera's axis must go through the middle of the image.
reference::HostFrame mapFrame(const Symmetry& symmetry, const reference::HostFrame& frame);

}  // namespace walr::test
