// One axis of the Gaussian window of the coarse fit, which no edge stops (flr-flnr.txt). The vertical pass (LAST)
// solves the regression in place.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "constants/block_regression.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant) uniform PushConstants { BlockRegressionConstants settings; };
#include "include/block_fit.glsl"
#define BLOCK_MOMENTS_IN
#ifdef LAST
#define BLOCK_FIT_OUT
const ivec2 kAxis = ivec2(0, 1);
#else
#define BLOCK_MOMENTS_OUT
const ivec2 kAxis = ivec2(1, 0);
#endif
#include "include/block_textures.glsl"
#include "include/window_depth.glsl"

float depthAt(ivec2 cell) { return insideGrid(cell) ? unpackDepth(texelFetch(depth, cell, 0).x) : 0.0; }

float gaussian(int distance) {
  const float d = float(distance) / settings.coarseSigma;
  return exp(-0.5 * d * d);
}

void main() {
  const ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
  if (!insideGrid(cell)) return;
  WindowDepth window = WindowDepth(0.0, 0.0);
  for (int i = -settings.coarseRadius; i <= settings.coarseRadius; ++i) {
    add(window, gaussian(i), depthAt(cell + i * kAxis));
  }
  const uint packedDepth = packDepthSdf(harmonicMean(window), 0u);
  const float z = unpackDepth(packedDepth);
  BlockMomentSum sum = emptySum();
  for (int i = -settings.coarseRadius; i <= settings.coarseRadius; ++i) {
    const float tapZ = depthAt(cell + i * kAxis);
    if (tapZ == 0.0) continue;
    const BlockMoments tap = loadMoments(cell + i * kAxis);
    if (tap.samples > 0.0) add(sum, gaussian(i), rescaleDepth(tap, z / tapZ));
  }
#ifdef LAST
  storeFit(cell, fitOf(finish(sum)));
#else
  storeMoments(cell, finish(sum));
#endif
  imageStore(outDepth, cell, uvec4(packedDepth));
}
