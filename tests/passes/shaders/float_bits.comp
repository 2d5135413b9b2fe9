// Turns a texture of integers that holds the bits of floats into one of halves.
#version 460
#extension GL_EXT_samplerless_texture_functions : require

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform utexture2D source;
layout(set = 0, binding = 1, rgba16f) uniform writeonly image2D target;

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (all(lessThan(p, textureSize(source, 0)))) imageStore(target, p, vec4(uintBitsToFloat(texelFetch(source, p, 0).x)));
}
