// A sampler without a texture, which a graph cannot bind.
#version 460
layout(local_size_x = 8, local_size_y = 8) in;
uniform texture2D source;
uniform sampler nearest;
layout(r32f) uniform writeonly image2D target;

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  imageStore(target, p, textureLod(sampler2D(source, nearest), vec2(p), 0.0));
}
