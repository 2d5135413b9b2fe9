// FLR, last stage (Salmi et al. 2024): interpolates the coefficients of the cells and evaluates them with the guides at
// full resolution.
// VIEW: does the same work and writes one of its intermediate values instead of the result.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_samplerless_texture_functions : require
#include "regression/flr.h"
#include "common/finite.glsl"
#include "stage/pass_through.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint kUpsampling = 1u;  // FlrUpsampling.

layout(push_constant) uniform PushConstants {
  FlrConstants constants;
#ifdef VIEW
  uint view;  // Which quantity; numbered in viewOf.
#endif
};
#include "regression/flr.glsl"

uniform texture2D lighting;
uniform utexture2D depth;
layout(std430) readonly buffer coefficients { vec4 cells[]; };
#ifdef VIEW
layout(constant_id = 1) const bool kAlphaIsSampleCount = false;
#include "conventions/sampled_light.glsl"
layout(rgba32f) uniform writeonly image2D outView;
#else
layout(rgba16f) uniform writeonly image2D outFiltered;
#endif
#include "regression/flr_guides.glsl"

// Interpolation weight of a cell at a pixel `t` cells away along one axis.
float cellWeight(float t) {
  const float d = abs(t);
  if (kUpsampling == 0u) return d < 0.5 ? 1.0 : 0.0;
  if (kUpsampling == 1u) return max(1.0 - d, 0.0);
  const float rest = max(2.0 - d, 0.0);  // The cubic B-spline, which has no negative lobes.
  return d < 1.0 ? (4.0 + d * d * (3.0 * d - 6.0)) / 6.0 : rest * rest * rest / 6.0;
}

Coefficients coefficientsOf(ivec2 cell) {
  Coefficients k;
  k.constant = cells[vectorIndex(cell, 0)];
  [[unroll]] for (int i = 0; i < kSlopeVectors; ++i) k.slope[i] = cells[vectorIndex(cell, 1 + i)];
  return k;
}

vec3 evaluate(Coefficients k, float x[kFeatures]) {
  vec3 colour = k.constant.rgb;
  [[unroll]] for (int i = 0; i < kUsedFeatures; ++i)
    [[unroll]] for (int c = 0; c < 3; ++c) colour[c] += k.slope[(3 * i + c) / 4][(3 * i + c) % 4] * x[i];
  return colour;
}

// Weighted mean of the predictions of the cells around pixel `p` that have a fit. Alpha: 1; 0 if no cell has a fit.
vec4 predict(ivec2 p, float x[kFeatures]) {
  const vec2 position = (vec2(p) + 0.5) / float(constants.factor) - 0.5;
  const int reach = kUpsampling == 2u ? 2 : 1;
  const ivec2 base = ivec2(floor(position)) + 1 - reach;
  vec3 sum = vec3(0.0);
  float weightSum = 0.0;
  for (int i = 0; i < 4 * reach * reach; ++i) {
    const ivec2 cell = base + ivec2(i % (2 * reach), i / (2 * reach));
    if (!insideGrid(cell)) continue;
    const vec2 away = position - vec2(cell);
    const float axes = cellWeight(away.x) * cellWeight(away.y);
    if (axes == 0.0) continue;
    const Coefficients k = coefficientsOf(cell);
    sum += axes * k.constant.a * evaluate(k, x);
    weightSum += axes * k.constant.a;
  }
  return weightSum > 0.0 ? vec4(sum / weightSum, 1.0) : vec4(0.0);
}

#ifdef VIEW
vec3 viewOf(ivec2 p, float z) {
  if (z == 0.0) return vec3(0.0);
  const NormalAndOcclusion geometry = unpackGeometry(texelFetch(normals, p, 0).x);
  const float x[kFeatures] = unpackGuides(packedGuides(p), z);
  const vec4 light = texelFetch(lighting, p, 0);
  if (view == 2u) return isSampled(light) ? clampedRadiance(light.rgb) : vec3(0.0);
  if (view == 3u) return geometry.normal;
  if (view == 4u) return vec3(1.0 / z, geometry.occlusion, samplesOf(light));
  const vec4 predicted = predict(p, x);
  if (view == 0u) return vec3(notEqual(clampedRadiance(predicted.rgb), predicted.rgb));
  return vec3(predicted.a == 0.0, !isSampled(light), !isFinite(predicted.rgb));
}
#endif

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, textureSize(depth, 0)))) return;
  const float z = depthAt(p);
#ifdef VIEW
  imageStore(outView, p, vec4(viewOf(p, z), 1.0));
#else
  if (z == 0.0) {
    imageStore(outFiltered, p, vec4(passThroughLight(lighting, p), 1.0));
    return;
  }
  const vec4 predicted = predict(p, unpackGuides(packedGuides(p), z));
  // Alpha below 0: there is no light.
  imageStore(outFiltered, p, vec4(clampedRadiance(predicted.rgb), predicted.a > 0.0 ? 1.0 : -1.0));
#endif
}
