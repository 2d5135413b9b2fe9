// The specular lobe of a pixel.
#ifndef WALR_LOBE_GLSL
#define WALR_LOBE_GLSL
#include "common/finite.glsl"

// Linear roughness as the host wrote it; NaN and infinity count as rough.
float validRoughness(float r) { return isFinite(r) ? clamp(r, 0.0, 1.0) : 1.0; }

const float kMirrorUpTo = 0.05;     // Roughness up to which a pixel shows one image (passes/SPECULAR.md).
const float kLeastNearness = 1e-3;  // Depth over the distance of what is reflected; what is farther is far away.
const float kLeastDistance = 1e-3;  // Of what is reflected, over view depth.

// One over the distance of what is reflected, which is above 0. The largest half stands for all that is farther.
float inverseDistance(float distance) { return distance < kLargestHalf ? 1.0 / distance : 0.0; }

// View depth over the distance of what is reflected.
float nearnessOf(float inverse, float z) { return min(inverse * z, 1.0 / kLeastDistance); }

// Half angle of the lobe about the mirror direction, radians. `r`: linear roughness.
float lobeAngle(float r) { return 2.0 * atan(r * r); }

#endif
