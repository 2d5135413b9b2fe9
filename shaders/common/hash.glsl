// Integer hashes.
#ifndef WALR_HASH_GLSL
#define WALR_HASH_GLSL

// pcg4d (Jarzynski & Olano 2020).
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

// 32 random bits for every pixel, frame and seed. Cheaper than pcg4d: all of its products per pixel have factors of 24
// bits, which some GPUs multiply four times as fast as 32. `p` is below 2^24.
uint hashOfPixel(uvec2 p, uint frameIndex, uint seed) {
  uint h = p.x * 0x9e3779u + p.y * 0xc2b2afu + (frameIndex * 0x85ebca6bu + seed * 0x27d4eb2fu);
  h = (h >> 8) * 0xb5297bu;
  h = ((h ^ h >> 13) & 0xffffffu) * 0x68e31du;
  return h ^ h >> 16;
}

// Uniformly distributed in 0 .. count - 1.
uint hashBelow(uvec4 seed, uint count) {
  uint high, low;
  umulExtended(pcg4d(seed).x, count, high, low);
  return high;
}

#endif
