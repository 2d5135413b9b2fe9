// Which texels of a spatial filter's light hold samples, and how many.
// Needs: `kAlphaIsSampleCount`: whether alpha is a number of samples; if not, each finite colour is one sample.
#ifndef WALR_SAMPLED_LIGHT_GLSL
#define WALR_SAMPLED_LIGHT_GLSL
#include "common/finite.glsl"

bool isSampled(vec4 light) { return isFinite(light.rgb) && (!kAlphaIsSampleCount || light.a > 0.0); }
float samplesOf(vec4 light) { return isSampled(light) ? (kAlphaIsSampleCount ? light.a : 1.0) : 0.0; }

#endif
