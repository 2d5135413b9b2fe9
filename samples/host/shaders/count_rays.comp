// The number of rays in each row of a traced image: the path tracer stores that of a pixel in alpha. One work group a row.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#define GROUP_SUM uint
#include "common/group_sum.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform texture2D lighting;
layout(set = 0, binding = 1, std430) writeonly buffer Rays { uint rays[]; };

void main() {
  const uint thread = gl_LocalInvocationID.x;
  const int row = int(gl_WorkGroupID.y);
  const int width = textureSize(lighting, 0).x;
  uint sum = 0u;
  for (int x = int(thread); x < width; x += int(gl_WorkGroupSize.x)) sum += uint(texelFetch(lighting, ivec2(x, row), 0).a);
  const uint rowSum = sumOverGroup(sum);
  if (thread == 0u) rays[row] = rowSum;
}
