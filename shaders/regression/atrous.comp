// WALR over pixels (method walr_paper): one edge-aware a-trous iteration (Meunier & Harada 2022, 3.2 and 3.3). It
// averages the moments of 3 x 3 taps, 3^t pixels apart, with the weights that edge tracing finds.
// FIRST: the first iteration. It computes the moments of its taps from the inputs.
// LAST: the last iteration. It also solves the regression and writes the fitted colour, so that moments are in memory
// only between iterations.
// VIEW: does the same work as LAST and writes one of its intermediate values instead of the result.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_control_flow_attributes : require
#include "regression/atrous.h"
#include "conventions/frame.h"
#include "regression/moments.glsl"
#include "regression/regression.glsl"
#include "conventions/surface.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint kIteration = 0;
layout(constant_id = 1) const int kSpacing = 1;        // 3^t pixels.
layout(constant_id = 2) const bool kTraceEdges = true;
layout(constant_id = 3) const uint kReplacement = 1;   // TapReplacement: what replaces a tap behind an edge.
layout(constant_id = 4) const bool kNormalFactor = true;  // Weights fall with the cosine between the planes' normals.
#ifdef LAST
layout(constant_id = 5) const bool kPivotFloor = false;      // Floor the pivots instead of adding a ridge.
#else
layout(constant_id = 5) const bool kKeepSampleCount = true;  // Carry W from iteration to iteration.
#endif
layout(constant_id = 6) const bool kRepeatCentre = false;  // Replace a tap behind an adjacent edge by the centre.
layout(constant_id = 7) const float kEdgeLeak = 0.01;      // Weight of an adjacent pixel that is an edge.

layout(std140) uniform frameConstants { FrameConstants frame; };
uniform utexture2D depth;
uniform utexture2D planeNormal;
#if defined(FIRST) || defined(VIEW)
uniform texture2D accumulated;
#endif
#if defined(FIRST) || defined(LAST)
uniform utexture2D shadingNormal;
#endif
#if defined(VIEW)
layout(rgba32f) uniform writeonly image2D outView;
#elif defined(LAST)
layout(rgba16f) uniform writeonly image2D outFiltered;
#else
layout(r32ui) uniform writeonly uimage2D outDepth;
#endif
layout(push_constant) uniform PushConstants {
  AtrousConstants constants;
#ifdef VIEW
  uint view;  // Which quantity; numbered in viewOf.
#endif
};

#include "regression/edge_tracing.glsl"
#if defined(FIRST) || defined(VIEW)
#include "conventions/light.glsl"
#endif
#ifdef FIRST
#include "stage/pass_through.glsl"
#endif
#include "regression/moments_storage.glsl"

#if defined(FIRST) || defined(LAST)
vec2 featuresAt(ivec2 q) { return unpackFeatures(texelFetch(shadingNormal, q, 0).x); }
#endif

Moments readMoments(ivec2 q) {
#ifdef FIRST
  return momentsOf(featuresAt(q), lightAt(q));
#else
  return loadMoments(q);
#endif
}

void writePassThrough(ivec2 p) {
#if defined(VIEW)
  imageStore(outView, p, vec4(0.0));
#elif defined(LAST)
  const uvec2 light = packedPassThrough(p);
  imageStore(outFiltered, p, vec4(unpackHalf2x16(light.x), unpackHalf2x16(light.y).x, 1.0));
#else
  storePassThrough(p);
  imageStore(outDepth, p, uvec4(0u));
#endif
}

#ifdef VIEW
const float kCoefficients = 3.0;  // Of the fit of one channel.

vec3 viewOf(ivec2 p, TraceSummary summary, Moments m) {
  const Factor factor = factorOf(m, kPivotFloor, constants.ridge, constants.noiseRidge);
  const Slopes slopes = slopesOf(m, factor);
  const vec3 colour = fitted(m, slopes, featuresAt(p));
  switch (view) {
    case 0u: return vec3(summary.nearestEdge, summary.replaced, summary.lost);
    case 1u: return vec3(m.samples, relativeVariance(m), lightAt(p).a > 0.0 ? 0.0 : 1.0);
    case 2u: return vec3(factor.smallestPivot, factor.regularisation, factor.smallestPivot < factor.regularisation);
    case 3u: return vec3(m.x, 0.0);
    case 4u: return m.xx;
    case 5u: return m.y;
    case 6u: return m.yu;
    case 7u: return m.yv;
    case 8u: return slopes.u;
    case 9u: return slopes.v;
    case 10u: return vec3(notEqual(colour, clampedRadiance(colour)));
    case 11u: return vec3(m.samples < kCoefficients, m.samples == 0.0, 0.0);
  }
  return vec3(0.0);
}
#endif

void writeResult(ivec2 p, float z, TraceSummary summary, Moments m) {
#if defined(VIEW)
  imageStore(outView, p, vec4(viewOf(p, summary, m), 1.0));
#elif defined(LAST)
  const vec3 colour = reconstruct(m, featuresAt(p), kPivotFloor, constants.ridge, constants.noiseRidge);
  imageStore(outFiltered, p, vec4(colour, m.samples > 0.0 ? 1.0 : -1.0));
#else
  if (!kKeepSampleCount) m.samples = m.samples > 0.0 ? 1.0 : 0.0;
  if (m.samples > 0.0) storeMoments(p, m);
  else storeNoMoments(p);
  imageStore(outDepth, p, uvec4(packDepthSdf(z, uint(summary.nearestEdge))));
#endif
}

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  const ivec2 size = textureSize(depth, 0);
  if (any(greaterThanEqual(p, size))) return;

  const uint packedDepth = texelFetch(depth, p, 0).x;
  const float z = unpackDepth(packedDepth);
  if (z == 0.0) {
    writePassThrough(p);
    return;
  }
  const Plane plane = planeAt(p, z, unpackLongNormal(texelFetch(planeNormal, p, 0).x));
  const Centre centre =
      Centre(p, size, plane, 1.0 / (constants.planeFar - constants.planeNear), unpackSdf(packedDepth));

  // Unrolled by hand: drivers do not unroll a loop that holds another one, and a constant direction saves half of the
  // arithmetic of a tap. The moments, which take most of the registers, are read after all traces.
  TraceSummary summary = TraceSummary(kSpacing + 1, 0, 0, 0);
  const Tap found[] = Tap[](
      findTap(centre, 0, ivec2(-1, -1), summary), findTap(centre, 1, ivec2(0, -1), summary),
      findTap(centre, 2, ivec2(1, -1), summary), findTap(centre, 3, ivec2(-1, 0), summary),
      findTap(centre, 5, ivec2(1, 0), summary), findTap(centre, 6, ivec2(-1, 1), summary),
      findTap(centre, 7, ivec2(0, 1), summary), findTap(centre, 8, ivec2(1, 1), summary));

  const Moments here = readMoments(p);
  MomentSum sum = startSum(here);
  add(sum, float(1 + summary.centred), here);
  [[unroll]] for (int i = 0; i < 8; ++i) {
    if (found[i].weight > 0.0) add(sum, found[i].weight, readMoments(found[i].pixel));
  }
  writeResult(p, z, summary, finish(sum));
}
