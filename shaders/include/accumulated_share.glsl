// The share of the accumulated light in the reconstruction (passes/WALR_EXPERIMENTS.md). What the fits leave of it, the
// residual, is noise where the fits are right, and light that no feature explains where they are not. Two halves of the
// light with independent noise tell which: this frame's light y and the history h. Where only noise parts them from the
// prediction, the product of their residuals is 0 in the mean.
// Needs: `frame` (FrameConstants), `constants` (BlockRegressionConstants), kBlockSize, workgroups of kSumThreads.
#ifndef WALR_ACCUMULATED_SHARE_GLSL
#define WALR_ACCUMULATED_SHARE_GLSL
#include "camera.glsl"
#include "finite.glsl"
#include "luminance.glsl"
#include "packed_light.glsl"

layout(constant_id = 3) const bool kPackedMean = true;  // The accumulated light is packed.
uniform utexture2D accumulatedPacked;
uniform texture2D accumulatedHalf;
uniform texture2D lighting;
uniform sampler2D previousStatistics;  // residual_statistics.comp.
layout(rgba32f) uniform writeonly image2D outResidualSums;

vec4 accumulatedAt(ivec2 p) {
  return kPackedMean ? unpackAccumulated(texelFetch(accumulatedPacked, p, 0).x) : texelFetch(accumulatedHalf, p, 0);
}

// Means over the surroundings in the previous frame. x: product of the residuals of both halves; y: square of the
// residual. Both are relative to the square of the light.
vec2 previousStatisticsAt(vec3 position) {
  const vec3 before = previousPosition(frame.previousViewFromView, position);
  if (before.z >= 0.0) return vec2(0.0);
  const int tileSize = int(gl_WorkGroupSize.x) / kBlockSize * kBlockSize;
  const vec2 tile = (pixelOf(frame.previousRayFromPixel, before) + float((kBlockSize + 1) / 2)) / float(tileSize) - 0.5;
  const vec2 base = floor(tile), f = tile - base;
  const vec2 corner = (base + 1.0) / vec2(textureSize(previousStatistics, 0));
  const vec4 weights = vec4((1.0 - f.x) * f.y, f.x * f.y, f.x * (1.0 - f.y), (1.0 - f.x) * (1.0 - f.y));
  return vec2(dot(weights, textureGather(previousStatistics, corner, 0)),
              dot(weights, textureGather(previousStatistics, corner, 1)));
}

// The share that makes the expected square of the error least, if the residual consists of what the fits miss, whose
// square is `statistics.x`, and of noise. The means have errors of their own, so that a small share is none.
float accumulatedShare(vec2 statistics) {
  const float share = statistics.x / max(statistics.y, 1e-30);
  return clamp((share - constants.residualLeastShare) / (1.0 - constants.residualLeastShare), 0.0, 1.0);
}

// The residuals of a pixel, and its prediction; luminances. `counts` is 0 where the pixel has no finite y or no h.
struct Residuals {
  float product;  // Of the residuals of y and h.
  float square;   // Of the residual of the mean of both.
  float predicted;
  float counts;
};

Residuals noResiduals() { return Residuals(0.0, 0.0, 0.0, 0.0); }

// `mean`: rgb: m = h + (y - h) / N; alpha: N.
Residuals residualsOf(ivec2 p, vec4 mean, float predicted) {
  const float fewest = 1.5;  // Below, rounding of N leaves nothing of h.
  const vec3 noisy = texelFetch(lighting, p, 0).rgb;
  if (mean.a < fewest || !isFinite(noisy)) return noResiduals();
  const float y = luminance(clamp(noisy, vec3(0.0), vec3(kLargestHalf)));
  const float m = luminance(mean.rgb);
  const float h = (mean.a * m - y) / (mean.a - 1.0);
  return Residuals((y - predicted) * (h - predicted), (m - predicted) * (m - predicted), predicted, 1.0);
}

const uint kSumThreads = 64u;
const float kLeastLight = 1e-12;  // Far below what halves can hold: squares of its inverse are finite,
const float kMostSquare = 1e30;   // and so are sums over tiles of these.
shared vec2 residualSums[kSumThreads];

// Sum over the workgroup, for all its threads. Each round leaves a quarter of the sums.
vec2 sumOverGroup(vec2 value) {
  const uint thread = gl_LocalInvocationIndex;
  residualSums[thread] = value;
  barrier();
  [[unroll]] for (int round = 0; round < 3; ++round) {
    const uint n = kSumThreads >> (2 * round + 2);
    if (thread < n) {
      residualSums[thread] = (residualSums[thread] + residualSums[thread + 2u * n]) +
                             (residualSums[thread + n] + residualSums[thread + 3u * n]);
    }
    barrier();
  }
  const vec2 sum = residualSums[0];
  barrier();
  return sum;
}

// Writes what the pixels of this workgroup add to the statistics: product, square, and the number of pixels. Both are
// relative to the square of the mean light of the workgroup, so that a bright one does not outweigh its neighbours. All
// threads of the workgroup must call it.
void sumResiduals(Residuals r) {
  const vec2 light = sumOverGroup(vec2(r.predicted, r.counts));
  const vec2 sums = sumOverGroup(vec2(r.product, r.square));
  if (gl_LocalInvocationIndex == 0u) {
    vec3 result = vec3(0.0);
    if (light.x > kLeastLight) {
      const float perLight = light.y / light.x;
      result = vec3(clamp(perLight * perLight * sums, -kMostSquare, kMostSquare), light.y);
    }
    imageStore(outResidualSums, ivec2(gl_WorkGroupID.xy), vec4(result, 0.0));
  }
}

#endif
