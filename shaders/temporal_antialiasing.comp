// WALR postprocessing (walr.txt 4.4): reproject the filtered history with a bicubic filter, pull it into the variance of
// the current neighbourhood, then a cumulative mean that turns exponential after a fixed number of frames.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "constants/frame.h"
#include "constants/temporal_antialiasing.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 2) const int kClipRadius = 1;  // Half the neighbourhood of the variance clipping, pixels.

layout(set = 0, binding = 0, std140) uniform frameConstants { FrameConstants frame; };
layout(set = 0, binding = 1) uniform texture2D filtered;
layout(set = 0, binding = 2) uniform texture2D motion;
layout(set = 0, binding = 3) uniform utexture2D depth;
layout(set = 0, binding = 4) uniform utexture2D geometricNormal;
layout(set = 0, binding = 5) uniform utexture2D previousDepth;
layout(set = 0, binding = 6) uniform utexture2D previousGeometricNormal;
layout(set = 0, binding = 7) uniform texture2D previousResolved;  // rgb: mean; a: history length.
layout(set = 0, binding = 8, rgba16f) uniform writeonly image2D outResolved;
layout(set = 0, binding = 9, rgba16f) uniform writeonly image2D outImage;
layout(push_constant) uniform PushConstants { TemporalAntialiasingConstants settings; };

#include "include/bicubic.glsl"
#include "include/half.glsl"
#include "include/reprojection.glsl"

vec3 toYCoCg(vec3 c) {
  return vec3(0.25 * c.r + 0.5 * c.g + 0.25 * c.b, 0.5 * (c.r - c.b), -0.25 * c.r + 0.5 * c.g - 0.25 * c.b);
}
vec3 fromYCoCg(vec3 c) { return vec3(c.x + c.y - c.z, c.x + c.z, c.x - c.y - c.z); }

// Half size of the smallest clipping box, in units of luma: the rounding of the four halves that a history and a
// neighbourhood are made of. Where chroma hardly varies, a smaller box would let that rounding decide how much history
// of the luma is kept.
const float kLeastReach = 4.0 / 2048.0;

// Pull `colour` towards the mean until it is inside the box of `gamma` standard deviations (Salvi 2016).
vec3 varianceClip(vec3 colour, vec3 mean, vec3 deviation) {
  const vec3 offset = colour - mean;
  const vec3 ratio = abs(offset) / max(deviation, vec3(1e-12));
  const float outside = max(max(ratio.x, ratio.y), ratio.z);
  return outside > 1.0 ? mean + offset / outside : colour;
}

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, textureSize(filtered, 0)))) return;

  const vec3 current = texelFetch(filtered, p, 0).rgb;
  const float z = unpackDepth(texelFetch(depth, p, 0).x);
  if (z == 0.0) {
    imageStore(outResolved, p, vec4(current, 0.0));
    imageStore(outImage, p, vec4(current, 1.0));
    return;
  }

  const Reprojection r = reproject(p, z, unpackNormal(texelFetch(geometricNormal, p, 0).x));
  const HistoryTaps taps = historyTaps(r, settings.planeTolerance, settings.normalThreshold);
  vec3 resolved = current;
  float samples = 1.0;
  if (taps.any) {
    const vec4 history = bicubicOfTaps(previousResolved, taps);
    const vec3 centre = toYCoCg(current);
    vec3 sum = vec3(0.0), squares = vec3(0.0);
    float count = 0.0;
    const ivec2 last = textureSize(filtered, 0) - 1;
    const int width = 2 * kClipRadius + 1;
    for (int i = 0; i < width * width; ++i) {
      const ivec2 q = clamp(p + ivec2(i % width, i / width) - kClipRadius, ivec2(0), last);
      if (unpackDepth(texelFetch(depth, q, 0).x) == 0.0) continue;
      // Relative to the centre, so that the variance of a flat neighbourhood does not drown in rounding.
      const vec3 difference = toYCoCg(texelFetch(filtered, q, 0).rgb) - centre;
      sum += difference;
      squares += difference * difference;
      count += 1.0;
    }
    const vec3 mean = sum / count;
    const vec3 deviation = sqrt(max(squares / count - mean * mean, vec3(0.0)));
    const vec3 reach = max(settings.clipGamma * deviation, vec3(kLeastReach * (centre + mean).x));
    const vec3 clipped = varianceClip(toYCoCg(history.rgb), centre + mean, reach);
    samples = min(history.a + 1.0, settings.maxSamples);
    resolved = max(mix(fromYCoCg(clipped), current, 1.0 / samples), vec3(0.0));
  }
  const vec4 stored = nearestHalf(vec4(resolved, samples));
  imageStore(outResolved, p, stored);
  imageStore(outImage, p, vec4(stored.rgb, 1.0));
}
