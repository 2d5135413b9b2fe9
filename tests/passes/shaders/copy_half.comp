// Copies a texture of halves unchanged, so that a test can read back a transient one.
#version 460
#extension GL_EXT_samplerless_texture_functions : require

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform texture2D source;
layout(set = 0, binding = 1, rgba16f) uniform writeonly image2D target;

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (all(lessThan(p, textureSize(source, 0)))) imageStore(target, p, texelFetch(source, p, 0));
}
