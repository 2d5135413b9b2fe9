// The number of rays in each row of a traced image: the path tracer stores that of a pixel in alpha. One work group a row.
#version 460
#extension GL_EXT_samplerless_texture_functions : require

layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform texture2D lighting;
layout(set = 0, binding = 1, std430) writeonly buffer Rays { uint rays[]; };

shared uint sums[gl_WorkGroupSize.x];

void main() {
  const uint thread = gl_LocalInvocationID.x;
  const int row = int(gl_WorkGroupID.y);
  const int width = textureSize(lighting, 0).x;
  uint sum = 0u;
  for (int x = int(thread); x < width; x += int(gl_WorkGroupSize.x)) sum += uint(texelFetch(lighting, ivec2(x, row), 0).a);
  sums[thread] = sum;
  for (uint stride = gl_WorkGroupSize.x / 2u; stride > 0u; stride /= 2u) {
    barrier();
    if (thread < stride) sums[thread] += sums[thread + stride];
  }
  if (thread == 0u) rays[row] = sums[0];
}
