// Writes the arguments of an indirect dispatch of `x` times `y` work groups.
#version 460
layout(local_size_x = 1) in;
layout(set = 0, binding = 0, std430) writeonly buffer Arguments { uint groups[3]; } arguments;
layout(push_constant) uniform Push { uint x; uint y; } push;

void main() {
  arguments.groups[0] = push.x;
  arguments.groups[1] = push.y;
  arguments.groups[2] = 1;
}
