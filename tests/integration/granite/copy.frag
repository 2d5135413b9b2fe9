#version 450
// Copies a texture in place of drawing a scene. A second texture, if it is another one, comes below the first.
layout(set = 0, binding = 0) uniform sampler2D first;
layout(set = 0, binding = 1) uniform sampler2D second;
layout(location = 0) out vec4 colour;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  int height = textureSize(first, 0).y;
  colour = pixel.y < height ? texelFetch(first, pixel, 0) : texelFetch(second, pixel - ivec2(0, height), 0);
}
