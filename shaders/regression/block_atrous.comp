// WALR, fine fit (passes/WALR.md, 5): one edge-aware a-trous iteration over blocks (Meunier & Harada 2022, 3.2 and
// 3.3). The moments of a block are merged with those of eight taps, blocks 3^t apart. A tap's weight is the smallest
// edge-stopping weight on the way to it, times the cosine between the normals, times the growth weight
// (block_growth.glsl).
// LAST: the last iteration. It solves the regression and writes fits instead of moments.
// VIEW: does the same work and writes one of its intermediate values of each block to all pixels of the block.
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "regression/block_regression.h"
#include "conventions/frame.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const int kBlockSize = 4;  // Pixels per axis.
layout(constant_id = 1) const int kSpacing = 1;    // 3^t blocks.

layout(std140) uniform frameConstants { FrameConstants frame; };
uniform utexture2D normal;
#ifdef VIEW
layout(rgba32f) uniform writeonly image2D outView;
#endif
layout(push_constant) uniform PushConstants {
  BlockRegressionConstants constants;
#ifdef VIEW
  uint view;  // Which quantity; numbered in viewOf.
#endif
};
#include "regression/block_fit.glsl"
#define BLOCK_MOMENTS_IN
#if defined(LAST)
#include "regression/coarse_share.glsl"
#elif !defined(VIEW)
#define BLOCK_MOMENTS_OUT
#endif
#include "regression/block_growth.glsl"
#include "regression/block_textures.glsl"
#include "conventions/plane.glsl"
#include "regression/block_plane.glsl"
#ifdef LAST
layout(r32ui) uniform writeonly uimage2D outDepth;
layout(std430) writeonly buffer outFits { StoredBlockFit fits[]; };
#endif

// Edge-stopping weight of a block; 0 outside the image and where the block shows no surface.
float edgeWeight(Plane plane, ivec2 block, out uint packedDepth) {
  packedDepth = 0u;
  if (!insideGrid(block)) return 0.0;
  packedDepth = texelFetch(depth, block, 0).x;
  const float z = unpackDepth(packedDepth);
  if (z == 0.0) return 0.0;
  return edgeStopping(planeDistance(plane, representativePixel(block, kBlockSize, texelFetch(normal, block, 0).x), z));
}

struct Trace {
  float weight;  // Smallest edge-stopping weight on the segment.
  int edge;      // Step at which it became 0; kSpacing + 1 if it did not.
  float depth;   // Depth of the block at the far end.
};

// Edge tracing as in edge_tracing.glsl, with blocks in place of pixels. `edge`: distance of the centre to the nearest
// edge.
Trace traceEdge(Plane plane, ivec2 block, ivec2 direction, uint edge) {
  Trace trace = Trace(1.0, kSpacing + 1, 0.0);
  int step = 0;
  while (step < kSpacing) {
    step = min(step + max(int(constants.sdfFraction * float(edge)), 1), kSpacing);
    uint packedDepth;
    trace.weight = min(trace.weight, edgeWeight(plane, block + step * direction, packedDepth));
    if (trace.weight <= 0.0) {
      trace.edge = step;
      break;
    }
    edge = unpackSdf(packedDepth);
    trace.depth = unpackDepth(packedDepth);
  }
  return trace;
}

// What the traces to all eight taps found.
struct TraceSummary {
  int nearestEdge;
  int lost;
};

// Growth weight of a tap: 1 where both blocks show the same light within the standard errors of their means. The
// variance is that of the pixels of both blocks together: that of a few samples may be small by chance. Pixels are means
// of N samples, so that the error comes out smaller than it is by the root of N: six mean 2.1 with 8 frames of history.
float sameLight(BlockMoments a, BlockMoments b) {
  const float samples = a.samples + b.samples;
  const float shareA = a.samples / samples;
  const float shareB = b.samples / samples;
  const float difference = luminance(a.y - b.y);
  const float variance = shareA * a.yy + shareB * b.yy + shareA * shareB * difference * difference;
  return sameLight(difference, variance / (shareA * shareB * samples), luminance(a.y + b.y), constants.growthErrors);
}

#ifdef VIEW
// The smallest pivot without its ridge, in units of the ridge; the number of pivots below their ridge; 1 if there are
// any.
vec3 pivotsOf(BlockMoments m) {
  const float factor[kCovariances] = factorOf(m);
  const float ridge[kFeatures] = ridgeOf(m);
  float smallest = 3.0e38, outweighed = 0.0;
  for (int i = 0; i < kFeatures; ++i) {
    const float root = factor[triangleEntry(i, i)];
    const float pivot = root * root / ridge[i] - 1.0;
    smallest = min(smallest, pivot);
    outweighed += pivot < 1.0 ? 1.0 : 0.0;
  }
  return vec3(smallest, outweighed, outweighed > 0.0);
}

vec3 viewOf(TraceSummary summary, BlockMoments m) {
  switch (view) {
    case 0u: return vec3(summary.nearestEdge, summary.lost, m.samples);
    case 1u: return pivotsOf(m);
    case 2u: return m.y;
    case 3u: return vec3(m.x[0], m.x[1], m.x[2]);
    case 4u: return vec3(m.x[3], m.x[4], 0.0);
    case 5u: return vec3(m.xx[triangleEntry(0, 0)], m.xx[triangleEntry(1, 1)], m.xx[triangleEntry(2, 2)]);
    case 6u: return vec3(m.xx[triangleEntry(1, 0)], m.xx[triangleEntry(2, 0)], m.xx[triangleEntry(2, 1)]);
    case 7u: return vec3(m.xx[triangleEntry(3, 0)], m.xx[triangleEntry(3, 1)], m.xx[triangleEntry(3, 2)]);
    case 8u: return vec3(m.xx[triangleEntry(4, 0)], m.xx[triangleEntry(4, 1)], m.xx[triangleEntry(4, 2)]);
    case 9u: return vec3(m.xx[triangleEntry(3, 3)], m.xx[triangleEntry(4, 3)], m.xx[triangleEntry(4, 4)]);
  }
  return m.yx[view - 10u];
}
#endif

void writeResult(ivec2 block, float z, Plane plane, TraceSummary summary, BlockMoments m) {
#ifdef VIEW
  const vec3 value = z > 0.0 ? viewOf(summary, m) : vec3(0.0);
  for (int i = 0; i < kBlockSize * kBlockSize; ++i) {
    const ivec2 p = kBlockSize * block + ivec2(i % kBlockSize, i / kBlockSize);
    if (all(lessThan(p, imageSize(outView)))) imageStore(outView, p, vec4(value, 1.0));
  }
#else
#ifdef LAST
  const vec4 storedPlane = m.samples > 0.0 ? vec4(plane.inverseDepth * plane.normal, plane.offset) : vec4(0.0);
  fits[gridIndex(block, textureSize(depth, 0))] = StoredBlockFit(fitOf(m, z), storedPlane);
  const uint packedDepth = packFitDepth(z, converges(m.samples));
#else
  storeMoments(block, packBlock(m));
  const uint packedDepth = packDepthSdf(z, uint(summary.nearestEdge));
#endif
  imageStore(outDepth, block, uvec4(z > 0.0 ? packedDepth : 0u));
#endif
}

void main() {
  const ivec2 block = ivec2(gl_GlobalInvocationID.xy);
  if (!insideGrid(block)) return;
  const uint packedDepth = texelFetch(depth, block, 0).x;
  const float z = unpackDepth(packedDepth);
  if (z == 0.0) {
    writeResult(block, 0.0, Plane(vec3(0.0), 0.0, 0.0), TraceSummary(0, 0), noSamples());
    return;
  }
  const uint packedNormal = texelFetch(normal, block, 0).x;
  const vec3 n = blockNormal(packedNormal);
  const Plane plane = planeAt(representativePixel(block, kBlockSize, packedNormal), z, n);

  const BlockMoments own = loadMoments(block);
  BlockMomentSum sum = emptySum(own);
  add(sum, 1.0, own);
  TraceSummary summary = TraceSummary(kSpacing + 1, 0);
  for (int tap = 0; tap < 9; ++tap) {
    if (tap == 4) continue;
    const ivec2 direction = ivec2(tap % 3, tap / 3) - 1;
    const Trace trace = traceEdge(plane, block, direction, unpackSdf(packedDepth));
    summary.nearestEdge = min(summary.nearestEdge, trace.edge);
    if (trace.weight <= 0.0) {
      ++summary.lost;
      continue;
    }
    const ivec2 q = block + kSpacing * direction;
    const float weight = trace.weight * normalCosine(n, blockNormal(texelFetch(normal, q, 0).x));
    if (weight <= 0.0) continue;
    const BlockMoments tapped = loadMoments(q);
    if (tapped.samples <= 0.0) continue;
    const float same = own.samples > 0.0 ? sameLight(own, tapped) : 1.0;
    if (same > 0.0) add(sum, weight * same, rescaleDepth(tapped, z / trace.depth));
  }
  writeResult(block, z, plane, summary, finish(sum));
}
