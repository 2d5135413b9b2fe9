#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "passes/guides/prepare_guides.h"
#include "tests/passes/reference/frame.h"
#include "tests/passes/reference/storage.h"

namespace walr::reference {

/// The noise-free guides of one pixel.
struct Guide {
  double depth = 0.0;        ///< View depth; 0 where there is nothing to denoise.
  glm::dvec2 features{0.0};  ///< Octahedral map of the shading normal.
  glm::dvec3 normal{0.0};    ///< Geometric normal, which spans the plane of the edge-stopping function.
  std::uint32_t object = 0;  ///< The host's object number + 1; 0: none.
  double occlusion = 0.0;    ///< Ambient occlusion; 0 where it is not computed.
};

/// A geometric normal that a single-precision implementation may compute.
struct NormalCandidate {
  glm::dvec3 normal;
  double error = 0.0;  ///< Largest difference, in radians, that single-precision arithmetic may make.
};

/// The surface that a pixel shows (passes/GLOSSARY.md), without its geometric normal; depth 0 for sky, missing normals
/// and pixels without a diffuse lobe.
struct Surface {
  double depth = 0.0;
  glm::dvec3 shadingNormal{0.0};  ///< Unit, in view space, towards the camera.
};
Surface surfaceAt(const HostFrame& frame, glm::ivec2 p, const PrepareGuidesSettings& settings);

/// The geometric normal of a surface (passes/WALR.md, 1), from differences of positions. Along each axis it takes the
/// side whose two pixels extrapolate best to this one. Where neither side does along an axis, the plane has the slope
/// of the shading normal's plane along this axis. The first entry is the exact answer. Further ones follow where a
/// decision (which side, whether the shading normal agrees) is closer than single precision can resolve.
std::vector<NormalCandidate> geometricNormals(const HostFrame& frame, glm::ivec2 p, const Surface& surface,
                                              const PrepareGuidesSettings& settings);

/// Horizon-based ambient occlusion (passes/WALR.md, 1; Bavoil et al. 2008): the mean over eight directions of the sine
/// of the horizon above the surface's tangent plane. Every pixel with a depth occludes, with a weight that falls to 0
/// at the radius.
double ambientOcclusion(const HostFrame& frame, glm::ivec2 p, const Surface& surface,
                        const AmbientOcclusionSettings& settings);

/// Guides of a frame (passes/WALR.md, 1).
/// @param occlusion given for filters over blocks: adds ambient occlusion; with `Storage::Quantised` the features are
///                  then rounded to 12 bits and the geometric normal to a short one
Image<Guide> prepareGuides(const HostFrame& frame, Storage storage, const PrepareGuidesSettings& settings = {},
                           const std::optional<AmbientOcclusionSettings>& occlusion = {});

}  // namespace walr::reference
