// Moments of square cells of pixels: the grid of the coarse fit, in which every sample counts, whichever its surface.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "include/block_storage.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const int kCellSize = 8;  // Pixels per axis.

layout(set = 0, binding = 1) uniform utexture2D depth;
layout(set = 0, binding = 2) uniform utexture2D shadingNormal;
layout(set = 0, binding = 4) uniform texture2D occlusion;
layout(set = 0, binding = 5) uniform texture2D accumulated;
#define BLOCK_MOMENTS_OUT
#include "include/block_textures.glsl"
#include "include/light.glsl"
#include "include/window_depth.glsl"

ivec2 pixelOf(ivec2 cell, int i) { return kCellSize * cell + ivec2(i % kCellSize, i / kCellSize); }

// 0 outside the image and where it shows no surface.
float depthAt(ivec2 p) {
  return all(lessThan(p, textureSize(depth, 0))) ? unpackDepth(texelFetch(depth, p, 0).x) : 0.0;
}

void main() {
  const ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(kCellSize * cell, textureSize(depth, 0)))) return;
  WindowDepth window = WindowDepth(0.0, 0.0);
  for (int i = 0; i < kCellSize * kCellSize; ++i) add(window, 1.0, depthAt(pixelOf(cell, i)));
  const uint packedDepth = packDepthSdf(harmonicMean(window), 0u);
  const float z = unpackDepth(packedDepth);
  BlockMomentSum sum = emptySum();
  for (int i = 0; i < kCellSize * kCellSize; ++i) {
    const ivec2 p = pixelOf(cell, i);
    const float zp = depthAt(p);
    if (zp == 0.0) continue;
    const vec4 mean = lightAt(p);
    if (mean.a == 0.0) continue;
    const vec3 shading = unpackNormal(texelFetch(shadingNormal, p, 0).x);
    add(sum, 1.0, onePixel(featuresOf(shading, z / zp - 1.0, texelFetch(occlusion, p, 0).x), mean.rgb, mean.a));
  }
  storeMoments(cell, finish(sum));
  imageStore(outDepth, cell, uvec4(packedDepth));
}
