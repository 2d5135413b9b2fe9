// Temporal anti-aliasing (passes/WALR.md, 10; Meunier & Harada 2022, 4.4): reads the history with a bicubic filter,
// clips it to the variance of the current neighbourhood, and adds the current frame. The cumulative mean turns
// exponential at `maxHistory`.
// With kPixelArea, a jittered frame adds to the mean over the pixel's area: every history tap is accepted, whatever
// surface it shows, and the history follows the nearest surface of the 3 x 3 pixels. The filter that reads it is sharper.
// What the frame adds is a mean over the samples in and around the pixel.
// KEPT_TAPS: reprojection comes from the taps that accumulation kept (history_taps.glsl). Otherwise it is done here, or
// with kStill, nothing moves and the history of a pixel is the pixel itself.
// With kShortened, the history of what is at rest is longer, and that of frames without jitter is shorter where the
// filtered light has little noise.
// PACKED: the filtered light and the history are packed light (packed_light.glsl); every surface has filtered light,
// and no other pixel has. The pass-through comes from the kept taps or from the host's lighting. The result is not
// packed.
// VIEW: does the same work and writes one of its intermediate values instead of the result.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_control_flow_attributes : require
#include "conventions/frame.h"
#include "temporal/temporal_antialiasing.h"

layout(local_size_x = 16, local_size_y = 8) in;
layout(constant_id = 2) const uint kClipRadius = 1;  // Radius of the clipping neighbourhood, pixels.
layout(constant_id = 6) const bool kPixelArea = false;
layout(constant_id = 7) const bool kTightAtEdges = false;  // Clip by edgeClipGamma where other surfaces mix in.
layout(constant_id = 9) const bool kShortened = false;
#ifdef KEPT_TAPS
layout(constant_id = 3) const bool kRejectHistory = true;  // Leave out taps that accumulation rejected.
#endif
#ifdef PACKED
layout(constant_id = 5) const bool kBeyondLevels = false;  // maxHistory is above all levels of packed lengths.
#endif

#ifdef PACKED
uniform utexture2D filtered;
uniform usampler2D previousResolved;  // rgb: mean; a: history length.
#else
uniform texture2D filtered;  // a: below 0 where the filter found no sample.
uniform texture2D previousResolved;  // rgb: mean; a: history length.
#endif
#ifdef VIEW
layout(rgba32f) uniform writeonly image2D outView;
#else
#ifdef PACKED
layout(r32ui) uniform writeonly uimage2D outResolved;
#ifndef KEPT_TAPS
uniform texture2D passThrough;
#endif
#else
layout(rgba16f) uniform writeonly image2D outResolved;
#endif
layout(rgba16f) uniform writeonly image2D outImage;
#endif
layout(std140) uniform frameConstants { FrameConstants frame; };
uniform utexture2D depth;  // KEPT_TAPS: read with kPixelArea only.
#ifdef KEPT_TAPS
uniform utexture2D keptTaps;
#else
layout(constant_id = 4) const bool kStill = false;
uniform texture2D motion;
uniform usampler2D previousDepth;
uniform utexture2D geometricNormal;
uniform usampler2D previousGeometricNormal;
uniform utexture2D objects;
uniform usampler2D previousObjects;
#endif
// For tiles of antilag: bits of floats, from 0 (not at all) to 1 (to no history). Below 0 history is longer at rest: at -3
// four times as long.
uniform usampler2D shortening;
layout(push_constant) uniform PushConstants {
  TemporalAntialiasingConstants constants;
#ifdef VIEW
  uint view;  // Which quantity; numbered in viewOf.
#endif
};

#ifdef PACKED
#include "conventions/packed_light.glsl"
const int kHistoryBits = kResolvedBits;
PackedLength longestLength() { return PackedLength(constants.maxHistory * constants.restFactor, kBeyondLevels); }
vec4 unpackHistory(uint packed) { return unpackResolved(packed, longestLength()); }
float unpackHistoryLength(uint packed) { return unpackLength(packed >> 29, longestLength()); }
vec4 filteredAt(ivec2 q) { return unpackFiltered(texelFetch(filtered, q, 0).x); }
#ifdef KEPT_TAPS
// Both of them are packed in the same way.
vec4 filteredOrPassThroughAt(ivec2 p) {
  const uint light = texelFetch(filtered, p, 0).x;
  const bool surface = light != kFilteredNoSurface;
  return vec4(unpackPassThrough(surface ? light : texelFetch(keptTaps, p, 0).x), surface ? 1.0 : -1.0);
}
#elif !defined(VIEW)
#include "conventions/light_sample.glsl"
#include "stage/pass_through.glsl"
vec4 filteredOrPassThroughAt(ivec2 p) {
  const vec4 light = filteredAt(p);
  return light.a >= 0.0 ? light : vec4(passThroughLight(lightSampleAt(passThrough, p).radiance), -1.0);
}
#endif
#else
vec4 filteredAt(ivec2 q) { return texelFetch(filtered, q, 0); }
vec4 filteredOrPassThroughAt(ivec2 p) { return filteredAt(p); }
#endif
#include "temporal/bicubic.glsl"
#include "common/half.glsl"
#include "temporal/antilag.glsl"
#include "temporal/at_rest.glsl"

#ifdef KEPT_TAPS
#include "conventions/surface.glsl"
const bool kStill = false;
float confidentLength(ivec2 p, float samples, float most) { return samples; }
#else
#include "temporal/confidence.glsl"
#define HISTORY previousResolved
#define OBJECTS
#include "temporal/reprojection.glsl"
#endif

// Whether a pixel shows a surface. `colour`: its filtered colour.
#ifdef PACKED
bool hasSurface(ivec2 q, vec4 colour) { return colour.a >= 0.0; }
#elif defined(KEPT_TAPS)
bool hasSurface(ivec2 q, vec4 colour) { return texelFetch(keptTaps, q, 0).x != kNoSurfaceTaps; }
#else
bool hasSurface(ivec2 q, vec4 colour) { return depthAt(q) > 0.0; }
#endif

vec3 toYCoCg(vec3 c) {
  const float notGreen = 0.5 * (c.r + c.b);
  return vec3(0.5 * (c.g + notGreen), 0.5 * (c.r - c.b), 0.5 * (c.g - notGreen));
}
vec3 fromYCoCg(vec3 c) {
  const float notGreen = c.x - c.z;
  return vec3(notGreen + c.y, c.x + c.z, notGreen - c.y);
}

// The filtered colours in and around the pixels of a work group. rgb: YCoCg of a surface's colour; a: 1 or, with
// kPixelArea, its depth. Others: rgb: 0; a: 0 or, with kPixelArea, minus the depth of a surface whose colour is not known,
// and minus infinity without a surface.
const uint kTileWidth = gl_WorkGroupSize.x + 2u * kClipRadius;
const uint kTileHeight = gl_WorkGroupSize.y + 2u * kClipRadius;
shared vec4 tile[kTileWidth * kTileHeight];

// The smallest depth in the tile; smaller ones count as this.
const float kLeastTileDepth = 7.888609052210118e-31;  // 2^-100

uint tileIndex(uvec2 texel) { return (texel.y & 0xffu) * kTileWidth + texel.x; }

// A texel of the tile with alpha 1 for the colour of a surface, else 0.
vec4 knownColour(vec4 texel) { return vec4(texel.rgb, clamp(texel.a * (1.0 / kLeastTileDepth), 0.0, 1.0)); }
vec4 knownTexel(uvec2 texel) { return knownColour(tile[tileIndex(texel)]); }

// A depth for the tile, which tells what is nearer: its lowest bits, which hold other guides (surface.glsl), are left out.
// Infinite without a surface.
float tileDepth(ivec2 q, bool known) {
  const uint packed = texelFetch(depth, q, 0).x;
#ifdef PACKED
  const bool surface = known;
#else
  const bool surface = packed != 0u;
#endif
  return max(uintBitsToFloat(surface ? packed & ~kShortNormalMask : 0x7f800000u), kLeastTileDepth);
}

vec4 tileTexel(ivec2 q, vec4 colour) {
  const bool known = colour.a >= 0.0;
  if (!kPixelArea) return known && hasSurface(q, colour) ? vec4(toYCoCg(colour.rgb), 1.0) : vec4(0.0);
  const float z = tileDepth(q, known);
#ifndef PACKED
  if (floatBitsToUint(z) == 0x7f800000u) return vec4(vec3(0.0), -z);
#endif
  return known ? vec4(toYCoCg(colour.rgb), z) : vec4(vec3(0.0), -z);
}

// Texel `i` of the tile beyond the work group's sides: above and below first, then left and right.
uvec2 tileBorder(uint i) {
  const uint rows = 2u * kClipRadius * kTileWidth;
  // i / kTileWidth. GPUs multiply 24 bits fast.
  const uint row = (i & 0xfffu) * ((65535u + kTileWidth) / kTileWidth) >> 16;
  const uint j = i - rows, rowBeside = j / (2u * kClipRadius);
  const uvec2 above = uvec2(i - row * kTileWidth, row < kClipRadius ? row : row + gl_WorkGroupSize.y);
  const uint column = j - rowBeside * 2u * kClipRadius;
  const uvec2 beside = uvec2(column < kClipRadius ? column : column + gl_WorkGroupSize.x, rowBeside + kClipRadius);
  return i < rows ? above : beside;
}

// Fills the tile. `own` is the colour of this thread's pixel, `q` that pixel; outside the image, of its border.
void fillTile(ivec2 q, vec4 own) {
  tile[tileIndex(gl_LocalInvocationID.xy + kClipRadius)] = tileTexel(q, own);
  const uint threads = gl_WorkGroupSize.x * gl_WorkGroupSize.y;
  const uint thread = gl_LocalInvocationID.y * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
  const ivec2 first = ivec2(gl_WorkGroupID.xy * gl_WorkGroupSize.xy) - int(kClipRadius);
  const ivec2 last = textureSize(filtered, 0) - 1;
  for (uint i = thread; i < kTileWidth * kTileHeight - threads; i += threads) {
    const uvec2 texel = tileBorder(i);
    const ivec2 beyond = clamp(first + ivec2(texel), ivec2(0), last);
    tile[tileIndex(texel)] = tileTexel(beyond, filteredAt(beyond));
  }
  barrier();
}

// The pixel of the 3 x 3 around `p`, the pixel of this thread, that is nearest to the camera. Along silhouettes it is one
// of the occluder, whose motion the history follows. Of pixels at one depth, `p` comes first.
ivec2 nearestInTile(ivec2 p) {
  const uint centre = tileIndex(gl_LocalInvocationID.xy + kClipRadius);
  // The bits of positive numbers are ordered as the numbers are. The lowest bits of a depth in the tile are 0, and take
  // the pixel's number: 0 for `p`, from 1 on in reading order for the others.
  uint least = 0xffffffffu;
  [[unroll]] for (uint i = 0u; i < 9u; ++i) {
    const uint number = i == 4u ? 0u : (i < 4u ? i + 1u : i);
    const uint texel = centre + i / 3u * kTileWidth + i % 3u - kTileWidth - 1u;
    least = min(least, floatBitsToUint(abs(tile[texel].a)) | number);
  }
  const uint number = least & 0xfu;
  const uint i = number == 0u ? 4u : (number <= 4u ? number - 1u : number);
  // Beyond the image's border, the tile repeats the border's pixels.
  return clamp(p + ivec2(i % 3u, i / 3u) - 1, ivec2(0), textureSize(filtered, 0) - 1);
}

// Whether the mean is over the pixel's area: samples lie elsewhere in a pixel than in the previous frame.
bool coversArea() { return kPixelArea && frame.jitterDelta != vec2(0.0); }

// The history of a pixel. The taps that it is read at may be accepted although they show another surface.
struct ResolvedHistory {
  vec4 light;    // a: history length, 0 without a history.
  int rejected;  // Number of taps that are not accepted.
  bool mixed;    // With kTightAtEdges: some tap shows another surface.
  bool atRest;   // The history lies at the pixel itself.
};

// Accepts all taps inside the image, as frames that cover the pixel's area do.
HistoryTaps withAllAccepted(HistoryTaps taps) {
  taps.accepted = tapsInside(taps, textureSize(previousResolved, 0));
  return taps;
}

// `mixed`: as in ResolvedHistory.
#ifdef KEPT_TAPS
HistoryTaps tapsOf(ivec2 p, out bool mixed) {
  const bool wholeArea = coversArea();
  const uint kept = texelFetch(keptTaps, wholeArea ? nearestInTile(p) : p, 0).x;
  const HistoryTaps taps = unpackTaps(p, kept, frame.previousPixelFromPixel);
  mixed = kTightAtEdges && wholeArea && tapsRejected(taps) > 0;
  return !kRejectHistory || wholeArea ? withAllAccepted(taps) : taps;
}
#else
HistoryTaps testedTaps(ivec2 p, float z) {
  return historyTaps(p, reproject(p, z), constants.planeTolerance, constants.normalThreshold);
}

HistoryTaps tapsOf(ivec2 p, out bool mixed) {
  const float z = depthAt(p);
  mixed = false;
  if (!coversArea()) return testedTaps(p, z);
  const ivec2 followed = nearestInTile(p);
  if (kTightAtEdges) mixed = tapsRejected(testedTaps(followed, depthAt(followed))) > 0;
  const Reprojection r = reprojectWith(p, z, followed);
  const HistoryTaps taps = tapsAround(p, r.motion, frame.previousPixelFromPixel);
  return r.valid ? withAllAccepted(taps) : taps;
}
#endif

ResolvedHistory historyOf(ivec2 p) {
  ResolvedHistory history = ResolvedHistory(vec4(0.0), 0, false, kStill);
  if (kStill) {
    history.light = historyTexel(previousResolved, p);
  } else {
    const HistoryTaps taps = tapsOf(p, history.mixed);
    history.rejected = tapsRejected(taps);
    history.atRest = isAtRest(tapPosition(taps) - vec2(p));
    const float sharpness = coversArea() ? constants.historySharpness : kCatmullRom;
    history.light = bicubicOfTaps(previousResolved, taps, sharpness);
  }
  history.light.a = confidentLength(p, history.light.a, constants.maxHistory);
  return history;
}

// Smallest half size of the clipping box around a mean: the rounding of history and neighbourhood. In a smaller
// box, where chroma hardly varies, that rounding would decide how much of the history's luma is kept.
#ifdef PACKED
float smallestHalfSize(vec3 mean) {
  const vec3 colour = fromYCoCg(mean);
  const float brightest = max(max(colour.r, colour.g), colour.b);
  return brightest / 128.0;  // At most one rounding step of the history; that of nine filtered colours is smaller.
}
#else
float smallestHalfSize(vec3 mean) { return 4.0 / 2048.0 * mean.x; }  // Rounding of four halves.
#endif

// The box into which the history of a pixel is clipped: around the mean of the surfaces near it, in YCoCg.
struct ClippingBox {
  vec3 mean;
  vec3 squaredHalfSize;
};

ClippingBox clippingBox(float gamma) {
  vec4 sum = vec4(0.0);  // a: number of surfaces.
  vec3 squares = vec3(0.0);
  const uint first = tileIndex(gl_LocalInvocationID.xy);
  for (uint y = 0u; y <= 2u * kClipRadius; ++y) {
    for (uint x = 0u; x <= 2u * kClipRadius; ++x) {
      const vec4 colour = tile[first + tileIndex(uvec2(x, y))];
      sum += knownColour(colour);
      squares += colour.rgb * colour.rgb;
    }
  }
  const float share = 1.0 / sum.a;
  const vec3 mean = sum.rgb * share;
  // The difference of two large sums has a rounding error. Its square root is a thousandth of the mean at most.
  const vec3 squaredDeviation = (squares - sum.rgb * mean) * (gamma * gamma * share);
  const float smallest = max(smallestHalfSize(mean), 1e-12);
  return ClippingBox(mean, max(squaredDeviation, vec3(smallest * smallest)));
}

// A colour moved towards the mean until it is inside the clipping box (Salvi 2016).
struct Clipped {
  vec3 colour;    // Linear RGB.
  vec3 offset;    // From the mean before clipping, in YCoCg.
  float outside;  // The same in units of the box's half size, its largest component; above 1: clipped.
};

Clipped clippedHistory(ResolvedHistory history) {
  const ClippingBox box = clippingBox(history.mixed ? constants.edgeClipGamma : constants.clipGamma);
  const vec3 mean = fromYCoCg(box.mean);
  const vec3 fromMean = history.light.rgb - mean, offset = toYCoCg(fromMean);
  const vec3 ratios = offset * offset / box.squaredHalfSize;
  const float squared = max(max(ratios.x, ratios.y), ratios.z);
  return Clipped(mean + fromMean * min(inversesqrt(squared), 1.0), offset, sqrt(squared));
}

// The mean over the pixel's area by this frame alone. Samples lie `frame.jitter` from the centres of pixels, and those
// of surfaces are weighted by a tent around the pixel's centre (Karis 2014). It ends within a pixel, so that along each
// axis only the pixel's own sample and the one on the other side of its centre count.
vec3 meanOverArea() {
  const vec2 own = constants.filterRadius - abs(frame.jitter);
  const vec2 beside = max(constants.filterRadius - 1.0 + abs(frame.jitter), vec2(0.0));
  const uvec2 centre = gl_LocalInvocationID.xy + kClipRadius;
  const uvec2 opposite = centre + mix(uvec2(-1), uvec2(1), lessThan(frame.jitter, vec2(0.0)));
  vec4 sum = own.x * own.y * knownTexel(centre);
  sum += beside.x * own.y * knownTexel(uvec2(opposite.x, centre.y));
  sum += own.x * beside.y * knownTexel(uvec2(centre.x, opposite.y));
  sum += beside.x * beside.y * knownTexel(opposite);
  return fromYCoCg(sum.rgb * (1.0 / sum.a));
}

// This frame's light of a pixel, whose own sample is `own`.
vec3 lightOfFrame(vec3 own) { return coversArea() && constants.filterRadius > 0.5 ? meanOverArea() : own; }

// The longest history of a pixel, with this frame. In jittered frames the mean is over the pixel's area, too, which takes
// as many samples as it gets.
float longestHistoryAt(ivec2 p, bool atRest) {
  const bool jittered = frame.jitterDelta != vec2(0.0);
  if (!kShortened || (jittered && !atRest)) return constants.maxHistory;
  const vec2 tile = amongAntilagTiles(vec2(p)), base = floor(tile);
  const float shorter = gatherBilinear(shortening, base, tile - base);
  if (shorter < 0.0) return atRest ? constants.maxHistory * (1.0 - shorter) : constants.maxHistory;
  return jittered ? constants.maxHistory : mix(constants.maxHistory, 1.0, shorter);
}

// The new running mean of pixel `p` and its history length.
vec4 resolve(ivec2 p, vec4 current, ResolvedHistory history) {
  // Without a sample in this frame the history stays as it is.
  if (current.a < 0.0) return history.light;
  const vec3 light = lightOfFrame(current.rgb);
  if (history.light.a == 0.0) return vec4(light, 1.0);
  const vec3 clipped = clippedHistory(history).colour;
  const float samples = min(history.light.a + 1.0, longestHistoryAt(p, history.atRest));
  return vec4(mix(clipped, light, 1.0 / samples), samples);
}

#ifdef VIEW
vec3 viewOf(ivec2 p, vec4 current) {
  const ResolvedHistory history = historyOf(p);
  switch (view) {
    case 0u: {
      if (current.a < 0.0 || history.light.a == 0.0) return vec3(0.0);
      const Clipped clipped = clippedHistory(history);
      const float share = 1.0 - 1.0 / max(clipped.outside, 1.0);
      return vec3(share * length(clipped.offset), share, clipped.outside > 1.0);
    }
    case 1u: return vec3(resolve(p, current, history).a, history.rejected, history.light.a == 0.0);
  }
  return vec3(0.0);
}
#endif

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  const ivec2 q = min(p, textureSize(filtered, 0) - 1);
#ifdef VIEW
  const vec4 current = filteredAt(q);
#else
  const vec4 current = filteredOrPassThroughAt(q);
#endif
  fillTile(q, current);
  if (p != q) return;

#ifdef VIEW
  imageStore(outView, p, vec4(hasSurface(p, current) ? viewOf(p, current) : vec3(0.0), 1.0));
#else
  if (!hasSurface(p, current)) {
#ifdef PACKED
    imageStore(outResolved, p, uvec4(0u));
#else
    imageStore(outResolved, p, vec4(current.rgb, 0.0));
#endif
    imageStore(outImage, p, vec4(current.rgb, 1.0));
    return;
  }
  const vec4 resolved = resolve(p, current, historyOf(p));
#ifdef PACKED
  const vec4 random = randomNumbers(p, frame.frameIndex, kResolvedSeed);
  const vec3 light = clamp(resolved.rgb, vec3(0.0), vec3(largestPacked(kResolvedBits)));
  imageStore(outResolved, p, uvec4(packResolved(vec4(light, resolved.a), longestLength(), random)));
  // No mean is made of the output, so that it does not matter how the store rounds.
  imageStore(outImage, p, vec4(light, 1.0));
#else
  const vec4 rounded = nearestHalf(max(resolved, vec4(0.0)));
  imageStore(outResolved, p, rounded);
  imageStore(outImage, p, vec4(rounded.rgb, 1.0));
#endif
#endif
}
