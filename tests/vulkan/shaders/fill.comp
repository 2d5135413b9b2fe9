// target = value + 100 y + x.
#version 460
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, r32ui) uniform writeonly uimage2D target;
layout(push_constant) uniform Push { uint value; } push;

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, imageSize(target)))) return;
  imageStore(target, p, uvec4(push.value + 100u * uint(p.y) + uint(p.x)));
}
