// Temporal accumulation (passes/WALR.md, 2; Meunier & Harada 2022, 4.2): reprojects the pixel, tests the four history
// taps one by one (reprojection.glsl), and adds this frame's sample to the mean of the accepted ones. The cumulative
// mean turns exponential at `maxHistory`.
// KEEP_TAPS: also writes motion and accepted taps, so that later stages read their histories without testing again
// (Meunier & Harada 2022, 4.4; Koskela et al. 2019, 3.5), and at pixels without a surface a mark or the pass-through
// (history_taps.glsl).
// ANTILAG: shortens history by the antilag factor of the previous frame, holds fireflies back, and writes the sums for
// the next one (antilag.comp).
// PACKED: the mean is packed light (packed_light.glsl) and holds nothing at pixels without a surface.
// VIEW: does the same work and writes one of its intermediate values instead of the result; kAntilag says whether
// antilag is on.
// GUIDES: prepares the pixel's guides first (guides.glsl), which saves a pass and reading them back.
// REFLECTIONS: finds the motion of reflections first, from the host's G-buffer (reflection_motion.glsl), and follows it,
// which saves two passes and what they hand on. Also keeps depth and reflectors.
// kTapsGiven: takes motion and accepted taps that another pass has kept: another light's accumulation, or the motion of
// reflections (reflection_motion.comp).
// LIGHT_GRID: the mean has a texel for each group of sparse light, and so has a copy of the guides of the pixels that
// have this frame's samples. Needs GUIDES.
// kStill: nothing moves, so that the history of a pixel is the pixel itself.
// kLightCounted: history lengths are numbers of samples (sample_counts.glsl).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_control_flow_attributes : require
#include "conventions/frame.h"
#ifdef GUIDES
#include "temporal/guides_and_accumulation.h"
#elif defined(REFLECTIONS)
#define HOST_SURFACES
#define DISTANCES
#include "temporal/reflection_motion.h"
#else
#include "temporal/temporal_accumulation.h"
#endif

layout(local_size_x = 8, local_size_y = 8) in;

layout(std140) uniform frameConstants { FrameConstants frame; };
uniform texture2D lighting;
uniform texture2D motion;
uniform usampler2D previousDepth;
#ifndef GUIDES
uniform utexture2D depth;
uniform utexture2D geometricNormal;
uniform usampler2D previousGeometricNormal;
#endif
#ifdef REFLECTIONS
uniform texture2D roughness;
uniform usampler2D previousReflector;
#ifndef VIEW
layout(r32ui) uniform writeonly uimage2D outDepth;
layout(rg32ui) uniform writeonly uimage2D outReflector;
#endif
#endif
// rgb: mean; a: history length.
#ifdef PACKED
uniform usampler2D previousAccumulated;
#else
uniform texture2D previousAccumulated;
#endif
#ifdef KEEP_TAPS
const bool kStill = false;
#else
layout(constant_id = 4) const bool kStill = false;
#endif
layout(constant_id = 2) const bool kBicubicHistory = false;
#ifdef VIEW
layout(rgba32f) uniform writeonly image2D outView;
#elif defined(PACKED)
layout(r32ui) uniform writeonly uimage2D outAccumulated;
#else
layout(rgba16f) uniform writeonly image2D outAccumulated;
#endif
#ifdef KEEP_TAPS
layout(constant_id = 3) const bool kKeepPassThrough = false;  // At pixels without a surface; else kNoSurfaceTaps.
layout(r32ui) uniform writeonly uimage2D outTaps;
#endif
#if (defined(KEEP_TAPS) || defined(VIEW)) && !defined(GUIDES) && !defined(REFLECTIONS)
#define GIVEN_TAPS
layout(constant_id = 6) const bool kTapsGiven = false;
uniform utexture2D givenTaps;
#endif
#if defined(ANTILAG) || defined(VIEW)
uniform sampler2D previousAntilag;
#endif
#ifdef ANTILAG
const bool kAntilag = true;
layout(rgba32f) uniform writeonly image2D outTiles;
#elif defined(VIEW)
layout(constant_id = 5) const bool kAntilag = false;
#endif
#ifdef LIGHT_GRID
layout(r32ui) uniform writeonly uimage2D outLightDepth;  // And geometric normals.
layout(r32ui) uniform writeonly uimage2D outLightFeatures;
#endif
#ifdef GUIDES
layout(push_constant) uniform PushConstants { GuidesAndAccumulationConstants pushed; };
#define constants pushed.accumulation
#define guideConstants pushed.guides
#include "guides/guides.glsl"
#else
layout(push_constant) uniform PushConstants {
#ifdef REFLECTIONS
  HostReflectionConstants pushed;
#define constants pushed.motion
#define guideConstants pushed.guides
#else
  TemporalAccumulationConstants constants;
#endif
#ifdef VIEW
  uint view;  // Which quantity; numbered in viewOf.
#endif
};
#endif

#include "conventions/packed_light.glsl"
#ifdef PACKED
const int kHistoryBits = kAccumulatedBits;
vec4 unpackHistory(uint packed) { return unpackAccumulated(packed); }
float unpackHistoryLength(uint packed) { return unpackHistory(packed).a; }
#endif
#include "common/half.glsl"
#ifdef VIEW
#define LIGHT_GRID_CHOSEN
#endif
#include "conventions/light_sample.glsl"
#if defined(LIGHT_GRID) || defined(VIEW)
#define LIGHT_GRID_TAPS
#endif
#define COUNT_EMPTY_TAPS kSparseLight
#include "temporal/history_taps.glsl"
#include "stage/pass_through.glsl"
#if defined(ANTILAG) || defined(VIEW)
#include "temporal/antilag.glsl"
#include "common/luminance.glsl"
#include "temporal/antilag_tiles.glsl"
#endif
#include "temporal/at_rest.glsl"
#include "temporal/confidence.glsl"
#include "temporal/sample_counts.glsl"
#define HISTORY previousAccumulated
#include "temporal/bicubic.glsl"
#include "temporal/reprojection.glsl"
#ifdef REFLECTIONS
#include "temporal/reflection_motion.glsl"
#endif

// The history of a pixel.
struct ReprojectedHistory {
  vec4 mean;       // rgb: mean light; a: history length, 0: none.
  vec2 position;   // In pixels of the previous frame, from the centre of its first.
  int rejected;    // Number of history taps that were rejected.
  float perFrame;  // samplesPerFrame, once it is known.
};

// The longest history of pixel `p`, frames. Only antilag lets it be longer at rest.
float longestHistoryAt(ivec2 p, ReprojectedHistory found) {
#if defined(ANTILAG) || defined(VIEW)
  if (!kLightCounted && isAtRest(found.position - vec2(p))) return constants.maxHistoryAtRest;
#endif
  return constants.maxHistory;
}

// The history length of pixel `p` with this frame's samples; `history`: without them.
float lengthAt(ivec2 p, ReprojectedHistory found, float history, LightSample noisy) {
  return lengthWith(history, usableSamples(noisy), found.perFrame, longestHistoryAt(p, found));
}

ReprojectedHistory historyAt(HistoryTaps taps, vec2 position) {
  const vec4 mean = kBicubicHistory ? bicubicOfTaps(previousAccumulated, taps, kCatmullRom)
                                    : meanOfTaps(previousAccumulated, taps);
  return ReprojectedHistory(mean, position, tapsRejected(taps), 1.0);
}

#ifdef GIVEN_TAPS
// The history taps that another pass has kept, which this one keeps, too.
HistoryTaps takeGivenTaps(ivec2 p) {
  const uint given = texelFetch(givenTaps, p, 0).x;
#ifdef KEEP_TAPS
  imageStore(outTaps, p, uvec4(given));
#endif
  return unpackTaps(p, given, frame.previousPixelFromPixel);
}
#endif

#ifdef REFLECTIONS
// The history of reflected light. Its longest length is rounded to eight bits, as the separate pass stores it, and as
// there (confidence.glsl), history may be longer at rest where all of it counts.
ReprojectedHistory historyOfReflection(ivec2 p) {
  const Reflector own = reflectorAt(p);
  const ReflectionMotion m = reflectionMotionAt(p, own);
#ifndef VIEW
  imageStore(outTaps, p, uvec4(packTaps(m.motion, m.taps)));
  imageStore(outReflector, p, uvec4(packedReflectorOf(p, own, m), 0u, 0u));
#endif
  const HistoryTaps taps = tapsOf(p, m);
  ReprojectedHistory found = historyAt(taps, tapPosition(taps));
  const float confidence = round(255.0 * m.history / constants.maxHistory) * (1.0 / 255.0);
  if (confidence < 1.0) found.mean.a = min(found.mean.a, constants.maxHistory * confidence);
  return found;
}
#endif

ReprojectedHistory readHistory(ivec2 p, float z) {
#ifdef REFLECTIONS
  return historyOfReflection(p);
#else
  if (kStill) return ReprojectedHistory(historyTexel(previousAccumulated, p), vec2(p), 0, 1.0);
#ifdef GIVEN_TAPS
  if (kTapsGiven) {
    const HistoryTaps given = takeGivenTaps(p);
    return historyAt(given, tapPosition(given));
  }
#endif
  const Reprojection r = reproject(p, z);
  HistoryTaps taps = historyTaps(p, r, constants.planeTolerance, constants.normalThreshold);
#ifdef KEEP_TAPS
  imageStore(outTaps, p, uvec4(packTaps(r.motion, taps.accepted)));
#endif
  const vec2 position = tapPosition(taps);
#ifdef LIGHT_GRID
  if (!isOnLightGrid(p)) return ReprojectedHistory(vec4(0.0), position, 0, 1.0);
#endif
#ifdef LIGHT_GRID_TAPS
  if (kLightGrid) taps = lightGridTaps(p, r, position, constants.planeTolerance, constants.normalThreshold);
#endif
  return historyAt(taps, position);
#endif
}

#if defined(ANTILAG) || defined(VIEW)
// How far this frame's sample and the history before it are held back.
struct Fireflies {
  float sampleFactor;
  float historyFactor;
  float square;  // Of the sample's brightness, but no larger than that of one that passes.
};

// `share`: fireflyShareOfTile. History is as bright as a firefly if this frame's sample does not bear it out.
Fireflies firefliesIn(ReprojectedHistory found, LightSample noisy, float share) {
  Fireflies factors = Fireflies(1.0, 1.0, 0.0);
  if (!kAntilag || !isUsable(noisy)) return factors;
  const float brightest = tileLimitsAt(previousAntilag, found.position).brightest;
  const float now = brightestChannel(clampedRadiance(noisy.radiance)), before = brightestChannel(found.mean.rgb);
  factors.sampleFactor = heldBack(sqrt(share) * now, brightest);
  factors.square = brightest > 0.0 ? min(now * now, brightest * brightest / max(share, 1e-6)) : now * now;
  // A history that is longer at rest is of samples that have passed, and many frames bear its brightness out.
  const float frames = min(found.mean.a / found.perFrame, constants.maxHistory);
  if (before > 2.0 * now) factors.historyFactor = heldBack(frames * before, brightest);
  return factors;
}

// What antilag leaves of a history.
struct AntilagLimit {
  float factor;
  float longest;  // History length.
};

AntilagLimit antilagLimit(ReprojectedHistory found, LightSample noisy) {
  const float factor = tileLimitsAt(previousAntilag, found.position).factor;
  const float frames = longestHistoryOf(isUsable(noisy), longestHistory(factor, constants.maxHistory));
  return AntilagLimit(factor, found.perFrame * frames);
}
#endif

// `noisy`: this frame's sample, if there is one.
ReprojectedHistory historyWithAntilag(ivec2 p, float z, LightSample noisy) {
  ReprojectedHistory found = readHistory(p, z);
  found.perFrame = samplesPerFrame(found.mean.a, usableSamples(noisy));
#if defined(ANTILAG) || defined(VIEW)
  if (kAntilag) found.mean.a = min(found.mean.a, antilagLimit(found, noisy).longest);
#endif
  found.mean.a = confidentLength(p, found.mean.a, found.perFrame * constants.maxHistory);
  return found;
}

#if defined(ANTILAG) || defined(VIEW)
// Of this frame's sample on a surface.
float brightnessOf(LightSample noisy, float z) {
  return z > 0.0 && isUsable(noisy) ? brightestChannel(clampedRadiance(noisy.radiance)) : 0.0;
}
#endif

#ifdef VIEW
vec3 viewOf(ivec2 p, float z, LightSample noisy, float share) {
  const bool surface = z > 0.0;
  const bool sampleIsUsable = isUsable(noisy);
  switch (view) {
    case 0u: {
      if (!surface) return vec3(0.0);
      const ReprojectedHistory found = historyWithAntilag(p, z, noisy);
      return vec3(lengthAt(p, found, found.mean.a, noisy), found.rejected, found.mean.a == 0.0);
    }
    case 1u:
      return vec3(noisy.exists && !sampleIsUsable,
                  surface && sampleIsUsable && clampedRadiance(noisy.radiance) != noisy.radiance,
                  surface && !kStill && !isFinite(motionAt(p)));
    case 2u: {
      if (!surface || !kAntilag) return vec3(0.0);
      ReprojectedHistory found = readHistory(p, z);
      found.perFrame = samplesPerFrame(found.mean.a, usableSamples(noisy));
      const AntilagLimit limit = antilagLimit(found, noisy);
      return vec3(limit.factor, limit.longest, found.mean.a > limit.longest);
    }
    case 3u: {
      if (!surface) return vec3(0.0);
      const Fireflies factors = firefliesIn(historyWithAntilag(p, z, noisy), noisy, share);
      const float lost = brightnessOf(noisy, z) * (1.0 - factors.sampleFactor);
      return vec3(factors.sampleFactor < 1.0, lost > 0.0 ? min(lost * inversesqrt(factors.square), 65536.0) : 0.0,
                  factors.historyFactor < 1.0);
    }
  }
  return vec3(0.0);
}

void main() {
#ifdef REFLECTIONS
  fillTile();
#endif
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  const bool inside = all(lessThan(p, pictureSize()));
  const LightSample noisy = inside ? lightSampleAt(lighting, p) : kNoLightSample;
  const float z = inside ? depthAt(p) : 0.0;
  const float share = fireflyShareOfTile(brightnessOf(noisy, z));
  if (inside) imageStore(outView, p, vec4(viewOf(p, z, noisy, share), 1.0));
}
#else
#ifdef PACKED
void storeMean(ivec2 p, vec4 mean) {
  const vec4 random = randomNumbers(p, frame.frameIndex, kAccumulatedSeed);
  imageStore(outAccumulated, accumulatedTexel(p), uvec4(packAccumulated(mean, random)));
}
void storeNoSurface(ivec2 p, vec3 light) {
  if (!kLightGrid || isOnLightGrid(p)) imageStore(outAccumulated, accumulatedTexel(p), uvec4(0u));
}
#else
void storeMean(ivec2 p, vec4 mean) { imageStore(outAccumulated, p, nearestHalf(mean)); }
void storeNoSurface(ivec2 p, vec3 light) { imageStore(outAccumulated, p, vec4(light, 0.0)); }
#endif

// What antilag sums up over tiles.
struct PixelSums {
  float difference;  // Luminance of this frame's sample less that of history; 0 if one of them is missing.
  float square;      // Fireflies::square.
  float samples;     // 1 if there is one of this frame.
};
const PixelSums kNoSums = PixelSums(0.0, 0.0, 0.0);

// Accumulates one pixel. `share`: fireflyShareOfTile.
PixelSums accumulate(ivec2 p, float z, LightSample noisy, float share) {
  const bool sampleIsUsable = isUsable(noisy);
#ifdef REFLECTIONS
  imageStore(outDepth, p, uvec4(packDepthSdf(z, 0u)));
#endif
  if (z == 0.0) {
    const vec3 passed = passThroughLight(noisy.radiance);
    storeNoSurface(p, passed);
#ifdef REFLECTIONS
    imageStore(outReflector, p, uvec4(0u));
#endif
#ifdef KEEP_TAPS
    imageStore(outTaps, p, uvec4(kKeepPassThrough ? packPassThrough(passed) : kNoSurfaceTaps));
#endif
    return kNoSums;
  }

  const ReprojectedHistory found = historyWithAntilag(p, z, noisy);
  if (kLightGrid && !isOnLightGrid(p)) return kNoSums;
  vec4 history = found.mean;
  vec3 radiance = clampedRadiance(noisy.radiance);
#ifdef ANTILAG
  const Fireflies factors = firefliesIn(found, noisy, share);
  history.rgb *= factors.historyFactor;
  radiance *= factors.sampleFactor;
#endif
  const float samples = lengthAt(p, found, history.a, noisy);
  const float newest = countedSamples(noisy);
  const vec3 mean = sampleIsUsable ? mix(history.rgb, radiance, newest / max(samples, newest)) : history.rgb;
  storeMean(p, vec4(mean, samples));
#ifdef ANTILAG
  if (!sampleIsUsable) return kNoSums;
  const float difference = history.a > 0.0 ? luminance(radiance - history.rgb) : 0.0;
  return PixelSums(difference, factors.square, 1.0);
#else
  return kNoSums;
#endif
}

#ifdef LIGHT_GRID
// Groups at the border of the image may have their sample outside of it. The threads there write that it shows no
// surface.
void storeLightGuides(ivec2 p, bool inside) {
  if (!isOnLightGrid(p)) return;
  imageStore(outLightDepth, accumulatedTexel(p), uvec4(ownGuides.depth));
  imageStore(outLightFeatures, accumulatedTexel(p), uvec4(ownGuides.features));
  if (!inside) storeNoSurface(p, vec3(0.0));
}
#endif

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
#ifdef GUIDES
  const bool inside = all(lessThan(p, textureSize(hostDepth, 0)));
  ownGuides = guidesOfPixel();
  if (inside) storeGuides(p, ownGuides);
#ifdef LIGHT_GRID
  storeLightGuides(p, inside);
#endif
#else
#ifdef REFLECTIONS
  fillTile();
#endif
  const bool inside = all(lessThan(p, pictureSize()));
#endif
#ifdef ANTILAG
  const LightSample noisy = inside ? lightSampleAt(lighting, p) : kNoLightSample;
  const float z = inside ? depthAt(p) : 0.0;
  const float share = fireflyShareOfTile(brightnessOf(noisy, z));
  PixelSums sums = kNoSums;
  if (inside) sums = accumulate(p, z, noisy, share);
  sumOverTile(sums.difference, sums.square, sums.samples);
#else
  if (inside) accumulate(p, depthAt(p), lightSampleAt(lighting, p), 1.0);
#endif
}
#endif
