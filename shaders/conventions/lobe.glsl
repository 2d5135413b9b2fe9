// The specular lobe of a pixel.
#ifndef WALR_LOBE_GLSL
#define WALR_LOBE_GLSL
#include "common/finite.glsl"

// Linear roughness as the host wrote it; NaN and infinity count as rough.
float validRoughness(float r) { return isFinite(r) ? clamp(r, 0.0, 1.0) : 1.0; }

// Half angle of the lobe about the mirror direction, radians. `r`: linear roughness.
float lobeAngle(float r) { return 2.0 * atan(r * r); }

#endif
