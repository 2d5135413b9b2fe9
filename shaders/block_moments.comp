// Moments of each block of pixels: a random one of its surfaces stands for the block, and the samples that lie on that
// pixel's plane are averaged.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "constants/block_regression.h"
#include "constants/frame.h"
#include "include/block_storage.glsl"
#include "include/hash.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const int kBlockSize = 4;  // Pixels per axis, at most 4.

layout(set = 0, binding = 0, std140) uniform frameConstants { FrameConstants frame; };
layout(set = 0, binding = 1) uniform utexture2D depth;
layout(set = 0, binding = 2) uniform utexture2D shadingNormal;
layout(set = 0, binding = 3) uniform utexture2D geometricNormal;
layout(set = 0, binding = 4) uniform texture2D occlusion;
layout(set = 0, binding = 5) uniform texture2D accumulated;
#define BLOCK_MOMENTS_OUT
#include "include/block_textures.glsl"
layout(set = 0, binding = 18, r32ui) uniform writeonly uimage2D outNormal;
layout(push_constant) uniform PushConstants { BlockRegressionConstants settings; };
#include "include/plane.glsl"
#include "include/block_plane.glsl"
#include "include/light.glsl"

// A random pixel of the block with a surface; false where it shows none.
bool chooseRepresentative(ivec2 block, out int pixel) {
  uint surfaces = 0u;
  for (int i = 0; i < kBlockSize * kBlockSize; ++i) {
    const ivec2 p = kBlockSize * block + ivec2(i % kBlockSize, i / kBlockSize);
    if (any(greaterThanEqual(p, textureSize(depth, 0))) || unpackDepth(texelFetch(depth, p, 0).x) == 0.0) continue;
    ++surfaces;
    if (hashBelow(uvec4(block, frame.frameIndex, i), surfaces) == 0u) pixel = i;
  }
  return surfaces > 0u;
}

void main() {
  const ivec2 block = ivec2(gl_GlobalInvocationID.xy);
  const ivec2 size = textureSize(depth, 0);
  if (any(greaterThanEqual(kBlockSize * block, size))) return;

  int pixel;
  if (!chooseRepresentative(block, pixel)) {
    storeMoments(block, noSamples());
    imageStore(outDepth, block, uvec4(0u));
    imageStore(outNormal, block, uvec4(0u));
    return;
  }
  const ivec2 centre = kBlockSize * block + ivec2(pixel % kBlockSize, pixel / kBlockSize);
  const vec3 normal = unpackNormal(texelFetch(geometricNormal, centre, 0).x);
  const float z = unpackDepth(texelFetch(depth, centre, 0).x);
  const Plane plane = planeAt(centre, z, normal);
  BlockMomentSum sum = emptySum();
  for (int i = 0; i < kBlockSize * kBlockSize; ++i) {
    const ivec2 p = kBlockSize * block + ivec2(i % kBlockSize, i / kBlockSize);
    if (any(greaterThanEqual(p, size))) continue;
    const float zp = unpackDepth(texelFetch(depth, p, 0).x);
    const vec4 mean = lightAt(p);
    if (zp == 0.0 || mean.a == 0.0) continue;
    const float weight =
        onPlane(planeDistance(plane, p, zp)) * facing(normal, unpackNormal(texelFetch(geometricNormal, p, 0).x));
    if (weight <= 0.0) continue;
    const vec3 shading = unpackNormal(texelFetch(shadingNormal, p, 0).x);
    add(sum, weight, onePixel(featuresOf(shading, z / zp - 1.0, texelFetch(occlusion, p, 0).x), mean.rgb, mean.a));
  }
  storeMoments(block, finish(sum));
  imageStore(outDepth, block, uvec4(packDepthSdf(z, 0u)));
  imageStore(outNormal, block, uvec4(packBlockNormal(normal, uint(pixel))));
}
