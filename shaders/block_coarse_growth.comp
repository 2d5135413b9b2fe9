// The coarse fit's windows grown: those around a cell join its own where its fit foretells their light within the error of
// the means, but where the blocks' fits leave them nothing to say. Solves the regression.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "constants/block_regression.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant) uniform PushConstants { BlockRegressionConstants constants; };
#include "include/block_fit.glsl"
#include "include/block_growth.glsl"
#define BLOCK_MOMENTS_IN
#define BLOCK_FIT_OUT
#include "include/block_textures.glsl"
#include "include/coarse_window.glsl"

layout(constant_id = 3) const int kCellBlocks = 1;  // Per axis.
uniform utexture2D fitDepth;

const int kGrowthTaps = 5;          // Per axis.
const int kGrowthSpacing = 3;    // Cells.
const float kGrowthSigma = 1.2;  // Of their Gaussian weights, taps.
// Share of a window's variance that is taken for noise at least: slopes follow noise, too.
const float kLeastNoise = 0.05;
const float kPi = 3.14159265;

// A window and what its fit makes of others.
struct Window {
  BlockMoments moments;
  float slope[kFeatures];  // Of luminance.
  float noise;             // Share of the variance that the fit leaves.
  float pixels;            // As many as would have the same error at equal weights.
  float errors;            // Standard errors up to which others join in full: near occluders light varies faster.
};

Window windowOf(BlockMoments m) {
  Window w;
  w.moments = m;
  const vec3 slope[kFeatures] = slopesOf(m);
  float left = m.yy;
  for (int i = 0; i < kFeatures; ++i) {
    w.slope[i] = luminance(slope[i]);
    left -= w.slope[i] * luminance(m.yx[i]);
  }
  w.noise = m.yy > 0.0 ? clamp(left / m.yy, kLeastNoise, 1.0) : 1.0;
  const float paths = samplesPerPixel(m.samples);
  const float sigma = float(kCellSize) * coarseSigma(paths);
  // Where there is less than a path a pixel, some pixels have none.
  w.pixels = 4.0 * kPi * sigma * sigma * min(paths, 1.0);
  w.errors = constants.coarseGrowthErrors / (1.0 + constants.coarseGrowthOcclusion * max(m.x[kOcclusionFeature], 0.0));
  return w;
}

// Of another window's moments, which are relative to the same depth.
float sameLight(Window w, BlockMoments m) {
  float difference = luminance(m.y - w.moments.y);
  for (int i = 0; i < kFeatures; ++i) difference -= w.slope[i] * (m.x[i] - w.moments.x[i]);
  const float variance = w.noise * (w.moments.yy + m.yy) / w.pixels;
  return sameLight(difference, variance, luminance(w.moments.y + m.y), w.errors);
}

// Whether the fits of some block around a pixel that reads this cell want paths. Where none does, the rare pixel that lies
// on no block's plane reads a fit that has not grown.
bool isRead(ivec2 cell) {
  const int reach = kCellBlocks / 2 + 1;
  const ivec2 first = max(kCellBlocks * cell - reach, ivec2(0));
  const ivec2 last = min(kCellBlocks * (cell + 1) - 1 + reach, textureSize(fitDepth, 0) - 1);
  bool wanting = false;
  for (int y = first.y; y <= last.y; ++y) {
    for (int x = first.x; x <= last.x; ++x) {
      const uint packedDepth = texelFetch(fitDepth, ivec2(x, y), 0).x;
      wanting = wanting || (packedDepth != 0u && !hasConverged(packedDepth));
    }
  }
  return wanting;
}

BlockMoments grow(ivec2 cell, float z, BlockMoments own) {
  const Window window = windowOf(own);
  BlockMomentSum sum = emptySum();
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
  if (m.samples > 0.0 && isRead(cell)) m = grow(cell, unpackDepth(texelFetch(depth, cell, 0).x), m);
  storeFit(cell, fitOf(m));
}
