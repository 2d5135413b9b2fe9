// Fits in storage buffers, as the reconstruction reads them (passes/WALR.md, 8).
#ifndef WALR_STORED_FIT_GLSL
#define WALR_STORED_FIT_GLSL
#include "regression/block_moments.glsl"
#include "regression/block_storage.glsl"
#include "regression/stored_fit.h"

// Unit of the colours that stored fits predict: the brightest light that a prediction can have, 510 steps of packed
// filtered light (packed_light.glsl). A prediction is clamped to 0..1, which GPUs do as part of the last addition, and
// needs no other clamp to be packed.
const float kLightUnit = 65280.0;

// Index of a block or cell in a buffer of fits.
uint gridIndex(ivec2 texel, ivec2 grid) { return uint(texel.y * grid.x + texel.x); }

float halfOf(StoredFit fit, int i) { return unpackHalf2x16(fit.slope[i / 8][i / 2 % 4])[i % 2]; }

// W in units of kSampleCountUnit.
float samplesOf(StoredFit fit) { return halfOf(fit, 15); }

// Compares integers: where all threads of a work group ask about the same fit, GPUs with scalar units do it once.
bool hasSamples(StoredFit fit) { return fit.slope[1].w >> 16 != 0u; }

vec3 slopeOf(StoredFit fit, int feature) {
  return vec3(halfOf(fit, 3 * feature), halfOf(fit, 3 * feature + 1), halfOf(fit, 3 * feature + 2));
}

// Features of a pixel in units of kLightUnit, so that the product with a slope is in this unit.
struct ScaledFeatures {
  NormalAndOcclusion guides;
  float inverseDepth;
};

ScaledFeatures scaledFeatures(NormalAndOcclusion guides, float z) {
  const float scale = 1.0 / kLightUnit;
  const float leastDepth = 1e-18;  // The depth of a fit over a smaller one could overflow.
  return ScaledFeatures(NormalAndOcclusion(scale * guides.normal, scale * guides.occlusion), scale / max(z, leastDepth));
}

// In units of kLightUnit.
vec3 evaluate(StoredFit fit, ScaledFeatures pixel) {
  const float x[kFeatures] = featuresOf(pixel.guides, fit.constant.a * pixel.inverseDepth - 1.0 / kLightUnit);
  vec3 colour = fit.constant.rgb;
  for (int i = 0; i < kFeatures; ++i) colour += slopeOf(fit, i) * x[i];
  return colour;
}

// Distance of the position at depth `z` on a view ray from the plane of a block, in units of the block's depth: delta of
// passes/WALR.md, 4.
float planeDistance(StoredBlockFit block, vec3 ray, float z) { return abs(z * dot(block.plane.xyz, ray) - block.plane.w); }

// Cosine between the plane's normal and another one; 0 where they face away from each other, and where there is no fit.
float planeCosine(StoredBlockFit block, vec3 normal) {
  return clamp(block.fit.constant.a * dot(block.plane.xyz, normal), 0.0, 1.0);
}

#endif
