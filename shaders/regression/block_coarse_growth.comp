// WALR, growth of the coarse fit and its solve (passes/WALR.md, 7): the windows around a cell, on 5 x 5 growth taps 3
// cells apart, are merged into the cell's own window if the fit of the cell predicts their light within the standard
// errors of the means. Cells that only converged blocks would read do not grow: these blocks give the coarse fit no
// share.
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "regression/block_regression.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant) uniform PushConstants { BlockRegressionConstants constants; };
#include "regression/block_fit.glsl"
#include "regression/block_growth.glsl"
#define BLOCK_MOMENTS_IN
#include "regression/block_textures.glsl"
#include "regression/coarse_window.glsl"

layout(constant_id = 3) const int kCellBlocks = 1;  // Per axis.
uniform utexture2D fitDepth;
layout(std430) writeonly buffer outFits { StoredFit fits[]; };

const int kGrowthTaps = 5;          // Per axis, the cell itself among them.
const int kGrowthSpacing = 3;    // Cells.
const float kGrowthSigma = 1.2;  // Standard deviation of their Gaussian weights, in taps.
// The noise is at least this share of a window's variance: slopes fit noise, too, and so make it look smaller.
const float kLeastNoise = 0.05;
const float kPi = 3.14159265;

// The window of a cell, and how to compare others with it.
struct Window {
  BlockMoments moments;
  float slope[kFeatures];  // Of luminance.
  float noise;             // Share of the variance that the fit leaves unexplained.
  float pixels;            // Effective number of pixels: as many equal weights would give the same standard error.
  float errors;            // Standard errors up to which others join in full; fewer near occluders.
};

Window windowOf(BlockMoments m) {
  Window w;
  w.moments = m;
  const vec3 slope[kFeatures] = slopesOf(m);
  float unexplained = m.yy;
  for (int i = 0; i < kFeatures; ++i) {
    w.slope[i] = luminance(slope[i]);
    unexplained -= w.slope[i] * luminance(m.yx[i]);
  }
  w.noise = m.yy > 0.0 ? clamp(unexplained / m.yy, kLeastNoise, 1.0) : 1.0;
  const float density = samplesPerPixel(m.samples);
  const float sigma = float(kCellSize) * coarseSigma(density);
  // Some pixels have no light: those that the light grid does not show, and below one sample per pixel others.
  w.pixels = 4.0 * kPi * sigma * sigma * min(density, constants.lightShare);
  w.errors = constants.coarseGrowthErrors / (1.0 + constants.coarseGrowthOcclusion * max(m.x[kOcclusionFeature], 0.0));
  return w;
}

// Growth weight of another window. `m` must be relative to the same depth as the moments of `w`.
float sameLight(Window w, BlockMoments m) {
  float difference = luminance(m.y - w.moments.y);
  for (int i = 0; i < kFeatures; ++i) difference -= w.slope[i] * (m.x[i] - w.moments.x[i]);
  const float variance = w.noise * (w.moments.yy + m.yy) / w.pixels;
  return sameLight(difference, variance, luminance(w.moments.y + m.y), w.errors);
}

// Whether any block that shares a pixel with this cell in the reconstruction has not converged. If all have, only the
// rare pixel that lies on no block's plane reads this cell, and it reads a fit that has not grown.
bool isRead(ivec2 cell) {
  const int reach = kCellBlocks / 2 + 1;
  const ivec2 first = max(kCellBlocks * cell - reach, ivec2(0));
  const ivec2 last = min(kCellBlocks * (cell + 1) - 1 + reach, textureSize(fitDepth, 0) - 1);
  bool unconverged = false;
  for (int y = first.y; y <= last.y; ++y) {
    for (int x = first.x; x <= last.x; ++x) {
      const uint packedDepth = texelFetch(fitDepth, ivec2(x, y), 0).x;
      unconverged = unconverged || (packedDepth != 0u && !hasConverged(packedDepth));
    }
  }
  return unconverged;
}

BlockMoments grow(ivec2 cell, float z, BlockMoments own) {
  const Window window = windowOf(own);
  BlockMomentSum sum = emptySum(own);
  add(sum, 1.0, own);
  for (int i = 0; i < kGrowthTaps * kGrowthTaps; ++i) {
    const ivec2 tap = ivec2(i % kGrowthTaps, i / kGrowthTaps) - kGrowthTaps / 2;
    const ivec2 q = cell + kGrowthSpacing * tap;
    if (tap == ivec2(0) || !insideGrid(q)) continue;
    const float tapZ = unpackDepth(texelFetch(depth, q, 0).x);
    if (tapZ == 0.0) continue;
    const BlockMoments m = rescaleDepth(loadMoments(q), z / tapZ);
    const float distance = length(vec2(tap)) / kGrowthSigma;
    if (m.samples > 0.0) add(sum, exp(-0.5 * distance * distance) * sameLight(window, m), m);
  }
  return finish(sum);
}

void main() {
  const ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
  if (!insideGrid(cell)) return;
  BlockMoments m = loadMoments(cell);
  const float z = unpackDepth(texelFetch(depth, cell, 0).x);
  if (m.samples > 0.0 && isRead(cell)) m = grow(cell, z, m);
  fits[gridIndex(cell, textureSize(depth, 0))] = fitOf(m, z);
}
