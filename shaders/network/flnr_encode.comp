// What the network sees (samples/training/network.py, `features`): normal x and y, depth, ambient occlusion, light relative
// to the picture's mean, samples in the light; all 0 where there is no surface. With kShrink 2, each 2 x 2 pixels become one
// texel with a group of four channels for each of these; with kShrink 1, the eight of each pixel are two groups.
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "network/guide_network.h"
#include "common/halves.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool kAlphaIsSampleCount = false;
layout(constant_id = 1) const int kShrink = 2;  // Pixels per axis that become one texel.

#include "conventions/sampled_light.glsl"
#include "conventions/surface.glsl"
#define GROUP_SUM vec4
#include "common/group_sum.glsl"

uniform texture2D lighting;
uniform utexture2D depth;
uniform utexture2D features;
layout(std430) readonly buffer sums { vec4 tiles[]; };  // Of flnr_means.comp.
layout(std430) writeonly buffer outEncoded { uvec2 encoded[]; };

const float kSamplesScale = 1.0 / 16.0;

// Mean light of pixels that have some, mean inverse depth of surfaces.
vec2 meansOfPicture() {
  const ivec2 grid = (textureSize(depth, 0) + kMeansTile - 1) / kMeansTile;
  vec4 sum = vec4(0.0);
  for (int i = int(gl_LocalInvocationIndex); i < grid.x * grid.y; i += 64) sum += tiles[i];
  sum = sumOverGroup(sum);
  return sum.xz / max(sum.yw, vec2(1.0));
}

float[kNetworkFeatures] featuresOf(ivec2 p, vec2 means) {
  const float nothing[kNetworkFeatures] = float[](0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
  if (any(greaterThanEqual(p, textureSize(depth, 0)))) return nothing;
  const float z = unpackDepthBesideNormal(texelFetch(depth, p, 0).x);
  if (z == 0.0) return nothing;
  const NormalAndOcclusion surface = unpackNormalAndOcclusion(texelFetch(features, p, 0).x);
  const vec4 here = texelFetch(lighting, p, 0);
  const vec3 light = isSampled(here) ? clampedRadiance(here.rgb) : vec3(0.0);
  const vec3 relative = log(1.0 + light / max(means.x, 1e-30));
  return float[](surface.normal.x, surface.normal.y, 1.0 / (1.0 + z * means.y), surface.occlusion, relative.r, relative.g,
                 relative.b, samplesOf(here) * kSamplesScale);
}

void main() {
  const vec2 means = meansOfPicture();
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy), extent = (textureSize(depth, 0) + kShrink - 1) / kShrink;
  if (any(greaterThanEqual(p, extent))) return;
  if (kShrink == 1) {
    const float v[kNetworkFeatures] = featuresOf(p, means);
    encoded[halvesIndex(p, 0, extent)] = packHalves(vec4(v[0], v[1], v[2], v[3]));
    encoded[halvesIndex(p, 1, extent)] = packHalves(vec4(v[4], v[5], v[6], v[7]));
    return;
  }
  float values[4][kNetworkFeatures];
  for (int i = 0; i < 4; ++i) values[i] = featuresOf(2 * p + ivec2(i % 2, i / 2), means);
  for (int f = 0; f < kNetworkFeatures; ++f)
    encoded[halvesIndex(p, f, extent)] = packHalves(vec4(values[0][f], values[1][f], values[2][f], values[3][f]));
}
