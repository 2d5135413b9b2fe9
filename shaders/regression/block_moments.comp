// WALR, moments of blocks and cells (passes/WALR.md, 4). A random pixel of a block, its representative pixel, gives the
// block its depth and normal. Pixels of the block count by their number of samples, the edge-stopping function of that
// pixel's plane, and the cosine between the normals.
// The moments of cells, the grid of the coarse fit, count every pixel by its number of samples alone, whichever its
// surface.
// A block has four threads. Each sums over two columns of its pixels, so that neighbouring threads read neighbouring
// texels.
// kLightGrid: textures hold the pixels of the light grid (light_sample.glsl), and only these count.
// PACKED: `accumulated` is packed light (packed_light.glsl).
// kAntilag: takes history out of accumulated light where the light has changed in this frame (current_light.glsl).
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#include "regression/block_regression.h"
#include "conventions/frame.h"
#include "regression/block_storage.glsl"
#include "common/hash.glsl"

layout(local_size_x = 16, local_size_y = 4) in;     // Four threads a block, 4 x 4 blocks.
layout(constant_id = 0) const int kBlockSize = 4;   // Pixels per axis, at most 8.
layout(constant_id = 1) const int kCellBlocks = 2;  // Blocks per axis: 1, 2 or 4.
const int kGroupBlocks = 4;  // Blocks of a workgroup per axis.
const int kBlocks = kGroupBlocks * kGroupBlocks;
const int kThreads = kThreadsPerBlock * kBlocks;

layout(std140) uniform frameConstants { FrameConstants frame; };
uniform utexture2D depth;  // And geometric normals.
uniform utexture2D features;
#ifdef PACKED
uniform utexture2D accumulated;
#else
uniform texture2D accumulated;
#endif
#define BLOCK_MOMENTS_OUT
#define CELL_MOMENTS_OUT
#include "regression/block_textures.glsl"
layout(r32ui) uniform writeonly uimage2D outNormal;
layout(push_constant) uniform PushConstants { BlockRegressionConstants constants; };
#include "conventions/plane.glsl"
#include "regression/block_plane.glsl"
#include "conventions/light.glsl"
#define LIGHT_GRID_CHOSEN
#include "conventions/light_sample.glsl"
#include "temporal/current_light.glsl"
#include "common/set_bits.glsl"
#include "regression/window_depth.glsl"

// The place of a thread in its block, and that of the first thread of its block in the workgroup.
struct Place {
  ivec2 block;
  int thread;
  int first;
};

// A thread's pixels in a block are numbered from 0: those of two columns, or of one where the light grid has at most four
// columns in a block. Those outside a block that is smaller than 8 x 8 pixels show no surface.
const int kPixels = kLightGrid && kLightColumns > 1 ? 8 : 16;
ivec2 texelInBlock(int thread, int i) { return ivec2(thread + kThreadsPerBlock * (i / 8), i % 8); }

// The first texel of a block, and the pixel that a texel holds.
ivec2 firstTexel(ivec2 block) {
  const ivec2 p = kBlockSize * block;
  return kLightGrid ? (p - frame.lightOffset + lightGroup() - 1) / lightGroup() : p;
}
ivec2 pixelOfTexel(ivec2 texel) { return kLightGrid ? texel * lightGroup() + frame.lightOffset : texel; }

// The thread's pixels that show a surface, one bit each: eight bits a column.
uint surfacesOf(Place place) {
  const ivec2 last = textureSize(depth, 0) - 1;
  uint surfaces = 0u;
  [[unroll]] for (int i = 0; i < kPixels; ++i) {
    const ivec2 texel = firstTexel(place.block) + texelInBlock(place.thread, i);
    const ivec2 inBlock = pixelOfTexel(texel) - kBlockSize * place.block;
    const float z = unpackDepthBesideNormal(texelFetch(depth, min(texel, last), 0).x);
    const bool inside = all(lessThan(inBlock, ivec2(kBlockSize))) && all(lessThanEqual(texel, last));
    surfaces |= inside && z != 0.0 ? 1u << i : 0u;
  }
  return surfaces;
}

shared uint threadSurfaces[kThreads];

// The texel of a random one of the block's pixels with a surface, each of them equally likely; false if there is none.
bool chooseRepresentative(Place place, uint surfaces, out ivec2 texel) {
  threadSurfaces[place.first + place.thread] = surfaces;
  barrier();
  uvec2 block = uvec2(0u);  // Eight bits a column.
  [[unroll]] for (int i = 0; i < kThreadsPerBlock; ++i) {
    const uint columns = threadSurfaces[place.first + i];
    block |= uvec2(columns & 0xffu, columns >> 8) << 8 * i;
  }
  const uint count = uint(bitCount(block.x) + bitCount(block.y));
  const int bit = positionOfSetBit(block, hashBelow(uvec4(place.block, frame.frameIndex, 0), count));
  texel = firstTexel(place.block) + ivec2(bit / 8, bit % 8);
  return count > 0u;
}

// A block's representative pixel; without a surface its depth is 0.
struct Representative {
  float z;
  uint packedNormal;
  Plane plane;
  float x[kFeatures];  // Features, with depths relative to its own.
  vec3 y;              // Light.
};

Representative representativeOf(Place place, uint surfaces) {
  Representative r = Representative(0.0, 0u, Plane(vec3(0.0), 0.0, 0.0), noSamples().x, vec3(0.0));
  ivec2 texel;
  if (!chooseRepresentative(place, surfaces, texel)) return r;
  const ivec2 p = pixelOfTexel(texel), pixel = p - kBlockSize * place.block;
  const uint packed = texelFetch(depth, texel, 0).x;
  r.z = unpackDepthBesideNormal(packed);
  r.packedNormal = packBlockNormal(packed & kShortNormalMask, uint(pixel.y * kBlockSize + pixel.x));
  r.plane = planeAt(p, r.z, unpackShortNormal(packed));
  r.x = featuresOf(unpackNormalAndOcclusion(texelFetch(features, texel, 0).x), 0.0);
  r.y = lightAt(texel).rgb;
  return r;
}

// Sums of moments over pixels on the plane of the representative pixel and over all pixels, and the depths of these.
struct Sums {
  BlockMomentSum onItsPlane;
  BlockMomentSum all;
  WindowDepth window;
};

// The limits of a block's pixels, those at its centre.
TileLimits limitsIn(ivec2 block) {
  const vec2 centre = vec2(kBlockSize * block) + 0.5 * float(kBlockSize - 1);
  return kAntilag ? tileLimitsAt(antilag, centre) : kNoTileLimits;
}

Sums sumsOf(Place place, uint surfaces, Representative r) {
  const TileLimits limits = limitsIn(place.block);
  Sums sums = Sums(emptySum(r.x, r.y), emptySum(r.x, r.y), WindowDepth(float(bitCount(surfaces)), 0.0));
  for (int i = 0; i < kPixels; ++i) {
    if ((surfaces >> i & 1u) == 0u) continue;
    const ivec2 texel = firstTexel(place.block) + texelInBlock(place.thread, i), p = pixelOfTexel(texel);
    const float z = max(unpackDepthBesideNormal(texelFetch(depth, texel, 0).x), r.z / kMostDepthRatio);
    const NormalAndOcclusion shading = unpackNormalAndOcclusion(texelFetch(features, texel, 0).x);
    const vec4 mean = currentLightAt(texel, p, limits);
    sums.window.inverse += 1.0 / z;
    if (mean.a == 0.0) continue;
    const float x[kFeatures] = featuresOf(shading, r.z / z - 1.0);
    const float weight = edgeStopping(planeDistance(r.plane, p, z)) * normalCosine(r.plane.normal, shading.normal);
    // Distances from the plane of a pixel whose depth is almost 0 overflow, and a weight may be NaN.
    if (weight > 0.0) addPixel(sums.onItsPlane, weight * mean.a, x, mean.rgb);
    addPixel(sums.all, mean.a, x, mean.rgb);
  }
  return sums;
}

// A thread's sums as vectors. One round adds up as many of them as a block has threads.
const int kSumVectors = kMoments / 4;
const int kRounds = (2 * kSumVectors + 1 + kThreadsPerBlock - 1) / kThreadsPerBlock;
const int kVectors = kThreadsPerBlock * kRounds;

vec4[kVectors] vectorsOf(Sums sums) {
  const float onItsPlane[kMoments] = numbersOf(sums.onItsPlane.sum);
  const float all[kMoments] = numbersOf(sums.all.sum);
  vec4 vectors[kVectors];
  [[unroll]] for (int i = 0; i < kMoments; ++i) {
    vectors[i / 4][i % 4] = onItsPlane[i];
    vectors[kSumVectors + i / 4][i % 4] = all[i];
  }
  [[unroll]] for (int i = 2 * kSumVectors; i < kVectors; ++i) vectors[i] = vec4(0.0);
  vectors[2 * kSumVectors].xy = vec2(sums.window.weights, sums.window.inverse);
  return vectors;
}

shared vec4 exchange[kVectors * kBlocks];

// Adds up the vectors of a block's threads: in each round every thread adds up one vector of all of them.
void addThreads(Place place, vec4 vectors[kVectors]) {
  vec4 totals[kRounds];
  [[unroll]] for (int round = 0; round < kRounds; ++round) {
    [[unroll]] for (int i = 0; i < kThreadsPerBlock; ++i) {
      exchange[kThreads * i + place.first + place.thread] = vectors[kThreadsPerBlock * round + i];
    }
    barrier();
    totals[round] = vec4(0.0);
    // Every thread starts with itself, because the vectors of one thread all lie in the same banks.
    const int own = kThreads * place.thread + place.first;
    [[unroll]] for (int i = 0; i < kThreadsPerBlock; ++i) totals[round] += exchange[own + (place.thread ^ i)];
    barrier();
  }
  [[unroll]] for (int round = 0; round < kRounds; ++round) {
    exchange[kBlocks * (kThreadsPerBlock * round + place.thread) + place.first / kThreadsPerBlock] = totals[round];
  }
  barrier();
}

// One of the vectors that addThreads left.
vec4 total(Place place, int vector) { return exchange[kBlocks * vector + place.first / kThreadsPerBlock]; }

// Moments of the block from one of its sums, of which `first` is the first vector.
BlockMoments momentsOfBlock(Place place, int first, Representative r) {
  float numbers[kMoments];
  [[unroll]] for (int i = 0; i < kSumVectors; ++i) {
    const vec4 vector = total(place, first + i);
    [[unroll]] for (int c = 0; c < 4; ++c) numbers[4 * i + c] = vector[c];
  }
  return finish(BlockMomentSum(r.x, r.y, momentsOf(numbers)));
}

// What a block contributes to a cell of several blocks.
struct CellPart {
  BlockMoments moments;
  float z;  // What their depth feature is relative to.
  WindowDepth window;
};
shared CellPart parts[kCellBlocks > 1 ? kBlocks : 1];

int partOf(ivec2 block) {
  const ivec2 inGroup = block % kGroupBlocks;
  return kGroupBlocks * inGroup.y + inGroup.x;
}

WindowDepth windowOfCell(ivec2 cell) {
  WindowDepth window = WindowDepth(0.0, 0.0);
  for (int i = 0; i < kCellBlocks * kCellBlocks; ++i) {
    const WindowDepth w = parts[partOf(kCellBlocks * cell + ivec2(i % kCellBlocks, i / kCellBlocks))].window;
    window.weights += w.weights;
    window.inverse += w.inverse;
  }
  return window;
}

BlockMoments momentsOfCell(ivec2 cell, float z) {
  BlockMomentSum sum = emptySum(parts[partOf(kCellBlocks * cell)].moments);
  for (int i = 0; i < kCellBlocks * kCellBlocks; ++i) {
    const CellPart part = parts[partOf(kCellBlocks * cell + ivec2(i % kCellBlocks, i / kCellBlocks))];
    if (part.moments.samples > 0.0) add(sum, 1.0, rescaleDepth(part.moments, z / part.z));
  }
  return finish(sum);
}

void main() {
  Place place;
  place.block = ivec2(gl_GlobalInvocationID.x / kThreadsPerBlock, gl_GlobalInvocationID.y);
  place.thread = int(gl_LocalInvocationID.x) % kThreadsPerBlock;
  place.first = int(gl_LocalInvocationIndex) - place.thread;
  const uint surfaces = surfacesOf(place);
  const Representative r = representativeOf(place, surfaces);
  addThreads(place, vectorsOf(sumsOf(place, surfaces, r)));

  // The first thread of a block finishes the block, the second its cell.
  const bool forCell = place.thread == 1;
  BlockMoments m = momentsOfBlock(place, forCell ? kSumVectors : 0, r);
  WindowDepth window = WindowDepth(total(place, 2 * kSumVectors).x, total(place, 2 * kSumVectors).y);
  const ivec2 cell = place.block / kCellBlocks;
  if (kCellBlocks > 1) {
    if (forCell) parts[partOf(place.block)] = CellPart(m, r.z, window);
    barrier();
    if (forCell) window = windowOfCell(cell);
  }
  // Textures of the light grid may end after the image.
  const bool inside = all(lessThan(place.block, imageSize(outNormal)));
  const bool isFirstOfCell = all(equal(place.block, kCellBlocks * cell));
  if (!inside || place.thread > 1 || (forCell && !isFirstOfCell)) return;

  const uint packedDepth = packDepthSdf(forCell ? harmonicMean(window) : r.z, 0u);
  if (forCell) {
    const float z = unpackDepth(packedDepth);
    if (kCellBlocks > 1) {
      m = momentsOfCell(cell, z);
    } else if (m.samples > 0.0) {
      m = rescaleDepth(m, z / r.z);
    }
  }
  const PackedBlock moments = packBlock(m);
  if (forCell) {
    storeCellMoments(cell, moments);
    imageStore(outCellDepth, cell, uvec4(packedDepth));
  } else {
    storeMoments(place.block, moments);
    imageStore(outDepth, place.block, uvec4(packedDepth));
    imageStore(outNormal, place.block, uvec4(r.packedNormal));
  }
}
