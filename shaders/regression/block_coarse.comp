// WALR, coarse fit (passes/WALR.md, 6): averages the moments of cells with one axis of a separable Gaussian that no
// edge ends (after Salmi et al. 2024). The Gaussian is wider where the cell has fewer samples.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "regression/block_regression.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool kVertical = false;

layout(push_constant) uniform PushConstants { BlockRegressionConstants constants; };
#define BLOCK_MOMENTS_IN
#define BLOCK_MOMENTS_OUT
#include "regression/block_textures.glsl"
#include "regression/coarse_window.glsl"
#include "regression/window_depth.glsl"

float gaussian(int distance, float sigma) {
  const float d = float(distance) / sigma;
  return exp(-0.5 * d * d);
}

void main() {
  const ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
  if (!insideGrid(cell)) return;
  const ivec2 axis = kVertical ? ivec2(0, 1) : ivec2(1, 0);
  const BlockMoments own = loadMoments(cell);
  const float sigma = coarseSigma(samplesPerPixel(own.samples));
  const int radius = int(ceil(constants.coarseReach * sigma));
  WindowDepth window = WindowDepth(0.0, 0.0);
  float weights = 0.0;
  for (int i = -radius; i <= radius; ++i) {
    const ivec2 q = cell + i * axis;
    if (!insideGrid(q)) continue;
    weights += gaussian(i, sigma);
    add(window, gaussian(i, sigma), unpackDepth(texelFetch(depth, q, 0).x));
  }
  const uint packedDepth = packDepthSdf(harmonicMean(window), 0u);
  const float z = unpackDepth(packedDepth);
  BlockMomentSum sum = emptySum(own);
  for (int i = -radius; i <= radius; ++i) {
    const ivec2 q = cell + i * axis;
    if (!insideGrid(q)) continue;
    const float tapZ = unpackDepth(texelFetch(depth, q, 0).x);
    if (tapZ == 0.0) continue;
    const BlockMoments tap = loadMoments(q);
    if (tap.samples > 0.0) add(sum, gaussian(i, sigma) / weights, rescaleDepth(tap, z / tapZ));
  }
  storeMoments(cell, packBlock(finish(sum)));
  imageStore(outDepth, cell, uvec4(packedDepth));
}
