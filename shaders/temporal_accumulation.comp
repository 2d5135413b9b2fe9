// WALR preprocessing (walr.txt 4.2): reproject, reject, then a cumulative mean that turns exponential after a fixed
// number of samples. History is read bilinearly, each of the four taps tested on its own.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "constants/frame.h"
#include "constants/temporal_accumulation.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, std140) uniform frameConstants { FrameConstants frame; };
layout(set = 0, binding = 1) uniform texture2D lighting;
layout(set = 0, binding = 2) uniform texture2D motion;
layout(set = 0, binding = 3) uniform utexture2D depth;
layout(set = 0, binding = 4) uniform utexture2D normals;
layout(set = 0, binding = 5) uniform utexture2D previousDepth;
layout(set = 0, binding = 6) uniform utexture2D previousNormals;
layout(set = 0, binding = 7) uniform texture2D previousAccumulated;  // rgb: mean; a: history length.
layout(set = 0, binding = 8, rgba16f) uniform writeonly image2D outAccumulated;
layout(push_constant) uniform PushConstants { TemporalAccumulationConstants settings; };

#include "include/reprojection.glsl"

// Mean and length of the history behind pixel `p`; length 0 where there is none.
vec4 sampleHistory(ivec2 p, float z, vec3 normal) {
  const HistoryTaps taps = historyTaps(reproject(p, z, normal), settings.planeTolerance, settings.normalThreshold);
  vec4 mean = vec4(0.0);
  for (int i = 0; i < 4; ++i)
    if (taps.weights[i] > 0.0) mean += taps.weights[i] * texelFetch(previousAccumulated, historyTap(taps, i), 0);
  return mean;
}

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, textureSize(lighting, 0)))) return;

  const vec3 noisy = texelFetch(lighting, p, 0).rgb;
  const bool sampleIsFinite = isFinite(noisy);
  const float z = unpackDepth(texelFetch(depth, p, 0).x);
  if (z == 0.0) {
    imageStore(outAccumulated, p, vec4(sampleIsFinite ? noisy : vec3(0.0), 0.0));
    return;
  }

  const vec4 history = sampleHistory(p, z, unpackGeometricNormal(texelFetch(normals, p, 0).xy));
  // A sample that is not finite is no sample: the mean stays as it was.
  const float samples = min(history.a + (sampleIsFinite ? 1.0 : 0.0), settings.maxSamples);
  const vec3 radiance = clamp(noisy, vec3(0.0), vec3(kLargestHalf));
  const vec3 mean = sampleIsFinite ? mix(history.rgb, radiance, 1.0 / max(samples, 1.0)) : history.rgb;
  imageStore(outAccumulated, p, vec4(mean, samples));
}
