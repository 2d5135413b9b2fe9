#pragma once

#include "tests/passes/reference/frame.h"

/// The symmetries of a picture, applied to whole frames: the denoised picture must follow.
namespace walr::test {

/// A mirror of the picture, and of the directions in it.
struct Symmetry {
  const char* name;
  bool flipX = false;
  bool flipY = false;
  bool transpose = false;  ///< After the flips.
};

/// Where pixel `p` of a picture of this size goes.
glm::ivec2 mapPixel(const Symmetry& symmetry, glm::ivec2 p, glm::ivec2 size);

template <typename T>
reference::Image<T> mapImage(const Symmetry& symmetry, const reference::Image<T>& image) {
  const glm::ivec2 size = image.size();
  reference::Image<T> mapped(symmetry.transpose ? glm::ivec2(size.y, size.x) : size);
  reference::forEachPixel(size, [&](glm::ivec2 p) { mapped[mapPixel(symmetry, p, size)] = image[p]; });
  return mapped;
}

/// The frame as its mirrored world would show it. The camera's axis must go through the middle of the picture.
reference::HostFrame mapFrame(const Symmetry& symmetry, const reference::HostFrame& frame);

}  // namespace walr::test
