// WALR, moments of blocks and cells (passes/WALR.md, 4). A random pixel of a block, its representative pixel, gives the
// block its depth and normal. Pixels of the block count by their number of samples, the edge-stopping function of that
// pixel's plane, and the cosine between the normals.
// The moments of cells, the grid of the coarse fit, count every pixel by its number of samples alone, whichever its
// surface.
// PACKED: `accumulated` is packed light (packed_light.glsl).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "constants/block_regression.h"
#include "constants/frame.h"
#include "include/block_storage.glsl"
#include "include/hash.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const int kBlockSize = 4;   // Pixels per axis.
layout(constant_id = 1) const int kCellBlocks = 2;  // Blocks per axis: a power of two, at most 8.

layout(std140) uniform frameConstants { FrameConstants frame; };
uniform utexture2D depth;
uniform utexture2D features;
uniform utexture2D geometricNormal;
#ifdef PACKED
uniform utexture2D accumulated;
#else
uniform texture2D accumulated;
#endif
#define BLOCK_MOMENTS_OUT
#define CELL_MOMENTS_OUT
#include "include/block_textures.glsl"
layout(r32ui) uniform writeonly uimage2D outNormal;
layout(push_constant) uniform PushConstants { BlockRegressionConstants constants; };
#include "include/plane.glsl"
#include "include/block_plane.glsl"
#include "include/light.glsl"
#include "include/window_depth.glsl"

// Chooses a random one of the block's pixels with a surface; false if there is none. Each of the surfaces is equally
// likely (reservoir sampling).
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

// What a block contributes to its cell: moments with their depth, and the depths of all of its pixels.
struct CellPart {
  BlockMoments moments;
  float depth;
  WindowDepth window;
};
const int kSide = int(gl_WorkGroupSize.x);
shared CellPart parts[kSide * kSide];

void storeBlock(ivec2 block, BlockMoments m, uint packedDepth, uint packedNormal) {
  storeMoments(block, m);
  imageStore(outDepth, block, uvec4(packedDepth));
  imageStore(outNormal, block, uvec4(packedNormal));
}

CellPart momentsOfBlock(ivec2 block) {
  CellPart part = CellPart(noSamples(), 0.0, WindowDepth(0.0, 0.0));
  int pixel;
  if (!chooseRepresentative(block, pixel)) {
    storeBlock(block, noSamples(), 0u, 0u);
    return part;
  }
  const ivec2 centre = kBlockSize * block + ivec2(pixel % kBlockSize, pixel / kBlockSize);
  const uint shortNormal = packShortNormal(unpackNormal(texelFetch(geometricNormal, centre, 0).x));
  const vec3 normal = unpackShortNormal(shortNormal);
  const float z = unpackDepth(texelFetch(depth, centre, 0).x);
  const Plane plane = planeAt(centre, z, normal);
  BlockMomentSum onItsPlane = emptySum(), all = emptySum();
  for (int i = 0; i < kBlockSize * kBlockSize; ++i) {
    const ivec2 p = kBlockSize * block + ivec2(i % kBlockSize, i / kBlockSize);
    if (any(greaterThanEqual(p, textureSize(depth, 0)))) continue;
    const float zp = unpackDepth(texelFetch(depth, p, 0).x);
    add(part.window, 1.0, zp);
    const vec4 mean = lightAt(p);
    if (zp == 0.0 || mean.a == 0.0) continue;
    const NormalAndOcclusion shading = unpackNormalAndOcclusion(texelFetch(features, p, 0).x);
    const BlockMoments sampled = onePixel(featuresOf(shading, z / zp - 1.0), mean.rgb, mean.a);
    const float weight = edgeStopping(planeDistance(plane, p, zp)) * normalCosine(normal, shading.normal);
    if (weight > 0.0) add(onItsPlane, weight, sampled);
    add(all, 1.0, sampled);
  }
  storeBlock(block, finish(onItsPlane), packDepthSdf(z, 0u), packBlockNormal(shortNormal, uint(pixel)));
  part.moments = finish(all);
  part.depth = z;
  return part;
}

// `first`: the upper left block of the cell in the workgroup.
void storeCell(ivec2 cell, ivec2 first) {
  WindowDepth window = WindowDepth(0.0, 0.0);
  for (int i = 0; i < kCellBlocks * kCellBlocks; ++i) {
    const ivec2 block = first + ivec2(i % kCellBlocks, i / kCellBlocks);
    const WindowDepth w = parts[block.y * kSide + block.x].window;
    window.weights += w.weights;
    window.inverse += w.inverse;
  }
  const uint packedDepth = packDepthSdf(harmonicMean(window), 0u);
  const float z = unpackDepth(packedDepth);
  BlockMomentSum sum = emptySum();
  for (int i = 0; i < kCellBlocks * kCellBlocks; ++i) {
    const ivec2 block = first + ivec2(i % kCellBlocks, i / kCellBlocks);
    const CellPart part = parts[block.y * kSide + block.x];
    if (part.moments.samples > 0.0) add(sum, 1.0, rescaleDepth(part.moments, z / part.depth));
  }
  storeCellMoments(cell, finish(sum));
  imageStore(outCellDepth, cell, uvec4(packedDepth));
}

void main() {
  const ivec2 block = ivec2(gl_GlobalInvocationID.xy);
  const bool inside = all(lessThan(kBlockSize * block, textureSize(depth, 0)));
  CellPart part = CellPart(noSamples(), 0.0, WindowDepth(0.0, 0.0));
  if (inside) part = momentsOfBlock(block);
  parts[gl_LocalInvocationIndex] = part;
  barrier();
  if (inside && block % kCellBlocks == ivec2(0)) storeCell(block / kCellBlocks, ivec2(gl_LocalInvocationID.xy));
}
