// current = previous + 1. Also writes the age of the history, which is a push constant.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0) uniform utexture2D previous;
layout(set = 0, binding = 1, r32ui) uniform writeonly uimage2D current;
layout(set = 0, binding = 2, r32ui) uniform writeonly uimage2D toldAge;
layout(push_constant) uniform Push { uint unrelated; uint age; } push;

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, imageSize(current)))) return;
  imageStore(current, p, texelFetch(previous, p, 0) + 1u);
  imageStore(toldAge, p, uvec4(push.age + push.unrelated));
}
