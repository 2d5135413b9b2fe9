// WALR preprocessing (walr.txt 4.2): reproject, reject, then a cumulative mean that turns exponential after a fixed
// number of samples. Each of the four history pixels around the position is tested on its own (REJECT_BY_PLANE,
// REJECT_BY_DEPTH). KEEP_TAPS also writes which of them passed, so that later stages can read their histories in the same
// way without testing again (walr.txt 4.4, bmfr.txt 3.5). STILL: every pixel shows what it showed before.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "constants/frame.h"
#include "constants/temporal_accumulation.h"

layout(local_size_x = 8, local_size_y = 8) in;

#ifndef STILL
layout(constant_id = 2) const bool kBicubicHistory = false;
layout(set = 0, binding = 0, std140) uniform frameConstants { FrameConstants frame; };
#ifndef MOTION_FROM_CAMERA
layout(set = 0, binding = 2) uniform texture2D motion;
#endif
#endif
layout(set = 0, binding = 1) uniform texture2D lighting;
layout(set = 0, binding = 3) uniform utexture2D depth;
#if defined(REJECT_BY_PLANE) || defined(REJECT_BY_DEPTH)
layout(set = 0, binding = 4) uniform utexture2D previousDepth;
#endif
#ifdef REJECT_BY_PLANE
layout(set = 0, binding = 5) uniform utexture2D geometricNormal;
layout(set = 0, binding = 6) uniform utexture2D previousGeometricNormal;
#endif
layout(set = 0, binding = 7) uniform texture2D previousAccumulated;  // rgb: mean; a: history length.
layout(set = 0, binding = 8, rgba16f) uniform writeonly image2D outAccumulated;
#ifdef KEEP_TAPS
layout(set = 0, binding = 9, r32ui) uniform writeonly uimage2D outTaps;
#endif
layout(push_constant) uniform PushConstants { TemporalAccumulationConstants settings; };

#include "include/half.glsl"
#ifdef STILL
#include "include/surface.glsl"
#else
#include "include/bicubic.glsl"
#include "include/reprojection.glsl"
#endif

// Mean and length; length 0 where there is none.
#ifdef STILL
vec4 historyOf(ivec2 p, float z) { return texelFetch(previousAccumulated, p, 0); }
#else
HistoryTaps tapsOf(ivec2 p, float z) {
#ifdef REJECT_BY_PLANE
  const vec3 normal = unpackNormal(texelFetch(geometricNormal, p, 0).x);
#else
  const vec3 normal = vec3(0.0);
#endif
  const Reprojection r = reproject(p, z);
  const HistoryTaps taps = historyTaps(p, r, normal, settings.planeTolerance, settings.normalThreshold);
#ifdef KEEP_TAPS
  imageStore(outTaps, p, uvec4(packTaps(r.motion, taps.accepted)));
#endif
  return taps;
}

vec4 historyOf(ivec2 p, float z) {
  const HistoryTaps taps = tapsOf(p, z);
  return kBicubicHistory ? bicubicOfTaps(previousAccumulated, taps) : meanOfTaps(previousAccumulated, taps);
}
#endif

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, textureSize(lighting, 0)))) return;

  const vec3 noisy = texelFetch(lighting, p, 0).rgb;
  const bool sampleIsFinite = isFinite(noisy);
  const float z = unpackDepth(texelFetch(depth, p, 0).x);
  if (z == 0.0) {
    imageStore(outAccumulated, p, vec4(sampleIsFinite ? noisy : vec3(0.0), 0.0));
#ifdef KEEP_TAPS
    imageStore(outTaps, p, uvec4(kNoSurfaceTaps));
#endif
    return;
  }

  const vec4 history = historyOf(p, z);
  // A sample that is not finite is no sample: the mean stays as it was.
  const float samples = min(history.a + (sampleIsFinite ? 1.0 : 0.0), settings.maxSamples);
  const vec3 radiance = clamp(noisy, vec3(0.0), vec3(kLargestHalf));
  const vec3 mean = sampleIsFinite ? mix(history.rgb, radiance, 1.0 / max(samples, 1.0)) : history.rgb;
  imageStore(outAccumulated, p, nearestHalf(vec4(mean, samples)));
}
