// SVGF, temporal accumulation (Schied et al. 2017, 4.1 and 4.2): averages colour and luminance moments along the
// motion. The history of the colour is the previous frame's accumulated colour, or the result of one of its a-trous
// iterations. Moments are kept centred, as mean and standard deviation: the difference of raw moments would drown in
// the rounding of halves.
// SPECULAR: specular light. It follows the taps of reflection_motion.comp, has no sample where its distance is 0, and
// lobes (packed_lobe.glsl) are written for the a-trous iterations. A view, which writes none, learns that from kTapsGiven.
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
uniform texture2D previousMoments;  // Mean luminance, its deviation, history length; specular light: nearness.
#ifdef VIEW
layout(rgba32f) uniform writeonly image2D outView;
layout(constant_id = 2) const bool kTapsGiven = false;
#else
layout(rgba16f) uniform writeonly image2D outColour;
layout(rgba16f) uniform writeonly image2D outMoments;
#ifdef SPECULAR
const bool kTapsGiven = true;
uniform utexture2D shadingNormal;
uniform texture2D roughness;
layout(rg32ui) uniform writeonly uimage2D outLobes;
#else
const bool kTapsGiven = false;
#endif
#endif
#if defined(SPECULAR) || defined(VIEW)
uniform utexture2D givenTaps;
#endif
layout(push_constant) uniform PushConstants {
  SvgfAccumulationConstants constants;
#ifdef VIEW
  uint view;  // Which quantity; numbered in viewOf.
#endif
};

#include "temporal/confidence.glsl"
#ifdef SPECULAR
#include "conventions/camera.glsl"
#include "conventions/packed_lobe.glsl"
#include "temporal/history_taps.glsl"
#else
#define HISTORY previousColour
#include "temporal/reprojection.glsl"
#endif

struct TemporalMoments {
  vec3 colour;
  float mean;      // Of the luminance.
  float variance;  // Of the luminance of one sample.
  float samples;   // History length.
  float nearness;  // Specular light: view depth over the distance of what is reflected.
};
const TemporalMoments kNoMoments = TemporalMoments(vec3(0.0), 0.0, 0.0, 0.0, 0.0);

#if defined(SPECULAR) || defined(VIEW)
HistoryTaps keptTaps(ivec2 p) {
  return unpackTaps(p, texelFetch(givenTaps, p, 0).x, frame.previousPixelFromPixel);
}
#endif
HistoryTaps tapsOf(ivec2 p, float z) {
#ifdef SPECULAR
  return keptTaps(p);
#else
#ifdef VIEW
  if (kTapsGiven) return keptTaps(p);
#endif
  return historyTaps(p, reproject(p, z), constants.planeTolerance, constants.normalThreshold);
#endif
}

TemporalMoments sampleHistory(HistoryTaps taps) {
  const vec4 weights = tapWeights(taps);
  TemporalMoments history = kNoMoments;
  vec4 moments[4];
  float weightSum = 0.0;
  for (int i = 0; i < 4; ++i) {
    if (weights[i] <= 0.0) continue;
    moments[i] = texelFetch(previousMoments, historyTap(taps, i), 0);
    if (moments[i].z <= 0.0) continue;
    history.colour += weights[i] * texelFetch(previousColour, historyTap(taps, i), 0).rgb;
    history.mean += weights[i] * moments[i].x;
    history.samples += weights[i] * moments[i].z;
    weightSum += weights[i];
  }
  if (weightSum <= kLeastTapWeight) return kNoMoments;
  history.colour /= weightSum;
  history.mean /= weightSum;
  history.samples /= weightSum;
  for (int i = 0; i < 4; ++i) {
    if (weights[i] <= 0.0 || moments[i].z <= 0.0) continue;
    const float offset = moments[i].x - history.mean;
    history.variance += weights[i] / weightSum * (moments[i].y * moments[i].y + offset * offset);
#ifdef SPECULAR
    history.nearness += weights[i] / weightSum * moments[i].w;
#endif
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

// Whether the pixel has a sample of this frame, which may not be finite. Alpha of specular light is its distance.
bool hasSample(vec4 noisy) { return !kTapsGiven || noisy.a > 0.0; }

// The history with this frame's sample. A sample that is not finite does not count: the moments stay as they were.
TemporalMoments momentsWith(ivec2 p, float z, TemporalMoments m, vec4 noisy) {
  m.samples = confidentLength(p, m.samples, constants.maxHistory);
  if (!hasSample(noisy) || !isFinite(noisy.rgb)) return m;
  m.samples = min(m.samples + 1.0, constants.maxHistory);
  const float momentSamples = min(m.samples, constants.maxMomentHistory);
  addSample(m, clampedRadiance(noisy.rgb), 1.0 / m.samples, 1.0 / momentSamples);
#ifdef SPECULAR
  m.nearness = mix(m.nearness, nearnessOf(inverseDistance(noisy.a), z), 1.0 / m.samples);
#endif
  return m;
}

#ifdef VIEW
// Numbered as in temporal_accumulation.comp.
vec3 viewOf(ivec2 p, float z, vec4 noisy) {
  const bool surface = z > 0.0;
  if (view == 1u) {
    const bool finite = isFinite(noisy.rgb), clamped = finite && clampedRadiance(noisy.rgb) != noisy.rgb;
    return vec3(hasSample(noisy) && !finite, surface && hasSample(noisy) && clamped,
                surface && !isFinite(motionAt(p)));
  }
  if (!surface) return vec3(0.0);
  const HistoryTaps taps = tapsOf(p, z);
  const TemporalMoments history = sampleHistory(taps);
  return vec3(momentsWith(p, z, history, noisy).samples, tapsRejected(taps), history.samples == 0.0);
}
#endif

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, textureSize(lighting, 0)))) return;

  const vec4 noisy = texelFetch(lighting, p, 0);
  const float z = unpackDepth(texelFetch(depth, p, 0).x);
#ifdef VIEW
  imageStore(outView, p, vec4(viewOf(p, z, noisy), 1.0));
#else
  if (z == 0.0) {
    imageStore(outColour, p, vec4(kTapsGiven ? passThroughSpecular(noisy) : passThroughLight(noisy.rgb), 0.0));
    imageStore(outMoments, p, vec4(0.0));
#ifdef SPECULAR
    imageStore(outLobes, p, uvec4(0u));
#endif
    return;
  }
  const TemporalMoments m = momentsWith(p, z, sampleHistory(tapsOf(p, z)), noisy);
  imageStore(outColour, p, nearestHalf(vec4(m.colour, 1.0)));
  imageStore(outMoments, p, nearestHalf(vec4(m.mean, sqrt(m.variance), m.samples, m.nearness)));
#ifdef SPECULAR
  const vec3 seen = normalize(rayThrough(frame.rayFromPixel, pixelCentre(p)));
  const vec3 mirrored = reflect(seen, unpackLongNormal(texelFetch(shadingNormal, p, 0).x));
  const float angle = lobeAngle(validRoughness(texelFetch(roughness, p, 0).x));
  imageStore(outLobes, p, uvec4(packLobe(Lobe(mirrored, angle, m.nearness)), 0u, 0u));
#endif
#endif
}
