// Light of a pixel without a surface, which passes through as it is but for what is not finite.
#ifndef WALR_PASSED_LIGHT_GLSL
#define WALR_PASSED_LIGHT_GLSL
#include "finite.glsl"

vec3 passedLight(vec3 light) { return isFinite(light) ? light : vec3(0.0); }
vec3 passedLight(texture2D from, ivec2 q) { return passedLight(texelFetch(from, q, 0).rgb); }

#endif
