// Fills a buffer with numbers that no hardware can compress.
#version 460

layout(local_size_x = 64) in;
layout(std430) writeonly buffer Noise { uint noise[]; };

// The finalizer of MurmurHash3 (Appleby): every bit depends on all bits of the index.
uint scrambled(uint x) {
  x = (x ^ (x >> 16)) * 0x85ebca6bu;
  x = (x ^ (x >> 13)) * 0xc2b2ae35u;
  return x ^ (x >> 16);
}

void main() {
  const uint row = gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  const uint index = gl_GlobalInvocationID.y * row + gl_GlobalInvocationID.x;
  if (index < uint(noise.length())) noise[index] = scrambled(index);
}
