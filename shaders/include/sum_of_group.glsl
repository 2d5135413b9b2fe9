// The sum of a value over the 64 threads of a work group, always in the same order.
#ifndef WALR_SUM_OF_GROUP_GLSL
#define WALR_SUM_OF_GROUP_GLSL

shared vec4 partialSums[64];

// All threads must call it, once.
vec4 sumOfGroup(vec4 value) {
  const uint thread = gl_LocalInvocationIndex;
  partialSums[thread] = value;
  barrier();
  for (uint count = 32u; count > 0u; count /= 2u) {
    if (thread < count) partialSums[thread] += partialSums[thread + count];
    barrier();
  }
  return partialSums[0];
}

#endif
