// Specular light of `walr` (passes/SPECULAR.md): an edge-avoiding a-trous iteration over 3 x 3 pixels, weighted by how
// far their lobes cover the same things (lobe_weight.glsl), by the distance from the tangent plane and by luminance.
// FIRST: reads accumulated light, shortens it by the antilag of its own frame, and estimates the standard error that
// guides the weight of luminance. Other iterations read both from the one before.
// Between iterations, light is packed (packed_light.glsl), as filtered light is. LAST: writes that, without PACKED as
// halves.
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "conventions/frame.h"
#include "common/finite.glsl"
#include "common/half.glsl"
#include "common/luminance.glsl"
#include "conventions/packed_light.glsl"

layout(local_size_x = 16, local_size_y = 16) in;
layout(constant_id = 0) const int kSpacing = 1;  // Pixels between taps.
// At which difference of luminance the weight falls to 1/e, in standard errors.
layout(constant_id = 4) const float kLuminanceErrors = 15.0;

layout(std140) uniform frameConstants { FrameConstants frame; };
uniform utexture2D depth;
uniform utexture2D reflectors;
#ifdef FIRST
layout(constant_id = 1) const bool kPackedMean = true;  // The accumulated light is packed.
layout(constant_id = 2) const bool kAntilag = false;
layout(constant_id = 3) const float kMaxHistory = 8.0;  // Of accumulation, frames.
uniform utexture2D accumulatedPacked;
uniform texture2D accumulatedHalf;
uniform sampler2D antilag;
#else
uniform utexture2D colour;
uniform texture2D standardError;  // Of the luminance, below 0 where there is no light.
#endif
#if defined(FIRST) || (defined(LAST) && !defined(PACKED))
uniform texture2D lighting;
#endif
#if defined(LAST) && !defined(PACKED)
layout(rgba16f) uniform writeonly image2D outFiltered;
#else
layout(r32ui) uniform writeonly uimage2D outFiltered;
#endif
#ifndef LAST
layout(r16f) uniform writeonly image2D outStandardError;
#endif

#include "filters/interleaved_quads.glsl"
#include "filters/lobe_weight.glsl"
#include "stage/pass_through.glsl"
#ifdef FIRST
#include "temporal/antilag.glsl"
#endif

const float kNoSample = -1.0;
const float kMirrorErrors = 3.2;  // kLuminanceErrors of mirrors, which show edges that only light tells.

// With an odd spacing, a work group filters 16 x 16 pixels. With an even one, it filters 8 x 8 quads.
const int kSide = 16;
const bool kQuads = kSpacing % 2 == 0;
const int kTapSpacing = kQuads ? 2 : kSpacing;  // In the tile.
const int kTileSide = kSide + 2 * kTapSpacing;
const int kTilePixels = kTileSide * kTileSide;

ivec2 pixelAt(ivec2 place) {
  return kQuads ? pixelOfQuads(place, kSide, kSpacing) : ivec2(gl_WorkGroupID.xy) * kSide + place;
}

struct Light {
  vec3 colour;
  float error;     // Standard error of the luminance; in FIRST not known yet, 0. kNoSample without any light.
  float variance;  // FIRST: of the mean, over that of a sample.
  float square;   // FIRST: of the difference of this frame's sample, as an estimate of the variance, if there is one.
  bool measured;  // There is.
};

#ifdef FIRST
// Variance of a mean of n frames, over that of a frame. Once history is as long as it may be, `most` frames, the mean is
// exponential, and its variance is nearly half of that of frames which count alike. At rest, history grows beyond.
float varianceOfMean(float n, float most) {
  const bool exponential = kLengthRounding * n >= most && n <= kLengthRounding * kMaxHistory;
  return 1.0 / max(exponential ? 2.0 * n - 1.0 : n, 1.0);
}

Light lightAt(ivec2 q) {
  vec4 mean = kPackedMean ? unpackAccumulated(texelFetch(accumulatedPacked, q, 0).x) : texelFetch(accumulatedHalf, q, 0);
  const vec4 noisy = texelFetch(lighting, q, 0);
  const bool hasSample = noisy.a > 0.0 && isFinite(noisy.rgb);
  vec3 radiance = hasSample ? clampedRadiance(noisy.rgb) : vec3(0.0);
  float most = kMaxHistory;
  if (kAntilag) {
    const TileLimits limits = tileLimitsAt(antilag, vec2(q));
    radiance = withoutFirefly(radiance, limits.brightest);
    const float longest = longestHistoryOf(hasSample, longestHistory(limits.factor, kMaxHistory));
    mean = withLongestHistory(mean, radiance, hasSample ? 1.0 : 0.0, longest);
    most = min(longest + 1.0, kMaxHistory);
  }
  // The difference y - m of a sample from the mean of N samples, which holds it, has the variance (N - 1) / N of y's.
  const float difference = luminance(radiance - mean.rgb);
  const bool measured = hasSample && mean.a >= 1.5;
  const float square = measured ? difference * difference * mean.a / (mean.a - 1.0) : 0.0;
  return Light(mean.rgb, mean.a > 0.0 ? 0.0 : kNoSample, varianceOfMean(mean.a, most), square,
               measured);
}
#else
Light lightAt(ivec2 q) {
  return Light(unpackFiltered(texelFetch(colour, q, 0).x).rgb, texelFetch(standardError, q, 0).x, 1.0, 0.0, false);
}
#endif

shared vec4 tileLobes[kTilePixels];  // Mirrored direction; depth, 0 where the pixel does not count.
shared LobeReach tileReaches[kTilePixels];
shared uvec2 tileLight[kTilePixels];  // Halves: red, luminance, blue, standard error.
#ifdef FIRST
shared vec2 tileSamples[kTilePixels];  // Light::square, below 0 unless measured; Light::variance.
#endif

void fillTile() {
  for (int i = int(gl_LocalInvocationIndex); i < kTilePixels; i += kSide * kSide) {
    const ivec2 q = pixelAt(ivec2(i % kTileSide, i / kTileSide) - kTapSpacing);
    const ivec2 inside = clamp(q, ivec2(0), textureSize(depth, 0) - 1);
    const float z = unpackDepth(texelFetch(depth, inside, 0).x);
    const uvec2 reflector = texelFetch(reflectors, inside, 0).xy;
    const Light light = lightAt(inside);
    const bool counts = q == inside && light.error >= 0.0;
    const vec3 ray = rayThrough(frame.rayFromPixel, pixelCentre(inside));
    tileLobes[i] = vec4(reflect(normalize(ray), unpackLongNormal(reflector.x)), counts ? z : 0.0);
    tileReaches[i] = lobeReach(reflector);
    const vec3 colour = luminanceForGreen(light.colour);
    tileLight[i] = uvec2(packHalf2x16(colour.xy), packHalf2x16(vec2(colour.z, light.error)));
#ifdef FIRST
    tileSamples[i] = vec2(light.measured ? light.square : -1.0, light.variance);
#endif
  }
  barrier();
}

vec4 tapLight(int index) {
  const uvec2 light = tileLight[index];
  return vec4(unpackHalf2x16(light.x), unpackHalf2x16(light.y));
}

#ifdef FIRST
// Standard deviation of the luminance of one sample over the pixels around that have light: from the differences of
// this frame's samples, or where hardly any pixel has a history, from those between the pixels.
float deviationAround(int centre) {
  float squares = 0.0, measured = 0.0, sum = 0.0, sumOfSquares = 0.0, variances = 0.0, weights = 0.0;
  [[unroll]] for (int i = 0; i < 9; ++i) {
    const int index = centre + (i / 3 - 1) * kTileSide + i % 3 - 1;
    const float weight = tileLobes[index].w > 0.0 ? 1.0 : 0.0;
    const vec2 sampled = tileSamples[index];
    const float l = tapLight(index).y;
    squares += weight * max(sampled.x, 0.0);
    measured += sampled.x >= 0.0 ? weight : 0.0;
    sum += weight * l;
    sumOfSquares += weight * l * l;
    variances += weight * sampled.y;
    weights += weight;
  }
  if (weights == 0.0) return kNoSample;
  const float mean = sum / weights;
  const float spread = max(sumOfSquares / weights - mean * mean, 0.0) * weights / variances;
  const float known = min(4.0 * measured / weights, 1.0);
  return min(sqrt(mix(4.0 * spread, squares / max(measured, 1e-6), known)), kLargestHalf);
}
#else
// The root of the mean square of the standard errors of the pixel and its four nearest taps.
float errorAround(int centre) {
  float sum = 0.0, weights = 0.0;
  [[unroll]] for (int i = 0; i < 9; ++i) {
    if (i % 2 == 0 && i != 4) continue;
    const int index = centre + kTapSpacing * ((i / 3 - 1) * kTileSide + i % 3 - 1);
    const float weight = tileLobes[index].w > 0.0 ? 1.0 : 0.0, error = unpackHalf2x16(tileLight[index].y).y;
    sum += weight * error * error;
    weights += weight;
  }
  return weights > 0.0 ? sqrt(sum / weights) : kNoSample;
}
#endif

void storeNoSurface(ivec2 p) {
#if defined(LAST) && !defined(PACKED)
  imageStore(outFiltered, p, vec4(passThroughSpecular(texelFetch(lighting, p, 0)), 1.0));
#else
  imageStore(outFiltered, p, uvec4(kFilteredNoSurface));
#endif
#ifndef LAST
  imageStore(outStandardError, p, vec4(kNoSample));
#endif
}

// `light`: red, luminance, blue, standard error.
void store(ivec2 p, vec4 light) {
  const vec3 colour = greenForLuminance(light.xyz);
#if defined(LAST) && !defined(PACKED)
  imageStore(outFiltered, p, nearestHalf(vec4(colour, 1.0)));
#else
  const vec3 within = clamp(colour, vec3(0.0), vec3(largestPacked(9)));
  imageStore(outFiltered, p, uvec4(packFiltered(within, ditherNumber(p, frame.frameIndex))));
#endif
#ifndef LAST
  imageStore(outStandardError, p, vec4(min(light.a, kLargestHalf)));
#endif
}

void main() {
  fillTile();
  const ivec2 place = ivec2(gl_LocalInvocationID.xy);
  const ivec2 p = pixelAt(place);
  if (any(greaterThanEqual(p, textureSize(depth, 0)))) return;
  const float z = unpackDepth(texelFetch(depth, p, 0).x);
  if (z == 0.0) {
    storeNoSurface(p);
    return;
  }
  const int centre = (place.y + kTapSpacing) * kTileSide + place.x + kTapSpacing;
  const uvec2 reflector = texelFetch(reflectors, p, 0).xy;
  const vec4 own = tapLight(centre);
  const bool hasLight = tileLobes[centre].w > 0.0;
  const OwnLobe lobe = ownLobe(p, z, reflector, tileLobes[centre].xyz, tileReaches[centre], hasLight);
  float guides[9];
  [[unroll]] for (int i = 0; i < 9; ++i) {
    const ivec2 tap = ivec2(i % 3, i / 3) - 1;
    const int index = centre + kTapSpacing * (tap.y * kTileSide + tap.x);
    guides[i] = i == 4 ? 0.0 : lobeExponent(lobe, vec2(kSpacing * tap), tileLobes[index], tileReaches[index]);
  }
#ifdef FIRST
  const float deviation = deviationAround(centre);
  const float error = deviation * sqrt(tileSamples[centre].y);
#else
  const float error = errorAround(centre);
#endif
  // Luminances that differ by less than the rounding of halves count as equal.
  const float errors = isMirror(tileReaches[centre]) ? kMirrorErrors : kLuminanceErrors;
  const float falloff = hasLight ? kLog2OfE / (errors * error + own.y * 1e-3 + 1e-7) : 0.0;
  vec3 sum = vec3(0.0);
  float variance = 0.0, weights = 0.0;
  [[unroll]] for (int i = 0; i < 9; ++i) {
    const ivec2 tap = ivec2(i % 3, i / 3) - 1;
    const int index = centre + kTapSpacing * (tap.y * kTileSide + tap.x);
    const vec4 light = tapLight(index);
    const float exponent = guides[i] - abs(light.y - own.y) * falloff;
    const float weight = tileLobes[index].w > 0.0 ? (i == 4 ? 1.0 : exp2(exponent)) : 0.0;
    sum += weight * light.xyz;
    weights += weight;
#ifdef FIRST
    const vec2 sampled = tileSamples[index];
    variance += weight * weight * (sampled.x >= 0.0 ? sampled.x : deviation * deviation) * sampled.y;
#else
    const float weighted = weight * light.w;
    variance += weighted * weighted;
#endif
  }
  store(p, weights > 0.0 ? vec4(sum, sqrt(variance)) / weights : vec4(0.0, 0.0, 0.0, kNoSample));
}
