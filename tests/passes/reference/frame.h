#pragma once

#include <cmath>
#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "passes/conventions/inputs.h"
#include "shaders/conventions/frame.h"
#include "tests/passes/reference/image.h"

namespace walr::reference {

/// The input of one frame as a host provides it, with the values that its textures hold.
struct HostFrame {
  Image<glm::dvec3> lighting;  ///< Demodulated radiance; may hold NaN and infinity.
  Image<double> depth;         ///< Linear view depth.
  Image<glm::dvec3> normal;
  Image<glm::dvec3> motion;
  Image<glm::dvec3> albedo;
  Image<std::uint32_t> objectId;     ///< May be empty; 0xffffffff: none.
  Image<double> lightAlpha;          ///< Alpha of the light where it is read; may be empty: 1.
  Image<double> roughness;           ///< Of specular light, in steps of 1/255; else empty.
  Image<glm::dvec3> specularMotion;  ///< Of what specular light comes from, world space; may be empty: still.
  FrameConstants constants{};
  InputConventions conventions;
  SceneDescription scene;
  [[nodiscard]] glm::ivec2 size() const { return depth.size(); }
};

/// Whether every component is a number.
inline bool isFinite(glm::dvec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Whether a texel of the lighting belongs to a pixel (walr.h, WalrConventions::light_group).
inline bool hasLightTexel(const HostFrame& frame, glm::ivec2 p) {
  const LightPattern& light = frame.conventions.light;
  const int columns = static_cast<int>(light.columns);
  const int rows = static_cast<int>(light.rows);
  const int shift = rows == 1 ? p.y : 0;
  return p.x % columns == (frame.constants.lightOffset.x + shift) % columns &&
         p.y % rows == frame.constants.lightOffset.y;
}

/// Whether that texel is a sample (WalrConventions::light_masked).
inline bool hasSample(const HostFrame& frame, glm::ivec2 p) {
  const bool masked = frame.conventions.light.hasAlpha() && !frame.lightAlpha.pixels().empty();
  return hasLightTexel(frame, p) && (!masked || frame.lightAlpha[p] > 0.0);
}

/// Number of samples whose mean that texel is (WalrConventions::light_counted).
inline double sampleCount(const HostFrame& frame, glm::ivec2 p) {
  if (!hasSample(frame, p)) return 0.0;
  return frame.conventions.light.counted && !frame.lightAlpha.pixels().empty() ? frame.lightAlpha[p] : 1.0;
}

/// Position of the pixel's centre, pixels.
inline glm::dvec2 pixelCentre(glm::ivec2 p) {
  return glm::dvec2(p) + 0.5;
}

/// View-space ray through a pixel position; its product with the view depth is the position.
inline glm::dvec3 rayThrough(const glm::vec4& rayFromPixel, glm::dvec2 pixel) {
  const glm::dvec4 r(rayFromPixel);
  return {pixel.x * r.x + r.z, pixel.y * r.y + r.w, -1.0};
}

}  // namespace walr::reference
