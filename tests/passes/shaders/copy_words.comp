// Copies a buffer of words, so that a test can read back a transient one.
#version 460

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform PushConstants { uint count; };
layout(std430, set = 0, binding = 0) readonly buffer source { uint from[]; };
layout(std430, set = 0, binding = 1) writeonly buffer target { uint to[]; };

void main() {
  const uint i = (gl_WorkGroupID.x * 64u) + gl_LocalInvocationIndex;
  if (i < count) to[i] = from[i];
}
