// WALR, reconstruction (passes/WALR.md, 8): the light of every pixel, predicted from the pixel's own features by the
// fits around it.
// Fine: the fits of the four blocks around the pixel, with bilinear weights times the edge-stopping function of each
// block's plane. Coarse: the fits of the four cells around it, with bilinear weights. The share of the coarse fits is
// large where the windows of the fine fits have few samples (coarse_share.glsl).
// A pixel without a surface gets the pass-through.
// PACKED: the result is packed light (packed_light.glsl). A pixel without a surface then gets a mark, and the reader of
// the result writes the pass-through.
// VIEW: does the same work and writes one of its intermediate values instead of the result. With VIEW, PACKED says that
// `accumulated` is packed.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_control_flow_attributes : require
#include "constants/block_regression.h"
#include "constants/frame.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const int kBlockSize = 4;  // Pixels per axis.
layout(constant_id = 2) const int kCellSize = 8;   // Pixels per axis.

layout(std140) uniform frameConstants { FrameConstants frame; };
uniform utexture2D depth;
uniform utexture2D features;
uniform utexture2D fitA;
uniform utexture2D fitB;
uniform utexture2D fitC;
uniform utexture2D fitDepth;
uniform utexture2D fitNormal;
uniform utexture2D coarseA;
uniform utexture2D coarseB;
uniform utexture2D coarseC;
uniform utexture2D coarseDepth;
#ifdef VIEW
layout(constant_id = 8) const uint kView = 0;  // Which quantity; numbered in viewOf.
layout(rgba32f) uniform writeonly image2D outView;
#ifdef PACKED
uniform utexture2D accumulated;
#else
uniform texture2D accumulated;
#endif
#elif defined(PACKED)
layout(r32ui) uniform writeonly uimage2D outFiltered;
#else
uniform texture2D passThrough;
layout(rgba16f) uniform writeonly image2D outFiltered;
#endif
layout(push_constant) uniform PushConstants { BlockRegressionConstants constants; };
#include "include/block_fit.glsl"
#include "include/block_plane.glsl"
#include "include/coarse_share.glsl"
#include "include/plane.glsl"
#ifdef VIEW
#include "include/light.glsl"
#elif defined(PACKED)
#include "include/packed_light.glsl"
#else
#include "include/half.glsl"
#include "include/pass_through.glsl"
#endif

struct Prediction {
  vec3 colour;    // Weighted sum.
  float samples;  // Weighted sum.
  float weight;
#ifdef VIEW
  vec3 slope[kFeatures];  // Weighted sums.
  bvec3 negative;         // Whether a fit is below 0, by channel.
#endif
};

Prediction noPrediction() {
  Prediction sum;
  sum.colour = vec3(0.0);
  sum.samples = 0.0;
  sum.weight = 0.0;
#ifdef VIEW
  for (int i = 0; i < kFeatures; ++i) sum.slope[i] = vec3(0.0);
  sum.negative = bvec3(false);
#endif
  return sum;
}

void add(inout Prediction sum, float weight, BlockFit fit, float x[kFeatures]) {
  if (weight <= 0.0 || fit.samples <= 0.0) return;
  sum.colour += weight * max(evaluate(fit, x), vec3(0.0));
  sum.samples += weight * fit.samples;
  sum.weight += weight;
#ifdef VIEW
  for (int i = 0; i < kFeatures; ++i) sum.slope[i] += weight * fit.slope[i];
  const bvec3 below = lessThan(evaluate(fit, x), vec3(0.0));
  sum.negative = bvec3(sum.negative.r || below.r, sum.negative.g || below.g, sum.negative.b || below.b);
#endif
}

BlockFit loadFine(ivec2 block) {
  return unpackFit(PackedFit(texelFetch(fitA, block, 0), texelFetch(fitB, block, 0), texelFetch(fitC, block, 0)));
}
BlockFit loadCoarse(ivec2 block) {
  return unpackFit(
      PackedFit(texelFetch(coarseA, block, 0), texelFetch(coarseB, block, 0), texelFetch(coarseC, block, 0)));
}

// Mean sample count W of the fine fits.
float fineSamples(Prediction fine) { return fine.weight > 0.0 ? fine.samples / fine.weight : 0.0; }

// Share of the coarse fits if any of them has samples: 1 where no fine fit has any.
float coarseShare(Prediction fine) { return fine.weight > 0.0 ? coarseShare(fineSamples(fine)) : 1.0; }

vec3 colourOf(Prediction sum) { return sum.weight > 0.0 ? sum.colour / sum.weight : vec3(0.0); }

// The four texels around a pixel on a grid whose texels are `size` pixels a side.
struct BilinearTexels {
  ivec2 base;
  vec2 f;
};

BilinearTexels bilinearTexels(ivec2 p, int size) {
  const vec2 position = (vec2(p) + 0.5) / float(size) - 0.5;
  return BilinearTexels(ivec2(floor(position)), fract(position));
}

// Weight of texel `i` of the four; 0 outside the grid.
float bilinearWeight(BilinearTexels a, int i, ivec2 grid, out ivec2 texel) {
  const ivec2 offset = ivec2(i & 1, i >> 1);
  texel = a.base + offset;
  if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, grid))) return 0.0;
  const vec2 axisWeight = mix(1.0 - a.f, a.f, vec2(offset));
  return axisWeight.x * axisWeight.y;
}

Prediction predictCoarse(ivec2 p, float z, NormalAndOcclusion shading) {
  Prediction sum = noPrediction();
  const BilinearTexels cells = bilinearTexels(p, kCellSize);
  [[unroll]] for (int i = 0; i < 4; ++i) {
    ivec2 cell;
    const float weight = bilinearWeight(cells, i, textureSize(coarseDepth, 0), cell);
    if (weight <= 0.0) continue;
    const float cellZ = unpackDepth(texelFetch(coarseDepth, cell, 0).x);
    if (cellZ > 0.0) add(sum, weight, loadCoarse(cell), featuresOf(shading, cellZ / z - 1.0));
  }
  return sum;
}

Prediction predictFine(ivec2 p, float z, NormalAndOcclusion shading) {
  Prediction sum = noPrediction();
  const BilinearTexels blocks = bilinearTexels(p, kBlockSize);
  [[unroll]] for (int i = 0; i < 4; ++i) {
    ivec2 block;
    const float bilinear = bilinearWeight(blocks, i, textureSize(fitDepth, 0), block);
    if (bilinear <= 0.0) continue;
    const float blockZ = unpackDepth(texelFetch(fitDepth, block, 0).x);
    if (blockZ == 0.0) continue;
    const uint packedNormal = texelFetch(fitNormal, block, 0).x;
    const vec3 normal = blockNormal(packedNormal);
    const Plane plane = planeAt(representativePixel(block, kBlockSize, packedNormal), blockZ, normal);
    const float weight = bilinear * onPlane(planeDistance(plane, p, z)) * facing(normal, shading.normal);
    add(sum, weight, loadFine(block), featuresOf(shading, blockZ / z - 1.0));
  }
  return sum;
}

#ifdef VIEW
const float kCoefficients = float(kFeatures + 1);  // Of the fit of one channel.

vec3 slopeOf(Prediction sum, uint feature) {
  return sum.weight > 0.0 ? sum.slope[feature] / sum.weight : vec3(0.0);
}
vec3 viewOf(ivec2 p, Prediction fine, Prediction coarse, float share, float occluded) {
  const bool known = fine.weight > 0.0 || coarse.weight > 0.0;
  switch (kView) {
    case 0u: return vec3(fineSamples(fine), share, !known);
    case 1u: return vec3(occluded, fine.weight, fine.weight <= 0.0 && coarse.weight > 0.0);
    case 2u: return colourOf(fine);
    case 3u: return colourOf(coarse);
    case 4u: return vec3(fine.negative);
    case 5u: return vec3(coarse.negative);
    case 16u: return vec3(fineSamples(fine) < kCoefficients, share > 0.5, lightAt(p).a == 0.0);
  }
  return kView < 11u ? slopeOf(fine, kView - 6u) : slopeOf(coarse, kView - 11u);
}
#endif

#ifdef VIEW
void storeNoSurface(ivec2 p) { imageStore(outView, p, vec4(vec3(0.0), 1.0)); }
#elif defined(PACKED)
void storeNoSurface(ivec2 p) { imageStore(outFiltered, p, uvec4(kFilteredNoSurface)); }
void store(ivec2 p, vec3 colour) {
  const vec3 random = randomNumbers(p, frame.frameIndex, kFilteredSeed).rgb;
  imageStore(outFiltered, p, uvec4(packFiltered(colour, random)));
}
#else
void storeNoSurface(ivec2 p) { imageStore(outFiltered, p, vec4(passThroughLight(passThrough, p), 1.0)); }
void store(ivec2 p, vec3 colour) { imageStore(outFiltered, p, nearestHalf(vec4(colour, 1.0))); }
#endif

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, textureSize(depth, 0)))) return;
  const float z = unpackDepth(texelFetch(depth, p, 0).x);
  if (z == 0.0) {
    storeNoSurface(p);
    return;
  }
  const NormalAndOcclusion shading = unpackNormalAndOcclusion(texelFetch(features, p, 0).x);
  const Prediction fine = predictFine(p, z, shading);
  const float shareIfAny = coarseShare(fine);
#ifdef VIEW
  const Prediction coarse = predictCoarse(p, z, shading);
#else
  Prediction coarse = noPrediction();
  if (shareIfAny > 0.0) coarse = predictCoarse(p, z, shading);
#endif
  const float share = coarse.weight > 0.0 ? shareIfAny : 0.0;
#ifdef VIEW
  imageStore(outView, p, vec4(viewOf(p, fine, coarse, share, shading.occlusion), 1.0));
#else
  // 0 where no fit has samples. The pixel itself has none then: its cell would otherwise have a coarse fit.
  store(p, mix(colourOf(fine), colourOf(coarse), share));
#endif
}
