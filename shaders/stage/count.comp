// Sums the components of a view, which hold counts, over all pixels. CLEAR: sets all counters to zero before the first
// sum.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "stage/count.h"

#ifdef CLEAR
layout(local_size_x = 64) in;
layout(std430) writeonly buffer counters { uint words[]; };

void main() {
  for (uint i = gl_LocalInvocationIndex; i < kCounterWords; i += gl_WorkGroupSize.x) words[i] = 0u;
}
#else
layout(local_size_x = 8, local_size_y = 8) in;
layout(std430) buffer counters { uint words[]; };
uniform texture2D view;
layout(push_constant) uniform PushConstants { CountConstants constants; };

shared uint partial[3];

void main() {
  if (gl_LocalInvocationIndex < 3u) partial[gl_LocalInvocationIndex] = 0u;
  barrier();
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (all(lessThan(p, textureSize(view, 0)))) {
    const uvec3 counts = uvec3(texelFetch(view, p, 0).xyz);
    for (int c = 0; c < 3; ++c)
      if (counts[c] > 0u) atomicAdd(partial[c], counts[c]);
  }
  barrier();
  if (gl_LocalInvocationIndex < 3u) {
    const uint sum = partial[gl_LocalInvocationIndex];
    if (sum > 0u) atomicAdd(words[constants.word + gl_LocalInvocationIndex], sum);
  }
}
#endif
