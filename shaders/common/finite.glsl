// Tests on bit patterns: a compiler may assume that arithmetic never meets NaN or infinity.
#ifndef WALR_FINITE_GLSL
#define WALR_FINITE_GLSL

bool isFinite(float x) { return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u; }
bool isFinite(vec2 v) { return isFinite(v.x) && isFinite(v.y); }
bool isFinite(vec3 v) { return isFinite(v.x) && isFinite(v.y) && isFinite(v.z); }

// Largest finite half; anything above would become infinity in an RGBA16F texture.
const float kLargestHalf = 65504.0;

// Light within what halves hold, and not below 0.
vec3 clampedRadiance(vec3 light) { return clamp(light, vec3(0.0), vec3(kLargestHalf)); }

#endif
