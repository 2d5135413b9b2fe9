// WALR, reconstruction (passes/WALR.md, 8): predicts the light of every pixel from the pixel's own features, with the
// fits around it.
// Fine prediction: the weighted mean of the predictions of the four nearest blocks' fits. Negative predictions count
// as 0. A fit's weight is the product of its bilinear weight, the edge-stopping function of the distance to the block's
// plane, and the cosine between the block's normal and the shading normal.
// Coarse prediction: the mean of the predictions of the four nearest cells' fits, with bilinear weights alone.
// The result mixes both predictions. The share of the coarse prediction falls as the mean sample count of the fine
// windows grows (coarse_share.glsl). Once the share is 0, the cells are not read. Without a usable fine fit the share is
// 1, without a usable coarse fit 0.
// A pixel without a surface (depth 0) is not filtered: its pass-through is copied to the result.
// PACKED: the result is packed light (packed_light.glsl). A pixel without a surface gets the mark kFilteredNoSurface,
// and anti-aliasing outputs the pass-through.
// RESIDUAL (setting blocks.residual): adds shares of the residual, the accumulated light less the prediction
// (accumulated_share.glsl), and stores statistics for the shares and the history length of later frames (innovation.glsl).
// VIEW: writes an intermediate value instead of the result, and black where there is no surface. The cells are always
// read.
// DIRECTION: writes the slopes of the prediction over the normal instead of the result, for the output `light_direction`
// (pack_direction.glsl).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_control_flow_attributes : require
#include "regression/block_regression.h"
#include "conventions/frame.h"
#include "regression/stored_fit.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const int kBlockSize = 4;  // Pixels per axis, 2 to 8.
layout(constant_id = 2) const int kCellSize = 8;   // Pixels per axis.

layout(std140) uniform frameConstants { FrameConstants frame; };
uniform utexture2D depth;
uniform utexture2D features;  // Shading normal and ambient occlusion.
layout(std430) readonly buffer fineFits { StoredBlockFit blocks[]; };
layout(std430) readonly buffer coarseFits { StoredFit cells[]; };
#ifdef VIEW
layout(rgba32f) uniform writeonly image2D outView;
layout(constant_id = 21) const bool kPackedLight = false;
uniform texture2D accumulated;
uniform utexture2D packedAccumulated;  // With kPackedLight in its place.
#elif defined(DIRECTION)
layout(rg32ui) uniform writeonly uimage2D outDirection;
#elif defined(PACKED)
layout(r32ui) uniform writeonly uimage2D outFiltered;
#else
uniform texture2D passThrough;
layout(rgba16f) uniform writeonly image2D outFiltered;
#endif
layout(push_constant) uniform PushConstants {
  BlockRegressionConstants constants;
#ifdef VIEW
  uint view;  // Which quantity; numbered in viewOf.
#endif
};
#include "regression/block_plane.glsl"
#include "conventions/camera.glsl"
#include "regression/coarse_share.glsl"
#include "regression/reconstruction_tile.glsl"
#include "regression/stored_fit.glsl"
#ifdef VIEW
#include "conventions/light.glsl"
#define LIGHT_GRID_CHOSEN
#include "conventions/light_sample.glsl"
#include "conventions/packed_light.glsl"
#elif defined(DIRECTION)
#include "conventions/pack_direction.glsl"
#elif defined(PACKED)
#include "conventions/packed_light.glsl"
#else
#include "common/half.glsl"
#include "conventions/light_sample.glsl"
#include "stage/pass_through.glsl"
#endif
#ifdef RESIDUAL
#include "regression/accumulated_share.glsl"
#endif

// Features whose slopes are summed beside the light.
#ifdef VIEW
const int kSlopes = kFeatures;
#elif defined(DIRECTION)
const int kSlopes = 3;  // The normal's.
#endif

// Type of what is stored for a pixel.
#ifdef DIRECTION
#define Predicted mat3  // Column i: the slope of the normal's component i.
#else
#define Predicted vec3
#endif

// Sums over the four fits, before division by `weight`.
struct Prediction {
  vec3 colour;    // Sum of weight times predicted colour, in units of kLightUnit.
  float samples;  // Sum of weight times W, the sample count of the fit's window, in units of kSampleCountUnit.
  float weight;   // Sum of weights; 0: no fit is usable.
#if defined(VIEW) || defined(DIRECTION)
  vec3 slope[kSlopes];  // Sums of weight times slope.
#endif
#ifdef VIEW
  bvec3 negative;         // Whether any of the fits predicts less than 0, by channel.
#endif
};

Prediction noPrediction() {
  Prediction sum;
  sum.colour = vec3(0.0);
  sum.samples = 0.0;
  sum.weight = 0.0;
#if defined(VIEW) || defined(DIRECTION)
  for (int i = 0; i < kSlopes; ++i) sum.slope[i] = vec3(0.0);
#endif
#ifdef VIEW
  sum.negative = bvec3(false);
#endif
  return sum;
}

// Adds the prediction of one fit. It is in units of kLightUnit, the largest prediction that is allowed.
void add(inout Prediction sum, float weight, StoredFit fit, ScaledFeatures pixel) {
  const vec3 colour = evaluate(fit, pixel);
  sum.colour += weight * clamp(colour, 0.0, 1.0);
  sum.samples += weight * samplesOf(fit);
  sum.weight += weight;
#if defined(VIEW) || defined(DIRECTION)
  for (int i = 0; i < kSlopes; ++i) sum.slope[i] += weight * slopeOf(fit, i);
#endif
#ifdef VIEW
  for (int c = 0; c < 3; ++c) sum.negative[c] = sum.negative[c] || (weight > 0.0 && colour[c] < 0.0);
#endif
}

// A divisor that is never 0. If all weights are 0, the weighted sum is 0, too, and so is the quotient.
float divisor(float weight) { return max(weight, 1e-30); }

// Mean sample count of the windows of the fine fits; 0 if no fine fit is usable.
float meanSamples(Prediction fine) { return kSampleCountUnit * fine.samples / divisor(fine.weight); }

// Share of the coarse prediction, provided that a coarse fit is usable: 1 if no fine fit is, for instance because the
// pixel lies on no block's plane. It is coarseShare(meanSamples(fine)). Both terms of its fraction are multiplied by the
// weight, which saves a division.
float shareOfCoarse(Prediction fine) {
  const float coarse = divisor(constants.coarseSamples * fine.weight);
  const float share = fadedShare(coarse / (kSampleCountUnit * fine.samples + coarse));
  return fine.weight > 0.0 ? share : 1.0;
}

// `share` times the mean predicted colour; 0 if no fit is usable.
vec3 meanColour(Prediction sum, float share) { return share * kLightUnit / divisor(sum.weight) * sum.colour; }

// The four texels nearest to a pixel on a grid of blocks or cells.
struct BilinearTexels {
  ivec2 first;    // The upper left one.
  vec2 fraction;  // Position past its centre, in texels.
};

BilinearTexels bilinearTexels(ivec2 p, int size) {
  const vec2 position = pixelCentre(p) / float(size) - 0.5;
  return BilinearTexels(ivec2(floor(position)), fract(position));
}

float[4] weightsOf(BilinearTexels texels) {
  const vec2 b = texels.fraction;
  const vec2 a = 1.0 - b;
  return float[](a.x * a.y, b.x * a.y, a.x * b.y, b.x * b.y);
}

// Index of texel `i` of the four in the buffer of a grid with `size` pixels a texel. In place of a texel outside the
// grid, its neighbour inside is read again: the weights of all texels inside then grow by the same factor, as if the one
// outside were skipped.
uint indexOf(BilinearTexels texels, int i, int size) {
  const ivec2 grid = (textureSize(depth, 0) + size - 1) / size;
  return gridIndex(clamp(texels.first + ivec2(i & 1, i >> 1), ivec2(0), grid - 1), grid);
}

Prediction predictCoarse(BilinearTexels texels, ScaledFeatures pixel) {
  Prediction sum = noPrediction();
  const float bilinear[4] = weightsOf(texels);
  [[unroll]] for (int i = 0; i < 4; ++i) {
    const StoredFit fit = cells[indexOf(texels, i, kCellSize)];
    add(sum, hasSamples(fit) ? bilinear[i] : 0.0, fit, pixel);
  }
  return sum;
}

Prediction predictFine(BilinearTexels texels, vec3 ray, float z, vec3 normal, ScaledFeatures pixel) {
  Prediction sum = noPrediction();
  const float bilinear[4] = weightsOf(texels);
  [[unroll]] for (int i = 0; i < 4; ++i) {
    const StoredBlockFit block = blocks[indexOf(texels, i, kBlockSize)];
    // u of passes/WALR.md. The cosine is 0 where a block has no fit.
    const float weight = bilinear[i] * edgeStopping(planeDistance(block, ray, z)) * planeCosine(block, normal);
    add(sum, weight, block.fit, pixel);
  }
  return sum;
}

#if defined(VIEW) || defined(DIRECTION)
vec3 meanSlope(Prediction sum, uint feature) { return sum.slope[feature] / divisor(sum.weight); }
#endif

#ifdef VIEW
const float kCoefficients = float(kFeatures + 1);  // Of one channel: a constant and the slopes.

bool hasNoSample(ivec2 p) {
  const ivec2 texel = accumulatedTexel(p);
  if (!kPackedLight) return lightAt(texel).a == 0.0;
  return unpackAccumulated(texelFetch(packedAccumulated, texel, 0).x).a == 0.0;
}

// In the order of reconstructionViews() in passes/regression/block_regression.cpp, which describes each value.
vec3 viewOf(ivec2 p, Prediction fine, Prediction coarse, float share, float occlusion) {
  const bool usable = fine.weight > 0.0 || coarse.weight > 0.0;
  switch (view) {
    case 0u: return vec3(meanSamples(fine), share, !usable);                                     // samples
    case 1u: return vec3(occlusion, fine.weight, fine.weight <= 0.0 && coarse.weight > 0.0);     // occlusion
    case 2u: return meanColour(fine, 1.0);                                                          // fine-fit
    case 3u: return meanColour(coarse, 1.0);                                                        // coarse-fit
    case 4u: return vec3(fine.negative);                                                         // clamped
    case 5u: return vec3(coarse.negative);                                                       // coarse-clamped
    case 16u: return vec3(meanSamples(fine) < kCoefficients, share > 0.5, hasNoSample(p));  // few-samples
  }
  // 6 to 10 are slope-x to slope-occlusion; 11 to 15 are coarse-slope-x to coarse-slope-occlusion.
  return view < 11u ? meanSlope(fine, view - 6u) : meanSlope(coarse, view - 11u);
}
#endif

#ifdef VIEW
void storeNoSurface(ivec2 p) { imageStore(outView, p, vec4(vec3(0.0), 1.0)); }
void store(ivec2 p, vec3 view) { imageStore(outView, p, vec4(view, 1.0)); }
#elif defined(DIRECTION)
void storeNoSurface(ivec2 p) { imageStore(outDirection, p, uvec4(0u)); }
void store(ivec2 p, mat3 slopes) { imageStore(outDirection, p, uvec4(packDirection(slopes), 0u, 0u)); }
#elif defined(PACKED)
void storeNoSurface(ivec2 p) { imageStore(outFiltered, p, uvec4(kFilteredNoSurface)); }
void store(ivec2 p, vec3 colour) {
  imageStore(outFiltered, p, uvec4(packFiltered(colour, ditherNumber(p, frame.frameIndex))));
}
#else
void storeNoSurface(ivec2 p) { imageStore(outFiltered, p, vec4(passThroughLight(lightSampleAt(passThrough, p).radiance), 1.0)); }
void store(ivec2 p, vec3 colour) { imageStore(outFiltered, p, nearestHalf(vec4(colour, 1.0))); }
#endif

void storeResult(ivec2 p, bool surface, Predicted colour) {
  if (surface) {
    store(p, colour);
  } else {
    storeNoSurface(p);
  }
}

// Predicts the light of a pixel; with VIEW the value to display, with DIRECTION the slopes. Returns false if the pixel
// shows no surface.
bool predict(ivec2 p, BilinearTexels nearBlocks, out vec3 position, out vec3 normal, out Predicted predicted) {
  const float z = unpackDepthBesideNormal(texelFetch(depth, p, 0).x);
  if (z == 0.0) return false;
  const BilinearTexels nearCells = kCellSize == kBlockSize ? nearBlocks : bilinearTexels(p, kCellSize);

  const NormalAndOcclusion guides = unpackNormalAndOcclusion(texelFetch(features, p, 0).x);
  const ScaledFeatures pixel = scaledFeatures(guides, z);
  normal = guides.normal;
  const vec3 ray = rayThrough(frame.rayFromPixel, pixelCentre(p));
  position = z * ray;
  const Prediction fine = predictFine(nearBlocks, ray, z, guides.normal, pixel);
  const float shareIfUsable = shareOfCoarse(fine);
#ifdef VIEW
  const Prediction coarse = predictCoarse(nearCells, pixel);
#else
  Prediction coarse = noPrediction();
  if (shareIfUsable > 0.0) coarse = predictCoarse(nearCells, pixel);
#endif
  const float share = coarse.weight > 0.0 ? shareIfUsable : 0.0;
#ifdef VIEW
  predicted = viewOf(p, fine, coarse, share, guides.occlusion);
#elif defined(DIRECTION)
  for (int axis = 0; axis < kSlopes; ++axis)
    predicted[axis] = mix(meanSlope(fine, uint(axis)), meanSlope(coarse, uint(axis)), share);
#else
  // Black if no fit is usable. That happens only if the pixel's history holds no finite sample: any other pixel gives a
  // fit to its own cell, which is one of the four.
  predicted = meanColour(fine, 1.0 - share) + meanColour(coarse, share);
#endif
  return true;
}

void main() {
  const ivec2 thread = ivec2(gl_LocalInvocationID.xy);
  const ivec2 p = kTilePixels * ivec2(gl_WorkGroupID.xy) - kTileStart + thread;
  const bool hasPixel = all(lessThan(thread, ivec2(kTilePixels))) &&
                        all(lessThan(uvec2(p), uvec2(textureSize(depth, 0))));  // Negative ones are large, too.
  const ivec2 square = kTileSquares == 1 ? ivec2(0) : thread / kBlockSize;
  // Centres of blocks with an odd side are centres of pixels, where fract could return almost 1 instead of 0.
  const vec2 fraction = kBlockSize % 2 == 0 ? fract(pixelCentre(p) / float(kBlockSize) - 0.5)
                                            : vec2(thread - kBlockSize * square) / float(kBlockSize);
  const BilinearTexels nearBlocks = BilinearTexels(kTileSquares * ivec2(gl_WorkGroupID.xy) + square - 1, fraction);
#ifdef RESIDUAL
  const int part = partOfWorkgroup();
  Shown shown = Shown(false, vec3(0.0), vec3(0.0), vec3(0.0));
  if (hasPixel) {
    vec3 position, normal, colour;
    if (predict(p, nearBlocks, position, normal, colour)) shown = Shown(true, position, normal, colour);
  }
  vec3 result = shown.predicted;
  if (part != kNothing) {
    const FetchedLight fetched = fetchLight(clamp(p, ivec2(0), textureSize(depth, 0) - 1));
    result = withAccumulated(p, hasPixel, fetched, shown, part == kSteers);
  } else {
    storeNoSums(p, hasPixel);
  }
  if (hasPixel) storeResult(p, shown.surface, result);
#else
  if (hasPixel) {
    vec3 position, normal;
    Predicted colour;
    const bool surface = predict(p, nearBlocks, position, normal, colour);
    storeResult(p, surface, colour);
  }
#endif
}
