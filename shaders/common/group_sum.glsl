// Sums over a workgroup of 64 threads. Needs the macro GROUP_SUM, the type of the numbers.
#ifndef WALR_GROUP_SUM_GLSL
#define WALR_GROUP_SUM_GLSL

const uint kGroupThreads = 64u;
shared GROUP_SUM groupSums[kGroupThreads];

const uint kPartialSums = 8u;

// The sum of eight values in shared memory, `stride` apart.
GROUP_SUM sumOfEight(uint first, uint stride) {
  GROUP_SUM pairs[4];
  [[unroll]] for (uint i = 0u; i < 4u; ++i) {
    pairs[i] = groupSums[first + 2u * i * stride] + groupSums[first + (2u * i + 1u) * stride];
  }
  return (pairs[0] + pairs[1]) + (pairs[2] + pairs[3]);
}

// The sum of `value` over the workgroup, for all its threads, which must all call it. Before another call the threads
// need a barrier. Two rounds of eight values wait for fewer barriers than more rounds of fewer values.
GROUP_SUM sumOverGroup(GROUP_SUM value) {
  const uint thread = gl_LocalInvocationIndex;
  groupSums[thread] = value;
  barrier();
  if (thread < kPartialSums) groupSums[thread] = sumOfEight(thread, kPartialSums);
  barrier();
  return sumOfEight(0u, 1u);
}

#endif
