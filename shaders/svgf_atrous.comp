// SVGF, one edge-avoiding a-trous iteration (Schied et al. 2017, 4.3 and 4.4; Fu 2022): a binomial kernel with taps 2^i
// pixels apart, weighted by plane distance (W_Z), normal (W_N) and luminance (W_L). It also filters the variance that
// guides W_L. With a Gaussian kernel in place of the binomial one it is the bilateral filter that the iterations
// approximate.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "constants/frame.h"
#include "constants/svgf_filter.h"
#include "include/half.glsl"
#include "include/luminance.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const int kRadius = 2;    // Taps on each side of the centre.
layout(constant_id = 1) const int kSpacing = 1;   // 2^i pixels.
layout(constant_id = 2) const bool kLuminanceWeight = true;
layout(constant_id = 3) const float kGaussianFalloff = 0.0;  // exp(-falloff d^2), d in pixels; 0: binomial.

layout(std140) uniform frameConstants { FrameConstants frame; };
uniform utexture2D depth;
uniform utexture2D shadingNormal;
uniform utexture2D geometricNormal;
uniform texture2D colour;  // rgb: radiance; a: standard deviation of its luminance.
layout(rgba16f) uniform writeonly image2D outColour;
layout(push_constant) uniform PushConstants { SvgfFilterConstants constants; };

#include "include/svgf.glsl"

// Standard deviation at `p` from the variance smoothed by a 3 x 3 Gaussian over the pixels that have one.
float smoothDeviation(ivec2 p) {
  const ivec2 last = textureSize(colour, 0) - 1;
  float sum = 0.0, weightSum = 0.0;
  for (int i = 0; i < 9; ++i) {
    const ivec2 offset = ivec2(i % 3, i / 3) - 1;
    const ivec2 q = clamp(p + offset, ivec2(0), last);
    const float deviation = texelFetch(colour, q, 0).a;
    if (deviation < 0.0 || unpackDepth(texelFetch(depth, q, 0).x) == 0.0) continue;
    const float weight = (offset.x == 0 ? 0.5 : 0.25) * (offset.y == 0 ? 0.5 : 0.25);
    sum += weight * deviation * deviation;
    weightSum += weight;
  }
  return sqrt(sum / weightSum);
}

// The falloff in W_L = exp(-|l_p - l_q| * falloff); 0 gives all luminances the same weight.
float luminanceFalloff(ivec2 p, vec4 centre) {
  if (!kLuminanceWeight || centre.a < 0.0) return 0.0;
  // Luminances that differ by less than the rounding of halves count as equal.
  const float rounding = luminance(centre.rgb) * 1e-3 + 1e-7;
  return 1.0 / (constants.sigmaLuminance * smoothDeviation(p) + rounding);
}

// The binomial row of order 2r, computed tap by tap; its sum is 1. Order 4 is the B3 spline 1 4 6 4 1.
float firstTap() { return pow(0.25, float(kRadius)); }
float nextTap(float tap, int offset) { return tap * float(kRadius - offset) / float(kRadius + offset + 1); }

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, textureSize(depth, 0)))) return;

  const vec4 centre = texelFetch(colour, p, 0);
  const float z = unpackDepth(texelFetch(depth, p, 0).x);
  if (z == 0.0) {
    imageStore(outColour, p, centre);
    return;
  }

  const Surface surface = surfaceAt(p, z);
  const float centreLuminance = luminance(centre.rgb);
  const float falloff = luminanceFalloff(p, centre);
  vec3 sum = vec3(0.0);
  float varianceSum = 0.0, weightSum = 0.0;
  float tapY = firstTap();
  for (int y = -kRadius; y <= kRadius; ++y) {
    float tap = tapY * firstTap();
    for (int x = -kRadius; x <= kRadius; ++x) {
      const ivec2 q = p + kSpacing * ivec2(x, y);
      const float kernel = kGaussianFalloff > 0.0 ? exp(-float(x * x + y * y) * kGaussianFalloff) : tap;
      float weight = kernel * surfaceWeight(surface, q);
      tap = nextTap(tap, x);
      if (weight <= 0.0) continue;
      const vec4 neighbour = texelFetch(colour, q, 0);
      if (neighbour.a < 0.0) continue;
      weight *= exp(-abs(luminance(neighbour.rgb) - centreLuminance) * falloff);
      sum += weight * neighbour.rgb;
      varianceSum += weight * weight * neighbour.a * neighbour.a;
      weightSum += weight;
    }
    tapY = nextTap(tapY, y);
  }
  if (weightSum <= 0.0) {
    imageStore(outColour, p, centre);
    return;
  }
  imageStore(outColour, p, nearestHalf(vec4(sum, sqrt(varianceSum)) / weightSum));
}
