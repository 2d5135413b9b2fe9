// target = source + value. The source is a sampled or a storage image.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
layout(local_size_x = 8, local_size_y = 8) in;
#ifdef STORAGE_SOURCE
layout(set = 0, binding = 0, r32ui) uniform readonly uimage2D source;
uint fetch(ivec2 p) { return imageLoad(source, p).x; }
#else
layout(set = 0, binding = 0) uniform utexture2D source;
uint fetch(ivec2 p) { return texelFetch(source, p, 0).x; }
#endif
layout(set = 0, binding = 1, r32ui) uniform writeonly uimage2D target;
layout(push_constant) uniform Push { uint value; } push;

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, imageSize(target)))) return;
  imageStore(target, p, uvec4(fetch(p) + push.value));
}
