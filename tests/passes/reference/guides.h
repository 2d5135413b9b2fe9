#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "passes/prepare_guides.h"
#include "tests/passes/reference/frame.h"
#include "tests/passes/reference/storage.h"

namespace walr::reference {

/// The noise-free guides of one pixel.
struct Guide {
  double depth = 0.0;        ///< View depth; 0 where there is nothing to denoise.
  glm::dvec2 features{0.0};  ///< Octahedral map of the shading normal.
  glm::dvec3 normal{0.0};    ///< Geometric normal, which spans the plane of the edge-stopping function.
  std::uint32_t object = 0;  ///< The host's number + 1; 0: none.
  double occlusion = 0.0;    ///< Ambient occlusion; 0 where it is not asked for.
};

/// A geometric normal that an implementation may arrive at.
struct NormalCandidate {
  glm::dvec3 normal;
  double error = 0.0;  ///< Largest difference, in radians, that single-precision arithmetic may make.
};

/// The pixel's surface, without geometric normal; depth 0 for sky, missing normals and pixels without a diffuse lobe.
struct Surface {
  double depth = 0.0;
  glm::dvec3 shadingNormal{0.0};  ///< Unit, in view space, towards the camera.
};
Surface surfaceAt(const HostFrame& frame, glm::ivec2 p, const PrepareGuidesSettings& settings);

/// The geometric normal of a surface: from differences of positions, along each axis on the side whose pixels
/// extrapolate best to this one. Where they miss it on both, the shading normal made perpendicular to the other
/// tangent. The first entry is the exact answer; further ones follow where a decision on the way (which side, whether
/// the shading normal agrees) is closer than single precision can tell.
std::vector<NormalCandidate> geometricNormals(const HostFrame& frame, glm::ivec2 p, const Surface& surface,
                                              const PrepareGuidesSettings& settings);

/// Mean sine of the horizon above a surface's tangent plane in eight directions, with occluders, all that the host's
/// depth shows, fading out at the radius and looked for in so many steps.
double ambientOcclusion(const HostFrame& frame, glm::ivec2 p, const Surface& surface,
                        const AmbientOcclusionSettings& settings);

/// The conversion of the host's G-buffer.
/// @param occlusion where given, ambient occlusion is there, the shading normal kept as it is beside it, and the
///                  geometric normal short
Image<Guide> prepareGuides(const HostFrame& frame, Storage storage, const PrepareGuidesSettings& settings = {},
                           const std::optional<AmbientOcclusionSettings>& occlusion = {});

}  // namespace walr::reference
