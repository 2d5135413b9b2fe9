// WALR, reconstruction (passes/WALR.md, 8): predicts the light of every pixel from the pixel's own features, with the
// fits around it.
// Fine prediction: the mean of what the fits of the four nearest blocks predict, at least 0, weighted by bilinear
// weight times edge-stopping function of the block's plane times cosine between block normal and shading normal.
// Coarse prediction: the same of the four nearest cells, with bilinear weights alone.
// The result is a mixture of both. The share of the coarse prediction falls with the mean sample count of the fine
// windows (coarse_share.glsl). Above a limit it is 0, and the cells are not read. It is 1 if no fine fit is usable.
// A pixel without a surface (depth 0) is not filtered: its pass-through is copied to the result.
// PACKED: the result is packed light (packed_light.glsl). A pixel without a surface gets the mark kFilteredNoSurface,
// and anti-aliasing outputs the pass-through.
// VIEW: writes an intermediate value instead of the result, and black where there is no surface. The cells are always
// read. With VIEW, PACKED means that `accumulated` is packed.
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
uniform utexture2D features;  // Shading normal and ambient occlusion.
// Fits of blocks: 24 halves in three textures (block_fit.glsl).
uniform utexture2D fitA;
uniform utexture2D fitB;
uniform utexture2D fitC;
uniform utexture2D fitDepth;   // Of the representative pixel; 0: the block shows no surface.
uniform utexture2D fitNormal;  // Geometric normal of the representative pixel, and that pixel's number in the block.
// Fits of cells.
uniform utexture2D coarseA;
uniform utexture2D coarseB;
uniform utexture2D coarseC;
uniform utexture2D coarseDepth;  // Depth that the cell's depth feature is relative to; 0: no surface in its window.
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

// Sums over the four fits, before division by `weight`.
struct Prediction {
  vec3 colour;    // Sum of weight times predicted colour.
  float samples;  // Sum of weight times W, the sample count of the fit's window.
  float weight;   // Sum of weights; 0: no fit is usable.
#ifdef VIEW
  vec3 slope[kFeatures];  // Sums of weight times slope.
  bvec3 negative;         // Whether any of the fits predicts less than 0, by channel.
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

// Adds the prediction of one fit for features `x`. A fit without samples is left out.
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
BlockFit loadCoarse(ivec2 cell) {
  return unpackFit(PackedFit(texelFetch(coarseA, cell, 0), texelFetch(coarseB, cell, 0), texelFetch(coarseC, cell, 0)));
}

// Mean sample count of the windows of the fine fits; 0 if no fine fit is usable.
float meanSamples(Prediction fine) { return fine.weight > 0.0 ? fine.samples / fine.weight : 0.0; }

// Share of the coarse prediction, provided that a coarse fit is usable: 1 if no fine fit is, for instance because the
// pixel lies on no block's plane.
float shareOfCoarse(Prediction fine) { return fine.weight > 0.0 ? coarseShare(meanSamples(fine)) : 1.0; }

vec3 meanColour(Prediction sum) { return sum.weight > 0.0 ? sum.colour / sum.weight : vec3(0.0); }

// The four texels nearest to a pixel on a grid whose texels are `size` pixels a side.
struct BilinearTexels {
  ivec2 base;     // The upper left one.
  vec2 fraction;  // Position past its centre, in texels.
};

BilinearTexels bilinearTexels(ivec2 p, int size) {
  const vec2 position = (vec2(p) + 0.5) / float(size) - 0.5;
  return BilinearTexels(ivec2(floor(position)), fract(position));
}

// Weight of texel `i` of the four, 0 if it lies outside the grid.
float bilinearWeight(BilinearTexels texels, int i, ivec2 grid, out ivec2 texel) {
  const ivec2 offset = ivec2(i & 1, i >> 1);
  texel = texels.base + offset;
  if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, grid))) return 0.0;
  const vec2 axisWeight = mix(1.0 - texels.fraction, texels.fraction, vec2(offset));
  return axisWeight.x * axisWeight.y;
}

Prediction predictCoarse(ivec2 p, float z, NormalAndOcclusion guides) {
  Prediction sum = noPrediction();
  const BilinearTexels cells = bilinearTexels(p, kCellSize);
  [[unroll]] for (int i = 0; i < 4; ++i) {
    ivec2 cell;
    const float weight = bilinearWeight(cells, i, textureSize(coarseDepth, 0), cell);
    if (weight <= 0.0) continue;
    const float cellZ = unpackDepth(texelFetch(coarseDepth, cell, 0).x);
    if (cellZ > 0.0) add(sum, weight, loadCoarse(cell), featuresOf(guides, cellZ / z - 1.0));
  }
  return sum;
}

Prediction predictFine(ivec2 p, float z, NormalAndOcclusion guides) {
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
    // u of passes/WALR.md; the distance is in units of blockZ.
    const float weight = bilinear * edgeStopping(planeDistance(plane, p, z)) * normalCosine(normal, guides.normal);
    add(sum, weight, loadFine(block), featuresOf(guides, blockZ / z - 1.0));
  }
  return sum;
}

#ifdef VIEW
const float kCoefficients = float(kFeatures + 1);  // Of one channel: a constant and the slopes.

vec3 meanSlope(Prediction sum, uint feature) { return sum.weight > 0.0 ? sum.slope[feature] / sum.weight : vec3(0.0); }

// In the order of reconstructionViews() in passes/block_regression.cpp, which describes each value.
vec3 viewOf(ivec2 p, Prediction fine, Prediction coarse, float share, float occlusion) {
  const bool usable = fine.weight > 0.0 || coarse.weight > 0.0;
  switch (kView) {
    case 0u: return vec3(meanSamples(fine), share, !usable);                                     // samples
    case 1u: return vec3(occlusion, fine.weight, fine.weight <= 0.0 && coarse.weight > 0.0);     // occlusion
    case 2u: return meanColour(fine);                                                            // fine-fit
    case 3u: return meanColour(coarse);                                                          // coarse-fit
    case 4u: return vec3(fine.negative);                                                         // clamped
    case 5u: return vec3(coarse.negative);                                                       // coarse-clamped
    case 16u: return vec3(meanSamples(fine) < kCoefficients, share > 0.5, lightAt(p).a == 0.0);  // few-samples
  }
  // 6 to 10 are slope-x to slope-occlusion; 11 to 15 are coarse-slope-x to coarse-slope-occlusion.
  return kView < 11u ? meanSlope(fine, kView - 6u) : meanSlope(coarse, kView - 11u);
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
  const NormalAndOcclusion guides = unpackNormalAndOcclusion(texelFetch(features, p, 0).x);
  const Prediction fine = predictFine(p, z, guides);
  const float shareIfUsable = shareOfCoarse(fine);
#ifdef VIEW
  const Prediction coarse = predictCoarse(p, z, guides);
#else
  Prediction coarse = noPrediction();
  if (shareIfUsable > 0.0) coarse = predictCoarse(p, z, guides);
#endif
  const float share = coarse.weight > 0.0 ? shareIfUsable : 0.0;
#ifdef VIEW
  imageStore(outView, p, vec4(viewOf(p, fine, coarse, share, guides.occlusion), 1.0));
#else
  // Black if no fit is usable. That happens only if the pixel's history holds no finite sample: any other pixel gives a
  // fit to its own cell, which is one of the four.
  store(p, mix(meanColour(fine), meanColour(coarse), share));
#endif
}
