// Counts of a work group, added to those of the picture. All threads call clearCounts() first and addCounts() last.
// Needs: kFirstCount and kCounts, the words of a shader, and the buffer `words`.
#ifndef WALR_LINT_COUNTS_GLSL
#define WALR_LINT_COUNTS_GLSL

shared uint partial[kCounts];

void clearCounts() {
  const uint threads = gl_WorkGroupSize.x * gl_WorkGroupSize.y;
  for (uint i = gl_LocalInvocationIndex; i < kCounts; i += threads) partial[i] = 0u;
  barrier();
}

void count(uint word, bool condition) {
  if (condition) atomicAdd(partial[word - kFirstCount], 1u);
}

void addCounts() {
  barrier();
  const uint threads = gl_WorkGroupSize.x * gl_WorkGroupSize.y;
  for (uint i = gl_LocalInvocationIndex; i < kCounts; i += threads)
    if (partial[i] > 0u) atomicAdd(words[kFirstCount + i], partial[i]);
}

#endif
