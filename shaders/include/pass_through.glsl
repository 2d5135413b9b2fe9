// Light of a pixel without a surface, which passes through as it is but for what is not finite.
#ifndef WALR_PASS_THROUGH_GLSL
#define WALR_PASS_THROUGH_GLSL
#include "finite.glsl"

vec3 passThroughLight(vec3 light) { return isFinite(light) ? light : vec3(0.0); }
vec3 passThroughLight(texture2D light, ivec2 q) { return passThroughLight(texelFetch(light, q, 0).rgb); }

#endif
