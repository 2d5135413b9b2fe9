// Numbers from 10^-21 to 10^14, with their signs, as halves: their cube roots. Those from 10^-12 on err by 1.5 x 2^-10 at most, smaller ones by more.
#ifndef WALR_CUBE_ROOTS_GLSL
#define WALR_CUBE_ROOTS_GLSL
#include "common/half.glsl"

vec4 cubeRoots(vec4 x) { return nearestHalf(sign(x) * pow(abs(x), vec4(1.0 / 3.0))); }
vec4 cubes(vec4 roots) { return roots * roots * roots; }

#endif
