// The edge-stopping function between pixels (Meunier & Harada 2022, 4.3).
// Needs: `frame` (FrameConstants), `depth` (utexture2D), `constants` (with planeNear and planeFar).
#ifndef WALR_EDGE_WEIGHT_GLSL
#define WALR_EDGE_WEIGHT_GLSL
#include "conventions/plane.glsl"
#include "conventions/surface.glsl"

// 1 up to planeNear, 0 from planeFar on and where there is no surface, linear between.
float edgeWeight(Plane plane, ivec2 q, uint packedDepth) {
  const float z = unpackDepth(packedDepth);
  if (z == 0.0) return 0.0;
  return clamp(
      (constants.planeFar - planeDistance(plane, q, z)) / (constants.planeFar - constants.planeNear), 0.0, 1.0);
}

#endif
