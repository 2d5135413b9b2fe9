#pragma once

#include <cstdint>
#include <optional>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "framegraph/declare/graph.h"
#include "shaders/conventions/frame.h"

namespace walr {

/// One frame's camera and the host's motion convention, as the host knows them.
struct FrameDescription {
  glm::mat4 view{1.0F};                ///< World to view space; right-handed, the camera looks down -Z.
  glm::mat4 previousView{1.0F};        ///< The previous frame's.
  glm::mat4 projection{1.0F};          ///< View to clip space without jitter, x right, y up (OpenGL); z is not used.
  glm::mat4 previousProjection{1.0F};  ///< The previous frame's.
  glm::vec2 jitter{0.0F};              ///< Pixels, y down: sample position minus pixel centre.
  glm::vec2 previousJitter{0.0F};      ///< The previous frame's.
  /// Multiplies the motion texture's xy; the result must be pixels, previous = current + motion, x right, y down.
  glm::vec2 motionScale{1.0F};
  /// Counts frames from any start. It seeds random choices and the stochastic rounding of packed light, which is exact
  /// on average only if the index changes every frame.
  std::uint32_t frameIndex = 0;
  /// Size of the previous frame if it differs from this one's. Motion is in pixels of this frame even then; each jitter
  /// is in pixels of its own frame.
  std::optional<fg::Extent> previousExtent = std::nullopt;
  /// The position in the world, scene units, that `view` is relative to, and that of the previous frame. In large
  /// worlds it lies near the camera and moves with it, so that single-precision matrices are exact enough.
  glm::dvec3 origin{0.0};
  glm::dvec3 previousOrigin{0.0};
  float skyDepth = 1e9F;  ///< Scene units: a linear view depth from here on is sky.
  /// With sparse light, the pixel of its group that a texel of light belongs to: see `LightPattern`. Pixels, y down.
  glm::ivec2 lightOffset{0};
  glm::ivec2 previousLightOffset{0};  ///< The previous frame's.
  /// Both projections are orthographic, and the depth texture is converted: see `HostConventions::orthographic`.
  bool orthographic = false;
};

/// The uniform block that the passes read, computed in double precision.
/// @param extent the image's size
/// @throws std::invalid_argument as `checkView`, `checkProjection` and `checkOrigin` do (camera_check.h), for jitter or
///         `motionScale` that are not finite, a `skyDepth` that is not above 0, and a `previousExtent` without pixels
FrameConstants frameConstants(const FrameDescription& frame, fg::Extent extent);

}  // namespace walr
