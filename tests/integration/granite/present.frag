#version 450
layout(set = 0, binding = 0) uniform sampler2D denoised;
layout(location = 0) out vec4 colour;

void main() {
  colour = texelFetch(denoised, ivec2(gl_FragCoord.xy), 0);
}
