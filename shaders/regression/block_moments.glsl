// Moments of blocks (passes/WALR.md, 4) with five features X: the shading normal, the depth feature and ambient
// occlusion. The depth feature is the depth of the block over that of the sample, less 1: an inverse depth, which is
// linear over the image of a plane. Relative to the block's own depth, halves hold it precisely at any scale; before a
// merge, the other block's moments are rescaled.
#ifndef WALR_BLOCK_MOMENTS_GLSL
#define WALR_BLOCK_MOMENTS_GLSL
#include "common/finite.glsl"
#include "common/luminance.glsl"
#include "conventions/surface.glsl"

const int kFeatures = 5;
const int kDepthFeature = 3;
const int kOcclusionFeature = 4;
const int kCovariances = kFeatures * (kFeatures + 1) / 2;
#include "common/triangle.glsl"

// In passes/WALR.md these are the means of X and m, S_XX, S_Xm, var and W.
struct BlockMoments {
  float x[kFeatures];       // Means of the features.
  vec3 y;                   // Mean of the colour.
  float xx[kCovariances];   // Covariances of the features: the upper triangle, row by row.
  vec3 yx[kFeatures];       // Covariances of the colour with each feature.
  float yy;                 // Variance of the colour's luminance.
  float samples;            // W: sum of weight times history length over the pixels.
};

// The largest ratio of two depths in the depth feature. What is nearer counts as that near: halves hold the square of the
// feature, and a pixel with an absurd depth stays one pixel among others.
const float kMostDepthRatio = 256.0;

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

// The same moments with the depth feature relative to `ratio` times its former reference depth.
BlockMoments rescaleDepth(BlockMoments m, float ratio) {
  const float scale = min(ratio, kMostDepthRatio);
  m.x[kDepthFeature] = scale * (m.x[kDepthFeature] + 1.0) - 1.0;
  m.yx[kDepthFeature] *= scale;
  for (int i = 0; i <= kDepthFeature; ++i) m.xx[triangleEntry(kDepthFeature, i)] *= scale;
  for (int i = kDepthFeature; i < kFeatures; ++i) m.xx[triangleEntry(i, kDepthFeature)] *= scale;
  return m;
}

// Weighted merge of centred moments. Means are taken relative to an origin close to them, so that little is lost to
// rounding where a variance is small.
struct BlockMomentSum {
  float originX[kFeatures];
  vec3 originY;
  BlockMoments sum;
};

void add(inout BlockMomentSum s, float weight, BlockMoments m) {
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

// Adds one pixel, whose own moments are its features and its light.
void addPixel(inout BlockMomentSum s, float weight, float x[kFeatures], vec3 y) {
  const vec3 dy = y - s.originY;
  for (int i = 0; i < kFeatures; ++i) {
    const float wx = weight * (x[i] - s.originX[i]);
    s.sum.x[i] += wx;
    s.sum.yx[i] += wx * dy;
    for (int j = 0; j < kFeatures; ++j) {
      if (j < i) continue;
      s.sum.xx[triangleEntry(j, i)] += wx * (x[j] - s.originX[j]);
    }
  }
  const float dl = luminance(dy);
  s.sum.yy += weight * dl * dl;
  s.sum.y += weight * dy;
  s.sum.samples += weight;
}

BlockMomentSum emptySum(float originX[kFeatures], vec3 originY) {
  return BlockMomentSum(originX, originY, noSamples());
}

// About the means of these moments.
BlockMomentSum emptySum(BlockMoments origin) { return emptySum(origin.x, origin.y); }

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
