#version 450
// Copies textures in place of drawing a scene.
layout(set = 0, binding = 0) uniform sampler2D sources[5];
layout(location = 0) out vec4 lighting;
layout(location = 1) out float depth;
layout(location = 2) out vec4 normal;
layout(location = 3) out vec4 motion;
layout(location = 4) out vec4 albedo;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  lighting = texelFetch(sources[0], pixel, 0);
  depth = texelFetch(sources[1], pixel, 0).x;
  normal = texelFetch(sources[2], pixel, 0);
  motion = texelFetch(sources[3], pixel, 0);
  albedo = texelFetch(sources[4], pixel, 0);
}
