// SVGF, one edge-avoiding a-trous iteration (Schied et al. 2017, 4.3 and 4.4; Fu 2022): a binomial kernel with taps 2^i
// pixels apart, weighted by plane distance (W_Z), normal (W_N) and luminance (W_L). It also filters the variance that
// guides W_L. A work group keeps what its taps read in shared memory (svgf_taps.glsl).
// SPECULAR: lobes take the place of normals (svgf_lobe.glsl).
// WINDOW: reads every tap from the textures, for windows too large for shared memory. With a Gaussian kernel in place
// of the binomial one it is the bilateral filter that the iterations approximate.
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "conventions/frame.h"
#include "filters/svgf_filter.h"
#include "common/half.glsl"
#include "common/luminance.glsl"

#ifdef WINDOW
#define TAP_LOOP
layout(local_size_x = 8, local_size_y = 8) in;
#else
#define TAP_LOOP [[unroll]]  // Neighbouring taps overlap, and the kernel becomes constants.
layout(local_size_x = 16, local_size_y = 16) in;
#endif
layout(constant_id = 0) const int kRadius = 2;    // Taps on each side of the centre.
layout(constant_id = 1) const int kSpacing = 1;   // 2^i pixels.
layout(constant_id = 2) const bool kLuminanceWeight = true;
#ifdef WINDOW
layout(constant_id = 3) const float kGaussianFalloff = 0.0;  // exp(-falloff d^2), d in pixels; 0: binomial.
#endif

layout(std140) uniform frameConstants { FrameConstants frame; };
uniform utexture2D depth;
#ifdef SPECULAR
uniform utexture2D lobes;
#else
uniform utexture2D shadingNormal;
#endif
uniform utexture2D geometricNormal;
uniform texture2D colour;  // rgb: radiance; a: standard deviation of its luminance.
layout(rgba16f) uniform writeonly image2D outColour;
layout(push_constant) uniform PushConstants { SvgfFilterConstants constants; };

#include "filters/svgf.glsl"
#ifdef SPECULAR
#include "filters/svgf_lobe.glsl"
#endif
#include "filters/svgf_taps.glsl"

// Standard deviation at `p` from the variance smoothed by a 3 x 3 Gaussian over the pixels that have one.
float smoothDeviation(ivec2 p) {
  const ivec2 last = textureSize(colour, 0) - 1;
  float deviations[9];
  [[unroll]] for (int i = 0; i < 9; ++i) {
    const ivec2 q = clamp(p + ivec2(i % 3, i / 3) - 1, ivec2(0), last);
    const float deviation = texelFetch(colour, q, 0).a;
    deviations[i] = unpackDepth(texelFetch(depth, q, 0).x) > 0.0 ? deviation : kNoSample;
  }
  float sum = 0.0, weightSum = 0.0;
  [[unroll]] for (int i = 0; i < 9; ++i) {
    const float kernel = (i % 3 == 1 ? 0.5 : 0.25) * (i / 3 == 1 ? 0.5 : 0.25);
    const float weight = deviations[i] < 0.0 ? 0.0 : kernel;
    sum += weight * deviations[i] * deviations[i];
    weightSum += weight;
  }
  return sqrt(sum / weightSum);
}

// The falloff in W_L = 2^(-|l_p - l_q| * falloff); 0 gives all luminances the same weight.
float luminanceFalloff(ivec2 p, vec4 centre) {
  if (!kLuminanceWeight || centre.a < 0.0) return 0.0;
  // Luminances that differ by less than the rounding of halves count as equal.
  const float rounding = luminance(centre.rgb) * 1e-3 + 1e-7;
  return kLog2OfE / (constants.sigmaLuminance * smoothDeviation(p) + rounding);
}

// The binomial row of order 2r, computed tap by tap; its sum is 1. Order 4 is the B3 spline 1 4 6 4 1.
float firstTap() { return pow(0.25, float(kRadius)); }
float nextTap(float tap, int offset) { return tap * float(kRadius - offset) / float(kRadius + offset + 1); }

struct Filtered {
  vec3 sum;           // Of weighted colours.
  float varianceSum;
  float weightSum;
};

// Adds a tap with the weight 2^exponent.
void add(inout Filtered filtered, Tap tap, float exponent) {
  const float weight = tap.z > 0.0 ? exp2(exponent) : 0.0;
  filtered.sum += weight * tap.colour.rgb;
  filtered.varianceSum += weight * tap.colour.a * (weight * tap.colour.a);
  filtered.weightSum += weight;
}

void main() {
  const ivec2 p = pixelOfThread();
  const ivec2 size = textureSize(depth, 0);
  const ivec2 inside = min(p, size - 1);
  const vec4 centre = texelFetch(colour, inside, 0);
  const float z = unpackDepth(texelFetch(depth, inside, 0).x);
  const uint geometric = texelFetch(geometricNormal, inside, 0).x;
  prepareTaps();
  if (p != inside) return;
  if (z == 0.0) {
    imageStore(outColour, p, centre);
    return;
  }

#ifdef SPECULAR
  const Surface surface = surfaceOf(p, z, unpackLongNormal(geometric), vec3(0.0));
  const Reflection reflection = reflectionOf(p, z, tapAt(p, ivec2(0)).lobe, centre.a >= 0.0);
#else
  const Surface surface = surfaceOf(p, z, unpackLongNormal(geometric), tapAt(p, ivec2(0)).normal);
#endif
  const float centreLuminance = luminance(centre.rgb);
  const float falloff = luminanceFalloff(p, centre);
  Filtered filtered = Filtered(vec3(0.0), 0.0, 0.0);
  float tapY = firstTap();
  TAP_LOOP for (int y = -kRadius; y <= kRadius; ++y) {
    float tapX = tapY * firstTap();
    TAP_LOOP for (int x = -kRadius; x <= kRadius; ++x) {
      const Tap tap = tapAt(p, ivec2(x, y));
#ifdef WINDOW
      const float kernel = kGaussianFalloff > 0.0 ? -float(x * x + y * y) * kGaussianFalloff * kLog2OfE : log2(tapX);
#else
      const float kernel = log2(tapX);
#endif
      const float difference = abs(luminance(tap.colour.rgb) - centreLuminance);
      const vec2 offset = kSpacing * vec2(x, y);
#ifdef SPECULAR
      const float guides =
          lobeExponent(reflection, offset, tap.z, tap.lobe) - distanceFrom(surface, offset, tap.z);
#else
      const float guides = surfaceExponent(surface, offset, tap.z, tap.normal);
#endif
      add(filtered, tap, kernel + guides - difference * falloff);
      tapX = nextTap(tapX, x);
    }
    tapY = nextTap(tapY, y);
  }
  if (filtered.weightSum <= 0.0) {
    imageStore(outColour, p, centre);
    return;
  }
  imageStore(outColour, p, nearestHalf(vec4(filtered.sum, sqrt(filtered.varianceSum)) / filtered.weightSum));
}
