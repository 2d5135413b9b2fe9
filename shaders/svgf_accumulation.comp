// SVGF, temporal filtering: colour and luminance moments are averaged along the motion. The colour's history is the
// last frame's result of an early a-trous iteration. Moments are kept centred, as mean and standard deviation, because
// the difference of raw moments drowns in the rounding of half precision.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "constants/frame.h"
#include "constants/svgf_accumulation.h"
#include "include/half.glsl"
#include "include/luminance.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, std140) uniform frameConstants { FrameConstants frame; };
layout(set = 0, binding = 1) uniform texture2D lighting;
layout(set = 0, binding = 2) uniform texture2D motion;
layout(set = 0, binding = 3) uniform utexture2D depth;
layout(set = 0, binding = 4) uniform utexture2D geometricNormal;
layout(set = 0, binding = 5) uniform utexture2D previousDepth;
layout(set = 0, binding = 6) uniform utexture2D previousGeometricNormal;
layout(set = 0, binding = 7) uniform texture2D previousColour;
layout(set = 0, binding = 8) uniform texture2D previousMoments;  // Mean luminance, its deviation, history length.
layout(set = 0, binding = 9, rgba16f) uniform writeonly image2D outColour;
layout(set = 0, binding = 10, rgba16f) uniform writeonly image2D outMoments;
layout(push_constant) uniform PushConstants { SvgfAccumulationConstants settings; };

#define REJECT_BY_PLANE
#include "include/reprojection.glsl"

struct TemporalMoments {
  vec3 colour;
  float mean;      // Of the luminance.
  float variance;  // Of the luminance of one sample.
  float samples;   // History length.
};

TemporalMoments sampleHistory(ivec2 p, float z, vec3 normal) {
  const HistoryTaps taps =
      historyTaps(p, reproject(p, z), normal, settings.planeTolerance, settings.normalThreshold);
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

// Weighted mean and variance with one more sample of weight `alpha`.
void addSample(inout TemporalMoments m, vec3 radiance, float alpha, float momentAlpha) {
  const float offset = luminance(radiance) - m.mean;
  m.colour = mix(m.colour, radiance, alpha);
  m.mean += momentAlpha * offset;
  m.variance = (1.0 - momentAlpha) * (m.variance + momentAlpha * offset * offset);
}

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, textureSize(lighting, 0)))) return;

  const vec3 noisy = texelFetch(lighting, p, 0).rgb;
  const bool sampleIsFinite = isFinite(noisy);
  const float z = unpackDepth(texelFetch(depth, p, 0).x);
  if (z == 0.0) {
    imageStore(outColour, p, vec4(sampleIsFinite ? noisy : vec3(0.0), 0.0));
    imageStore(outMoments, p, vec4(0.0));
    return;
  }

  TemporalMoments m = sampleHistory(p, z, unpackNormal(texelFetch(geometricNormal, p, 0).x));
  if (sampleIsFinite) {
    // A sample that is not finite is no sample: the moments stay as they were.
    m.samples = min(m.samples + 1.0, settings.maxSamples);
    const float momentSamples = min(m.samples, settings.maxMomentSamples);
    addSample(m, clamp(noisy, vec3(0.0), vec3(kLargestHalf)), 1.0 / m.samples, 1.0 / momentSamples);
  }
  imageStore(outColour, p, nearestHalf(vec4(m.colour, 1.0)));
  imageStore(outMoments, p, nearestHalf(vec4(m.mean, sqrt(m.variance), m.samples, 0.0)));
}
