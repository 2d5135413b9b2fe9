// Shared by the passes of SVGF: how colour and variance are stored, and the edge-stopping functions W_Z and W_N, which
// need no colour (Fu 2022).
// Needs: `frame` (FrameConstants), `constants` (SvgfFilterConstants).
#ifndef WALR_SVGF_GLSL
#define WALR_SVGF_GLSL
#include "common/natural_exponent.glsl"
#include "conventions/plane.glsl"
#include "conventions/surface.glsl"

// Alpha holds the standard deviation of luminance: the variance would overflow a half from 256 on. Below 0 the pixel
// has no sample yet: its neighbours do not use it, and it takes its value from them.
const float kNoSample = -1.0;

// The pixel at which W_Z and W_N are 1. Let the pixel `d` away show depth z. The distance of that point from the
// tangent plane is |z (perDepth + dot(slope, d)) - offset|, in the unit of distance over which W_Z falls by half.
struct Surface {
  vec3 normal;  // Shading normal.
  float offset;
  float perDepth;
  vec2 slope;  // The rays of evenly spaced pixels are evenly spaced.
};

Surface surfaceOf(ivec2 p, float z, vec3 geometricNormal, vec3 shadingNormal) {
  const Plane plane = planeAt(p, z, geometricNormal);
  const float scale = constants.inverseSigmaDepth * kLog2OfE;
  const float offset = plane.offset * scale;
  return Surface(shadingNormal, offset, offset * plane.inverseDepth,
                 geometricNormal.xy * frame.rayFromPixel.xy * (plane.inverseDepth * scale));
}

// -log2(W_Z) of the pixel `d` away: the distance from the tangent plane, which is the difference in depth beyond the
// depth gradient. W_Z is 1 everywhere on a plane.
float distanceFrom(Surface surface, vec2 d, float z) {
  return abs(z * (surface.perDepth + surface.slope.y * d.y + surface.slope.x * d.x) - surface.offset);
}

// log2(W_Z W_N). As sums of exponents, all weights of a tap take one exponential.
float surfaceExponent(Surface surface, vec2 d, float z, vec3 normal) {
  const float distance = distanceFrom(surface, d, z);
  const float cosine = clamp(dot(surface.normal, normal), 1e-6, 1.0);
  return constants.sigmaNormal * log2(cosine) - distance;
}

#endif
