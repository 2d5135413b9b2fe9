// Sums over a workgroup of 64 threads. Needs the macro GROUP_SUM, the type of the numbers.
#ifndef WALR_GROUP_SUM_GLSL
#define WALR_GROUP_SUM_GLSL

const uint kGroupThreads = 64u;
shared GROUP_SUM groupSums[kGroupThreads];

// The sum of `value` over the workgroup, for all its threads, which must all call it. Each round leaves a quarter of
// the sums. Before another call the threads need a barrier.
GROUP_SUM sumOverGroup(GROUP_SUM value) {
  const uint thread = gl_LocalInvocationIndex;
  groupSums[thread] = value;
  barrier();
  [[unroll]] for (int round = 0; round < 3; ++round) {
    const uint n = kGroupThreads >> (2 * round + 2);
    if (thread < n) {
      groupSums[thread] = (groupSums[thread] + groupSums[thread + 2u * n]) +
                          (groupSums[thread + n] + groupSums[thread + 3u * n]);
    }
    barrier();
  }
  return groupSums[0];
}

#endif
