// Keeps the host's object ids for the next frame: id + 1 where there is a surface to denoise, else 0. A history that
// holds nothing yet is thus without objects, and the host's 0xffffffff, no object, becomes 0.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "conventions/surface.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform utexture2D depth;
uniform utexture2D objectId;
layout(r32ui) uniform writeonly uimage2D outObjects;

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, textureSize(depth, 0)))) return;
  const bool surface = unpackDepth(texelFetch(depth, p, 0).x) > 0.0;
  imageStore(outObjects, p, uvec4(surface ? texelFetch(objectId, p, 0).x + 1u : 0u));
}
