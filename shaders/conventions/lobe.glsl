// The specular lobe of a pixel.
#ifndef WALR_LOBE_GLSL
#define WALR_LOBE_GLSL
#include "common/finite.glsl"

// Linear roughness as the host wrote it; NaN and infinity count as rough.
float validRoughness(float r) { return isFinite(r) ? clamp(r, 0.0, 1.0) : 1.0; }

const float kLeastDistance = 1e-3;  // Of what is reflected, over view depth.

// View depth over the distance of what is reflected. The largest half stands for all that is farther.
float nearnessOf(float distance, float z) {
  return distance < kLargestHalf ? z / max(distance, kLeastDistance * z) : 0.0;
}

// Half angle of the lobe about the mirror direction, radians. `r`: linear roughness.
float lobeAngle(float r) { return 2.0 * atan(r * r); }

#endif
