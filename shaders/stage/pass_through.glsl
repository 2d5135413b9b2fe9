// Pass-through: the light of a pixel without a surface. It is not changed, except that values that are not finite
// become 0.
#ifndef WALR_PASS_THROUGH_GLSL
#define WALR_PASS_THROUGH_GLSL
#include "common/finite.glsl"

vec3 passThroughLight(vec3 light) { return isFinite(light) ? light : vec3(0.0); }
vec3 passThroughLight(texture2D light, ivec2 q) { return passThroughLight(texelFetch(light, q, 0).rgb); }

// Of specular light, whose alpha is 0 where there is no sample.
vec3 passThroughSpecular(vec4 light) { return light.a > 0.0 ? passThroughLight(light.rgb) : vec3(0.0); }

#endif
