// Moments of blocks (passes/WALR.md, 4) with five features X: the shading normal, the depth feature and ambient
// occlusion. The depth feature is the depth of the block over that of the sample, less 1: an inverse depth, which is
// linear over the image of a plane. Relative to the block's own depth, halves hold it precisely at any scale; before a
// merge, the other block's moments are rescaled.
#ifndef WALR_BLOCK_MOMENTS_GLSL
#define WALR_BLOCK_MOMENTS_GLSL
#include "finite.glsl"
#include "luminance.glsl"
#include "surface.glsl"

const int kFeatures = 5;
const int kDepthFeature = 3;
const int kOcclusionFeature = 4;
const int kCovariances = kFeatures * (kFeatures + 1) / 2;
#include "triangle.glsl"

struct BlockMoments {
  float x[kFeatures];       // Means of the features.
  vec3 y;                   // Mean of the colour.
  float xx[kCovariances];   // Covariances of the features: the upper triangle, row by row.
  vec3 yx[kFeatures];       // Covariances of the colour with each feature.
  float yy;                 // Variance of the colour's luminance.
  float samples;            // W: sum of weight times history length over the pixels.
};

float[kFeatures] featuresOf(NormalAndOcclusion s, float relativeDepth) {
  return float[](s.normal.x, s.normal.y, s.normal.z, relativeDepth, s.occlusion);
}

BlockMoments noSamples() {
  BlockMoments m;
  for (int i = 0; i < kFeatures; ++i) {
    m.x[i] = 0.0;
    m.yx[i] = vec3(0.0);
  }
  for (int k = 0; k < kCovariances; ++k) m.xx[k] = 0.0;
  m.y = vec3(0.0);
  m.yy = 0.0;
  m.samples = 0.0;
  return m;
}

// Moments of one pixel whose light is the mean of `samples` samples.
BlockMoments onePixel(float x[kFeatures], vec3 colour, float samples) {
  BlockMoments m = noSamples();
  m.x = x;
  m.y = colour;
  m.samples = samples;
  return m;
}

// The same moments with the depth feature relative to `scale` times its former reference depth.
BlockMoments rescaleDepth(BlockMoments m, float scale) {
  m.x[kDepthFeature] = scale * (m.x[kDepthFeature] + 1.0) - 1.0;
  m.yx[kDepthFeature] *= scale;
  for (int i = 0; i <= kDepthFeature; ++i) m.xx[triangleEntry(kDepthFeature, i)] *= scale;
  for (int i = kDepthFeature; i < kFeatures; ++i) m.xx[triangleEntry(i, kDepthFeature)] *= scale;
  return m;
}

// Weighted merge of centred moments. Means are taken relative to the first moments added, as in moments.glsl.
struct BlockMomentSum {
  float originX[kFeatures];
  vec3 originY;
  BlockMoments sum;
};

void add(inout BlockMomentSum s, float weight, BlockMoments m) {
  if (s.sum.samples == 0.0) {
    s.originX = m.x;
    s.originY = m.y;
  }
  const float w = weight * m.samples;
  const vec3 dy = m.y - s.originY;
  for (int i = 0; i < kFeatures; ++i) {
    const float dx = m.x[i] - s.originX[i];
    s.sum.x[i] += w * dx;
    s.sum.yx[i] += w * (m.yx[i] + dx * dy);
    for (int j = 0; j < kFeatures; ++j) {
      if (j < i) continue;
      const int k = triangleEntry(j, i);
      s.sum.xx[k] += w * (m.xx[k] + dx * (m.x[j] - s.originX[j]));
    }
  }
  const float dl = luminance(dy);
  s.sum.yy += w * (m.yy + dl * dl);
  s.sum.y += w * dy;
  s.sum.samples += w;
}

BlockMomentSum emptySum() {
  BlockMomentSum s;
  s.sum = noSamples();
  s.originX = s.sum.x;
  s.originY = s.sum.y;
  return s;
}

BlockMoments finish(BlockMomentSum s) {
  if (s.sum.samples <= 0.0) return noSamples();
  const float scale = 1.0 / s.sum.samples;
  const vec3 dy = s.sum.y * scale;
  BlockMoments m;
  for (int i = 0; i < kFeatures; ++i) {
    const float dx = s.sum.x[i] * scale;
    m.x[i] = s.originX[i] + dx;
    m.yx[i] = s.sum.yx[i] * scale - dx * dy;
    for (int j = 0; j < kFeatures; ++j) {
      if (j < i) continue;
      const int k = triangleEntry(j, i);
      m.xx[k] = s.sum.xx[k] * scale - dx * (s.sum.x[j] * scale);
    }
  }
  const float dl = luminance(dy);
  m.yy = max(s.sum.yy * scale - dl * dl, 0.0);
  m.y = s.originY + dy;
  m.samples = s.sum.samples;
  return m;
}

#endif
