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

float depthAt(ivec2 block) { return insideGrid(block) ? unpackDepth(texelFetch(depth, block, 0).x) : 0.0; }

float gaussian(int distance) {
  const float d = float(distance) / settings.coarseSigma;
  return exp(-0.5 * d * d);
}

// The depth to which the window's features are relative: the harmonic mean bounds them, because their mean is then 0.
float windowDepth(ivec2 block) {
  float weights = 0.0, inverse = 0.0;
  for (int i = -settings.coarseRadius; i <= settings.coarseRadius; ++i) {
    const float z = depthAt(block + i * kAxis);
    if (z == 0.0) continue;
    weights += gaussian(i);
    inverse += gaussian(i) / z;
  }
  return weights > 0.0 ? weights / inverse : 0.0;
}

void main() {
  const ivec2 block = ivec2(gl_GlobalInvocationID.xy);
  if (!insideGrid(block)) return;
  const uint packedDepth = packDepthSdf(windowDepth(block), 0u);
  const float z = unpackDepth(packedDepth);
  BlockMomentSum sum = emptySum();
  for (int i = -settings.coarseRadius; i <= settings.coarseRadius; ++i) {
    const float tapZ = depthAt(block + i * kAxis);
    if (tapZ == 0.0) continue;
    const BlockMoments tap = loadMoments(block + i * kAxis);
    if (tap.samples > 0.0) add(sum, gaussian(i), rescaleDepth(tap, z / tapZ));
  }
#ifdef LAST
  storeFit(block, fitOf(finish(sum)));
#else
  storeMoments(block, finish(sum));
#endif
  imageStore(outDepth, block, uvec4(packedDepth));
}
