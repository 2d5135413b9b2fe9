#pragma once

#include "tests/passes/reference/guides.h"

namespace walr::reference {

/// What tells of the lobe of specular light at a pixel.
struct Reflector {
  double roughness = 0.0;
  double inverseDistance = 0.0;  ///< The surface's depth over the distance of what it reflects; 0: infinitely far.
};

/// The means over lobes of passes/SPECULAR.md, without antilag.
/// @param accumulated rgb: radiance; a: history length
/// @param lighting    this frame's; a: 0 where there is no sample
/// @param maxHistory  frames: the longest history in motion
Image<glm::dvec3> lobeFilter(const HostFrame& frame, const Image<Guide>& guides, const Image<Reflector>& reflectors,
                             const Image<glm::dvec4>& accumulated, const Image<glm::dvec4>& lighting,
                             double maxHistory);

}  // namespace walr::reference
