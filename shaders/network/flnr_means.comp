// What the network's inputs are relative to (flnr_encode.comp): sums over tiles of the picture, always in the same order.
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "network/guide_network.h"
#include "conventions/surface.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool kAlphaIsSampleCount = false;
#include "conventions/sampled_light.glsl"

uniform texture2D lighting;
uniform utexture2D depth;
layout(std430) writeonly buffer outSums { vec4 sums[]; };  // Of a tile: light, pixels with light, inverse depth, surfaces.

#define GROUP_SUM vec4
#include "common/group_sum.glsl"

void main() {
  const ivec2 extent = textureSize(depth, 0);
  const ivec2 corner = ivec2(gl_WorkGroupID.xy) * kMeansTile + ivec2(gl_LocalInvocationID.xy);
  vec4 sum = vec4(0.0);
  for (int i = 0; i < kMeansTile; ++i) {
    const ivec2 p = corner + 8 * ivec2(i % 8, i / 8);
    if (any(greaterThanEqual(p, extent))) continue;
    const float z = unpackDepthBesideNormal(texelFetch(depth, p, 0).x);
    const vec4 light = texelFetch(lighting, p, 0);
    if (z == 0.0) continue;
    sum.zw += vec2(1.0 / z, 1.0);
    if (!isSampled(light)) continue;
    sum.xy += vec2(dot(clampedRadiance(light.rgb), vec3(1.0 / 3.0)), 1.0);
  }
  sum = sumOverGroup(sum);
  if (gl_LocalInvocationIndex == 0u) sums[gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x] = sum;
}
