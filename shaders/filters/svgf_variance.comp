// SVGF, variance estimation (Schied et al. 2017, 4.2): the temporal variance of a pixel's luminance, or the spatial
// variance over 7 x 7 pixels of the same surface while the history is short. A single frame (kSingleFrame) has no
// temporal variance.
// VIEW: does the same work and writes one of its intermediate values instead of the result.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "conventions/frame.h"
#include "filters/svgf_filter.h"
#include "common/finite.glsl"
#include "common/luminance.glsl"
#include "stage/pass_through.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(std140) uniform frameConstants { FrameConstants frame; };
uniform utexture2D depth;
uniform utexture2D shadingNormal;
uniform utexture2D geometricNormal;
uniform texture2D colour;
layout(constant_id = 0) const bool kSingleFrame = false;
uniform texture2D moments;  // Mean luminance, its standard deviation, history length.
#ifdef VIEW
layout(rgba32f) uniform writeonly image2D outView;
#else
layout(rgba16f) uniform writeonly image2D outColour;
#endif
layout(push_constant) uniform PushConstants {
  SvgfFilterConstants constants;
#ifdef VIEW
  uint view;  // Which quantity; numbered in viewOf.
#endif
};

#include "filters/svgf.glsl"

struct Estimate {
  vec3 colour;
  float mean;       // Of the luminance.
  float deviation;  // Of the luminance.
  float samples;    // 0: none.
};

Estimate estimateAt(ivec2 q) {
  const vec3 radiance = texelFetch(colour, q, 0).rgb;
  if (!kSingleFrame) {
    const vec3 m = texelFetch(moments, q, 0).xyz;
    return Estimate(radiance, m.x, m.y, m.z);
  }
  if (!isFinite(radiance)) return Estimate(vec3(0.0), 0.0, 0.0, 0.0);
  const vec3 bounded = clampedRadiance(radiance);
  return Estimate(bounded, luminance(bounded), 0.0, 1.0);
}

// Standard deviation of the luminance over the pixels of one surface, from the variance of each and the spread of their
// means.
float deviationAround(ivec2 p, float z, float origin) {
  const ivec2 last = textureSize(depth, 0) - 1;
  const Surface surface = surfaceOf(p, z, unpackLongNormal(texelFetch(geometricNormal, p, 0).x),
                                    unpackLongNormal(texelFetch(shadingNormal, p, 0).x));
  float sum = 0.0, squares = 0.0, weightSum = 0.0;
  for (int y = -3; y <= 3; ++y) {
    for (int x = -3; x <= 3; ++x) {
      const ivec2 q = p + ivec2(x, y);
      if (any(lessThan(q, ivec2(0))) || any(greaterThan(q, last))) continue;
      const float zThere = unpackDepth(texelFetch(depth, q, 0).x);
      const uint normalThere = texelFetch(shadingNormal, q, 0).x;
      if (zThere == 0.0) continue;
      const float weight = exp2(surfaceExponent(surface, vec2(x, y), zThere, unpackLongNormal(normalThere)));
      const Estimate e = estimateAt(q);
      if (e.samples <= 0.0) continue;
      const float offset = e.mean - origin;
      sum += weight * offset;
      squares += weight * (e.deviation * e.deviation + offset * offset);
      weightSum += weight;
    }
  }
  if (weightSum <= 0.0) return 0.0;
  const float mean = sum / weightSum;
  return sqrt(max(squares / weightSum - mean * mean, 0.0));
}

// Whether the spatial estimate is used in place of the temporal one.
bool isEstimatedAround(Estimate e) { return e.samples > 0.0 && e.samples < constants.minHistory; }

float deviationOf(ivec2 p, float z, Estimate e) {
  if (e.samples <= 0.0) return kNoSample;
  if (!isEstimatedAround(e)) return e.deviation;
  // A few samples estimate their variance badly: the boost makes it rather too large than too small.
  const float boost = sqrt(constants.minHistory / e.samples);
  return min(boost * deviationAround(p, z, e.mean), kLargestHalf);
}

#ifdef VIEW
vec3 viewOf(ivec2 p, float z) {
  if (z == 0.0 || view != 0u) return vec3(0.0);
  const Estimate e = estimateAt(p);
  return vec3(max(deviationOf(p, z, e), 0.0), isEstimatedAround(e), e.samples <= 0.0);
}
#endif

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, textureSize(depth, 0)))) return;

  const float z = unpackDepth(texelFetch(depth, p, 0).x);
#ifdef VIEW
  imageStore(outView, p, vec4(viewOf(p, z), 1.0));
#else
  if (z == 0.0) {
    imageStore(outColour, p, vec4(passThroughLight(colour, p), 0.0));
    return;
  }
  const Estimate e = estimateAt(p);
  imageStore(outColour, p, vec4(e.colour, deviationOf(p, z, e)));
#endif
}
