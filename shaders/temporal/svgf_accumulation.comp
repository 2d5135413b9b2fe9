// SVGF, temporal accumulation (Schied et al. 2017, 4.1 and 4.2): averages colour and luminance moments along the
// motion. The history of the colour is the previous frame's accumulated colour, or the result of one of its a-trous
// iterations. Moments are kept centred, as mean and standard deviation: the difference of raw moments would drown in
// the rounding of halves.
// VIEW: does the same work and writes one of its intermediate values instead of the result.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "conventions/frame.h"
#include "temporal/svgf_accumulation.h"
#include "common/half.glsl"
#include "common/luminance.glsl"
#include "stage/pass_through.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(std140) uniform frameConstants { FrameConstants frame; };
uniform texture2D lighting;
uniform texture2D motion;
uniform utexture2D depth;
uniform utexture2D geometricNormal;
uniform usampler2D previousDepth;
uniform usampler2D previousGeometricNormal;
uniform texture2D previousColour;
uniform texture2D previousMoments;  // Mean luminance, its deviation, history length.
#ifdef VIEW
layout(rgba32f) uniform writeonly image2D outView;
#else
layout(rgba16f) uniform writeonly image2D outColour;
layout(rgba16f) uniform writeonly image2D outMoments;
#endif
layout(push_constant) uniform PushConstants {
  SvgfAccumulationConstants constants;
#ifdef VIEW
  uint view;  // Which quantity; numbered in viewOf.
#endif
};

#include "temporal/confidence.glsl"
#define HISTORY previousColour
#include "temporal/reprojection.glsl"

struct TemporalMoments {
  vec3 colour;
  float mean;      // Of the luminance.
  float variance;  // Of the luminance of one sample.
  float samples;   // History length.
};

HistoryTaps tapsOf(ivec2 p, float z) {
  return historyTaps(p, reproject(p, z), constants.planeTolerance, constants.normalThreshold);
}

TemporalMoments sampleHistory(HistoryTaps taps) {
  const vec4 weights = tapWeights(taps);
  TemporalMoments history = TemporalMoments(vec3(0.0), 0.0, 0.0, 0.0);
  vec3 moments[4];
  float weightSum = 0.0;
  for (int i = 0; i < 4; ++i) {
    if (weights[i] <= 0.0) continue;
    moments[i] = texelFetch(previousMoments, historyTap(taps, i), 0).xyz;
    if (moments[i].z <= 0.0) continue;
    history.colour += weights[i] * texelFetch(previousColour, historyTap(taps, i), 0).rgb;
    history.mean += weights[i] * moments[i].x;
    history.samples += weights[i] * moments[i].z;
    weightSum += weights[i];
  }
  if (weightSum <= kLeastTapWeight) return TemporalMoments(vec3(0.0), 0.0, 0.0, 0.0);
  history.colour /= weightSum;
  history.mean /= weightSum;
  history.samples /= weightSum;
  for (int i = 0; i < 4; ++i) {
    if (weights[i] <= 0.0 || moments[i].z <= 0.0) continue;
    const float offset = moments[i].x - history.mean;
    history.variance += weights[i] / weightSum * (moments[i].y * moments[i].y + offset * offset);
  }
  return history;
}

// Adds a sample to running mean and variance, with weight `alpha` for the colour and `momentAlpha` for the moments.
void addSample(inout TemporalMoments m, vec3 radiance, float alpha, float momentAlpha) {
  const float offset = luminance(radiance) - m.mean;
  m.colour = mix(m.colour, radiance, alpha);
  m.mean += momentAlpha * offset;
  m.variance = (1.0 - momentAlpha) * (m.variance + momentAlpha * offset * offset);
}

// The history with this frame's sample. A sample that is not finite does not count: the moments stay as they were.
TemporalMoments momentsWith(ivec2 p, TemporalMoments m, vec3 noisy) {
  m.samples = confidentLength(p, m.samples, constants.maxHistory);
  if (!isFinite(noisy)) return m;
  m.samples = min(m.samples + 1.0, constants.maxHistory);
  const float momentSamples = min(m.samples, constants.maxMomentHistory);
  addSample(m, clampedRadiance(noisy), 1.0 / m.samples, 1.0 / momentSamples);
  return m;
}

#ifdef VIEW
// Numbered as in temporal_accumulation.comp.
vec3 viewOf(ivec2 p, float z, vec3 noisy) {
  const bool surface = z > 0.0;
  if (view == 1u) {
    const bool clamped = isFinite(noisy) && clampedRadiance(noisy) != noisy;
    return vec3(!isFinite(noisy), surface && clamped, surface && !isFinite(motionAt(p)));
  }
  if (!surface) return vec3(0.0);
  const HistoryTaps taps = tapsOf(p, z);
  const TemporalMoments history = sampleHistory(taps);
  return vec3(momentsWith(p, history, noisy).samples, tapsRejected(taps), history.samples == 0.0);
}
#endif

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, textureSize(lighting, 0)))) return;

  const vec3 noisy = texelFetch(lighting, p, 0).rgb;
  const float z = unpackDepth(texelFetch(depth, p, 0).x);
#ifdef VIEW
  imageStore(outView, p, vec4(viewOf(p, z, noisy), 1.0));
#else
  if (z == 0.0) {
    imageStore(outColour, p, vec4(passThroughLight(noisy), 0.0));
    imageStore(outMoments, p, vec4(0.0));
    return;
  }
  const TemporalMoments m = momentsWith(p, sampleHistory(tapsOf(p, z)), noisy);
  imageStore(outColour, p, nearestHalf(vec4(m.colour, 1.0)));
  imageStore(outMoments, p, nearestHalf(vec4(m.mean, sqrt(m.variance), m.samples, 0.0)));
#endif
}
