// Storage of blocks: forty halves of moments in five RGBA32_UINT textures, and the depth and normal of the
// representative pixel.
#ifndef WALR_BLOCK_STORAGE_GLSL
#define WALR_BLOCK_STORAGE_GLSL
#include "regression/block_moments.glsl"
#include "common/half.glsl"
#include "conventions/surface.glsl"

struct PackedBlock {
  uvec4 word[5];
};

// Moments are this many numbers.
const int kMoments = 40;

// In this order: means of the features and the colour, covariances of the features, W, covariances with the colour, and
// the variance of luminance.
float[kMoments] numbersOf(BlockMoments m) {
  float numbers[kMoments];
  for (int i = 0; i < kFeatures; ++i) {
    numbers[i] = m.x[i];
    for (int c = 0; c < 3; ++c) numbers[24 + 3 * i + c] = m.yx[i][c];
  }
  for (int c = 0; c < 3; ++c) numbers[5 + c] = m.y[c];
  for (int k = 0; k < kCovariances; ++k) numbers[8 + k] = m.xx[k];
  numbers[23] = m.samples;
  numbers[39] = m.yy;
  return numbers;
}

BlockMoments momentsOf(float numbers[kMoments]) {
  BlockMoments m;
  for (int i = 0; i < kFeatures; ++i) {
    m.x[i] = numbers[i];
    m.yx[i] = vec3(numbers[24 + 3 * i], numbers[25 + 3 * i], numbers[26 + 3 * i]);
  }
  m.y = vec3(numbers[5], numbers[6], numbers[7]);
  for (int k = 0; k < kCovariances; ++k) m.xx[k] = numbers[8 + k];
  m.samples = numbers[23];
  m.yy = numbers[39];
  return m;
}

// W is stored in units of this many samples, because a window may hold more samples than the largest half.
const float kSampleCountUnit = 64.0;

// As a variance may overflow halves, they hold the standard deviation of luminance.
PackedBlock packBlock(BlockMoments m) {
  m.samples /= kSampleCountUnit;
  m.yy = sqrt(m.yy);
  const float h[kMoments] = numbersOf(m);
  PackedBlock p;
  for (int i = 0; i < kMoments / 2; ++i) p.word[i / 4][i % 4] = packHalves(h[2 * i], h[2 * i + 1]);
  return p;
}

BlockMoments unpackBlock(PackedBlock p) {
  float h[kMoments];
  for (int i = 0; i < kMoments / 2; ++i) {
    const vec2 pair = unpackHalf2x16(p.word[i / 4][i % 4]);
    h[2 * i] = pair.x;
    h[2 * i + 1] = pair.y;
  }
  BlockMoments m = momentsOf(h);
  m.samples *= kSampleCountUnit;
  m.yy *= m.yy;
  return m;
}

// The representative pixel: the block stores its depth as pixels do (surface.glsl), and its geometric normal together
// with its index in the block.
uint packBlockNormal(uint shortNormal, uint pixel) { return shortNormal | pixel << 16; }
vec3 blockNormal(uint packed) { return unpackShortNormal(packed); }
ivec2 representativePixel(ivec2 block, int blockSize, uint packedNormal) {
  const int pixel = int(packedNormal >> 16);
  return blockSize * block + ivec2(pixel % blockSize, pixel / blockSize);
}

// Depth of a fit and whether the fit has converged, that is, holds so many samples that the coarse fit gets no share
// (coarse_share.glsl). The flag takes the bits in which moments have the distance to an edge.
uint packFitDepth(float depth, bool converged) { return packDepthSdf(depth, uint(converged)); }
bool hasConverged(uint packedDepth) { return unpackSdf(packedDepth) != 0u; }

#endif
