// Writes the history length of every pixel for the host: frames, with this one's sample.
// A texel of accumulated light stands for kColumns x kRows pixels, which all get its length.
// PACKED: accumulated light is packed (packed_light.glsl).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require

layout(local_size_x = 8, local_size_y = 8) in;

layout(constant_id = 1) const int kColumns = 1;
layout(constant_id = 2) const int kRows = 1;
layout(r16f) uniform writeonly image2D historyLength;
#ifdef PACKED
#include "conventions/packed_light.glsl"
uniform utexture2D accumulated;
float lengthAt(ivec2 p) { return unpackAccumulated(texelFetch(accumulated, p, 0).x).a; }
#else
uniform texture2D accumulated;
layout(constant_id = 0) const uint kChannel = 3;  // That holds the length.
float lengthAt(ivec2 p) { return texelFetch(accumulated, p, 0)[kChannel]; }
#endif

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, imageSize(historyLength)))) return;
  imageStore(historyLength, p, vec4(lengthAt(p / ivec2(kColumns, kRows)), 0.0, 0.0, 1.0));
}
