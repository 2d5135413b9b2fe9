// Passes that do nothing but fetch texels of 8 bytes.
//
// STREAM: every texel of the texture once, four a thread: bytes a second.
// CACHED: 64 fetches a thread from a window that its work group shares: fetches a second.
// CHAIN: one work group whose threads fetch 256 texels, each where the one before says: time of a fetch.
#version 460
#extension GL_EXT_samplerless_texture_functions : require

layout(local_size_x = 8, local_size_y = 8) in;
uniform utexture2D source;  // Width and height are powers of two.
layout(std430) writeonly buffer Result { uint result[]; };

// Without a use of the sum, the compiler would leave out the fetches. The condition is practically never true.
void use(uvec2 sum) {
  if (sum == uvec2(0x5eed5eedu, 0xfee1deadu)) result[0] = sum.x;
}

void main() {
  const ivec2 size = textureSize(source, 0);
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  uvec2 sum = uvec2(0);
#if defined(STREAM)
  const int rows = size.y / 4;
  if (p.x >= size.x || p.y >= rows) return;
  for (int i = 0; i < 4; ++i) sum += texelFetch(source, p + ivec2(0, i * rows), 0).xy;
#elif defined(CACHED)
  const ivec2 base = ivec2(gl_WorkGroupID.xy) * 8;
  for (int i = 0; i < 64; ++i) {
    const ivec2 within = (p + ivec2(i & 7, i >> 3)) & 7;
    sum += texelFetch(source, (base + within) & (size - 1), 0).xy;
  }
#else
  uvec2 next = uvec2(p);
  for (int i = 0; i < 256; ++i) next = texelFetch(source, ivec2(next & uvec2(size - 1)), 0).xy + uvec2(i);
  sum = next;
#endif
  use(sum);
}
