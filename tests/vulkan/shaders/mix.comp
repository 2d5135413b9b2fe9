// Writes a hash of everything that it reads, so that a single wrong texel anywhere changes the final result.
// Variants differ in their bindings. tests/vulkan/random_graph.cpp computes the same on the CPU.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
layout(local_size_x = 8, local_size_y = 8) in;

#if SAMPLED > 0
layout(set = 0, binding = 0) uniform utexture2D sampled0;
#endif
#if SAMPLED > 1
layout(set = 0, binding = 1) uniform utexture2D sampled1;
#endif
#if SAMPLED > 2
layout(set = 0, binding = 2) uniform utexture2D sampled2;
#endif
#ifdef LOADED
layout(set = 0, binding = 3, r32ui) uniform readonly uimage2D loaded0;
#endif
#ifdef UPDATED
layout(set = 0, binding = 4, r32ui) uniform uimage2D updated0;
#endif
#if STORED > 0
layout(set = 0, binding = 5, r32ui) uniform writeonly uimage2D stored0;
#endif
#if STORED > 1
layout(set = 0, binding = 6, r32ui) uniform writeonly uimage2D stored1;
#endif
#ifdef BUFFER_IN
layout(set = 0, binding = 7, std430) readonly buffer BufferIn { uint values[]; } bufferIn;
#endif
#ifdef BUFFER_OUT
layout(set = 0, binding = 8, std430) writeonly buffer BufferOut { uint values[]; } bufferOut;
#endif
#ifdef UNIFORM
layout(set = 0, binding = 9) uniform Frame { uint value; } frame;
#endif
layout(push_constant) uniform Push { uint seed; uint width; uint height; } push;

// PCG hash: Jarzynski and Olano 2020.
uint hash(uint x) {
  const uint state = x * 747796405u + 2891336453u;
  const uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return (word >> 22u) ^ word;
}

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  const ivec2 size = ivec2(push.width, push.height);
  if (any(greaterThanEqual(p, size))) return;
  const int index = p.y * size.x + p.x;
  uint h = hash(push.seed + uint(index));
#if SAMPLED > 0
  h = hash(h ^ texelFetch(sampled0, p % textureSize(sampled0, 0), 0).x);
#endif
#if SAMPLED > 1
  h = hash(h ^ texelFetch(sampled1, p % textureSize(sampled1, 0), 0).x);
#endif
#if SAMPLED > 2
  h = hash(h ^ texelFetch(sampled2, p % textureSize(sampled2, 0), 0).x);
#endif
#ifdef LOADED
  h = hash(h ^ imageLoad(loaded0, p % imageSize(loaded0)).x);
#endif
#ifdef BUFFER_IN
  h = hash(h ^ bufferIn.values[index % bufferIn.values.length()]);
#endif
#ifdef UNIFORM
  h = hash(h ^ frame.value);
#endif
#ifdef UPDATED
  h = hash(h ^ imageLoad(updated0, p).x);
  imageStore(updated0, p, uvec4(h + 1u));
#endif
#if STORED > 0
  imageStore(stored0, p, uvec4(h + 2u));
#endif
#if STORED > 1
  imageStore(stored1, p, uvec4(h + 3u));
#endif
#ifdef BUFFER_OUT
  bufferOut.values[index] = h + 4u;
#endif
}
