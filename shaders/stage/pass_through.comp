// Copies the lighting; values that are not finite become 0.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "stage/pass_through.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform texture2D lighting;
layout(rgba16f) uniform writeonly image2D outImage;

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, textureSize(lighting, 0)))) return;
  imageStore(outImage, p, vec4(passThroughLight(lighting, p), 1.0));
}
