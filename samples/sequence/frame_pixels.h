#pragma once

#include <cmath>
#include <cstddef>

#include <glm/vec3.hpp>

#include "samples/sequence/frame.h"

/// Pixels of a frame's images, for its linters.
namespace walr {

inline glm::vec3 vectorAt(const Image& image, std::size_t pixel) {
  return {image.pixel(pixel)[0], image.pixel(pixel)[1], image.pixel(pixel)[2]};
}

inline bool isFinite(const glm::vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

inline bool isSurface(const Frame& frame, std::size_t pixel) {
  const float depth = frame.depth.pixel(pixel)[0];
  return depth > 0.0F && depth < kSkyDepth;
}

}  // namespace walr
