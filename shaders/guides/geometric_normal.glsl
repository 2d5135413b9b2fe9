// The geometric normal of a pixel, from inverse depths of its neighbours (passes/WALR.md, 1).
// Needs: `frame`, `guideConstants`, `Surface`.
#ifndef WALR_GEOMETRIC_NORMAL_GLSL
#define WALR_GEOMETRIC_NORMAL_GLSL

#include "guides/inverse_depth_tile.glsl"

// How relative inverse depth changes from a pixel to the next along an axis.
struct Slope {
  float value;
  bool found;  // Whether a side shows the pixel's surface.
};

// The slope along an axis at whose pixels `stride` inverse depths lie apart. It takes the side whose two pixels
// extrapolate better to this one: across an edge the extrapolation fails. On an object one pixel wide it fails on both
// sides, perhaps by the same amount.
Slope slopeOfInverseDepth(float z, int stride) {
  const uint centre = inverseDepthIndex(gl_LocalInvocationID.xy + 2u);
  float bestError = guideConstants.tangentTolerance;
  Slope slope = Slope(0.0, false);
  [[unroll]] for (int side = -1; side <= 1; side += 2) {
    const float near = z * sharedInverseDepth[centre + side * stride];
    const float far = z * sharedInverseDepth[centre + 2 * side * stride];
    const float error = abs(2.0 * near - far - 1.0);
    if (near > 0.0 && error <= bestError) {
      bestError = error;
      slope = Slope(float(side) * (near - 1.0), true);
    }
  }
  return slope;
}

// The normal of the visible surface, without normal mapping; not normalised. On a plane, n . ray is proportional to
// inverse depth, so that the slopes of inverse depth are proportional to n.x and n.y. Where depth does not determine a
// slope, on an object one pixel wide, it is that of the plane of the shading normal.
vec3 geometricNormalOf(Surface surface) {
  const Slope alongX = slopeOfInverseDepth(surface.depth, 1);
  const Slope alongY = slopeOfInverseDepth(surface.depth, int(kInverseDepthRow));
  const vec2 scale = surface.facing * frame.pixelFromRay;
  const float x = alongX.found ? alongX.value * scale.x : surface.normal.x;
  const float y = alongY.found ? alongY.value * scale.y : surface.normal.y;
  const vec3 n = vec3(x, y, x * surface.ray.x + y * surface.ray.y - surface.facing);
  const float lengthSquared = dot(n, n);
  const bool agrees = dot(n, surface.normal) * inversesqrt(lengthSquared) >= guideConstants.normalAgreement;
  return lengthSquared > 0.0 && agrees ? n : surface.normal;
}

#endif
