// Temporal anti-aliasing (passes/WALR.md, 9; Meunier & Harada 2022, 4.4): reads the history with a bicubic filter,
// clips it to the variance of the current neighbourhood, and adds the current frame. The cumulative mean turns
// exponential at `maxHistory`.
// KEPT_TAPS: reprojection comes from the taps that accumulation kept (history_taps.glsl). Otherwise it is done here, or
// with kStill, nothing moves and the history of a pixel is the pixel itself.
// PACKED: the filtered light and the history are packed light (packed_light.glsl); every surface has filtered light,
// and no other pixel has. The pass-through comes from the kept taps or from the host's lighting. The result is not
// packed.
// VIEW: does the same work and writes one of its intermediate values instead of the result.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_control_flow_attributes : require
#include "constants/frame.h"
#include "constants/temporal_antialiasing.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 2) const int kClipRadius = 1;  // Radius of the clipping neighbourhood, pixels.
#ifdef KEPT_TAPS
layout(constant_id = 3) const bool kRejectHistory = true;  // Leave out taps that accumulation rejected.
#endif

#ifdef PACKED
uniform utexture2D filtered;
uniform utexture2D previousResolved;  // rgb: mean; a: history length.
#else
uniform texture2D filtered;  // a: below 0 where the filter found no sample.
uniform texture2D previousResolved;  // rgb: mean; a: history length.
#endif
#ifdef VIEW
layout(constant_id = 8) const uint kView = 0;  // Which quantity; numbered in viewOf.
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
#ifdef KEPT_TAPS
uniform utexture2D keptTaps;
#else
layout(constant_id = 4) const bool kStill = false;
uniform texture2D motion;
uniform utexture2D depth;
uniform utexture2D previousDepth;
uniform utexture2D geometricNormal;
uniform utexture2D previousGeometricNormal;
uniform utexture2D objects;
uniform utexture2D previousObjects;
#endif
layout(push_constant) uniform PushConstants { TemporalAntialiasingConstants constants; };

#ifdef PACKED
#include "include/packed_light.glsl"
vec4 unpackHistory(uint packed) { return unpackResolved(packed, constants.maxHistory); }
vec4 filteredAt(ivec2 q) { return unpackFiltered(texelFetch(filtered, q, 0).x); }
#ifdef KEPT_TAPS
vec3 passThroughAt(ivec2 p) { return unpackPassThrough(texelFetch(keptTaps, p, 0).x); }
#elif !defined(VIEW)
#include "include/pass_through.glsl"
vec3 passThroughAt(ivec2 p) { return passThroughLight(passThrough, p); }
#endif
#else
vec4 filteredAt(ivec2 q) { return texelFetch(filtered, q, 0); }
#endif
#include "include/bicubic.glsl"
#include "include/half.glsl"

#ifdef KEPT_TAPS
const bool kStill = false;

HistoryTaps tapsOf(ivec2 p) {
  HistoryTaps taps = unpackTaps(p, texelFetch(keptTaps, p, 0).x, frame.previousPixelFromPixel);
  if (!kRejectHistory) taps.accepted = tapsInside(taps, textureSize(previousResolved, 0));
  return taps;
}
#else
#define HISTORY previousResolved
#define OBJECTS
#include "include/reprojection.glsl"

HistoryTaps tapsOf(ivec2 p) {
  vec3 normal = vec3(0.0);
  if (kRejectByPlane) normal = unpackNormal(texelFetch(geometricNormal, p, 0).x);
  const Reprojection r = reproject(p, unpackDepth(texelFetch(depth, p, 0).x));
  return historyTaps(p, r, normal, constants.planeTolerance, constants.normalThreshold);
}
#endif

vec4 historyOf(ivec2 p, out int rejected) {
  rejected = 0;
  if (kStill) return historyTexel(previousResolved, p);
  const HistoryTaps taps = tapsOf(p);
  rejected = tapsRejected(taps);
  return bicubicOfTaps(previousResolved, taps);
}

// Whether a pixel shows a surface. `colour`: its filtered colour.
#ifdef PACKED
bool hasSurface(ivec2 q, vec4 colour) { return colour.a >= 0.0; }
#elif defined(KEPT_TAPS)
bool hasSurface(ivec2 q, vec4 colour) { return texelFetch(keptTaps, q, 0).x != kNoSurfaceTaps; }
#else
bool hasSurface(ivec2 q, vec4 colour) { return unpackDepth(texelFetch(depth, q, 0).x) > 0.0; }
#endif

vec3 toYCoCg(vec3 c) {
  return vec3(0.25 * c.r + 0.5 * c.g + 0.25 * c.b, 0.5 * (c.r - c.b), -0.25 * c.r + 0.5 * c.g - 0.25 * c.b);
}
vec3 fromYCoCg(vec3 c) { return vec3(c.x + c.y - c.z, c.x + c.z, c.x - c.y - c.z); }

// Smallest half size of the clipping box around a mean: the rounding of history and neighbourhood. In a smaller box,
// where chroma hardly varies, that rounding would decide how much of the history's luma is kept.
#ifdef PACKED
float smallestHalfSize(vec3 mean) {
  const vec3 colour = fromYCoCg(mean);
  const float brightest = max(max(colour.r, colour.g), colour.b);
  return brightest / 128.0;  // At most one rounding step of the history; that of nine filtered colours is smaller.
}
#else
float smallestHalfSize(vec3 mean) { return 4.0 / 2048.0 * mean.x; }  // Rounding of four halves.
#endif

// A colour moved towards the mean until it is inside the box of half size `deviation` (Salvi 2016).
struct Clipped {
  vec3 colour;
  float outside;  // Distance from the mean before clipping, in units of the box's half size; above 1: clipped.
};

Clipped varianceClip(vec3 colour, vec3 mean, vec3 deviation) {
  const vec3 offset = colour - mean;
  const vec3 ratio = abs(offset) / max(deviation, vec3(1e-12));
  const float outside = max(max(ratio.x, ratio.y), ratio.z);
  return Clipped(outside > 1.0 ? mean + offset / outside : colour, outside);
}

// Mean and standard deviation of the surfaces around a pixel, in YCoCg and relative to the pixel's own colour, so that
// the variance of a flat neighbourhood is not lost in rounding.
struct Neighbourhood {
  vec3 mean;
  vec3 deviation;
};

Neighbourhood neighbourhoodOf(ivec2 p, vec3 centre) {
  vec3 sum = vec3(0.0), squares = vec3(0.0);
  float count = 0.0;
  const ivec2 last = textureSize(filtered, 0) - 1;
  const int width = 2 * kClipRadius + 1;
  for (int i = 0; i < width * width; ++i) {
    const ivec2 q = clamp(p + ivec2(i % width, i / width) - kClipRadius, ivec2(0), last);
    const vec4 colour = filteredAt(q);
    if (colour.a < 0.0 || !hasSurface(q, colour)) continue;
    const vec3 difference = toYCoCg(colour.rgb) - centre;
    sum += difference;
    squares += difference * difference;
    count += 1.0;
  }
  const vec3 mean = sum / count;
  return Neighbourhood(mean, sqrt(max(squares / count - mean * mean, vec3(0.0))));
}

// The history in YCoCg, clipped to the neighbourhood of the pixel.
Clipped clippedHistory(ivec2 p, vec3 current, vec3 history) {
  const vec3 centre = toYCoCg(current);
  const Neighbourhood n = neighbourhoodOf(p, centre);
  const vec3 halfSize = max(constants.clipGamma * n.deviation, vec3(smallestHalfSize(centre + n.mean)));
  return varianceClip(toYCoCg(history), centre + n.mean, halfSize);
}

// The new running mean and its history length.
vec4 resolve(ivec2 p, vec4 current, vec4 history) {
  // Without a sample in this frame the history stays as it is.
  if (current.a < 0.0) return history;
  if (history.a == 0.0) return vec4(current.rgb, 1.0);
  const vec3 clipped = clippedHistory(p, current.rgb, history.rgb).colour;
  const float samples = min(history.a + 1.0, constants.maxHistory);
  return vec4(max(mix(fromYCoCg(clipped), current.rgb, 1.0 / samples), vec3(0.0)), samples);
}

#ifdef VIEW
vec3 viewOf(ivec2 p, vec4 current) {
  int rejected;
  const vec4 history = historyOf(p, rejected);
  switch (kView) {
    case 0u: {
      if (current.a < 0.0 || history.a == 0.0) return vec3(0.0);
      const Clipped clipped = clippedHistory(p, current.rgb, history.rgb);
      const float outside = max(clipped.outside, 1.0);
      return vec3(distance(clipped.colour, toYCoCg(history.rgb)), 1.0 - 1.0 / outside, outside > 1.0);
    }
    case 1u: return vec3(resolve(p, current, history).a, rejected, history.a == 0.0);
  }
  return vec3(0.0);
}
#endif

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, textureSize(filtered, 0)))) return;

  const vec4 current = filteredAt(p);
#ifdef VIEW
  imageStore(outView, p, vec4(hasSurface(p, current) ? viewOf(p, current) : vec3(0.0), 1.0));
#else
  if (!hasSurface(p, current)) {
#ifdef PACKED
    imageStore(outResolved, p, uvec4(0u));
    imageStore(outImage, p, vec4(passThroughAt(p), 1.0));
#else
    imageStore(outResolved, p, vec4(current.rgb, 0.0));
    imageStore(outImage, p, vec4(current.rgb, 1.0));
#endif
    return;
  }
  int rejected;
  const vec4 resolved = resolve(p, current, historyOf(p, rejected));
  const vec4 rounded = nearestHalf(resolved);
#ifdef PACKED
  const vec4 random = randomNumbers(p, frame.frameIndex, kResolvedSeed);
  imageStore(outResolved, p, uvec4(packResolved(resolved, constants.maxHistory, random)));
#else
  imageStore(outResolved, p, rounded);
#endif
  imageStore(outImage, p, vec4(rounded.rgb, 1.0));
#endif
}
