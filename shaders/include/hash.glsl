// The integer hash pcg4d (Jarzynski & Olano 2020).
#ifndef WALR_HASH_GLSL
#define WALR_HASH_GLSL

uvec4 pcg4d(uvec4 v) {
  v = v * 1664525u + 1013904223u;
  v.x += v.y * v.w;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v.w += v.y * v.z;
  v ^= v >> 16;
  v.x += v.y * v.w;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v.w += v.y * v.z;
  return v;
}

// Uniformly distributed in 0 .. count - 1.
uint hashBelow(uvec4 seed, uint count) {
  uint high, low;
  umulExtended(pcg4d(seed).x, count, high, low);
  return high;
}

#endif
