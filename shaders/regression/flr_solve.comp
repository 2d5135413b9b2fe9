// FLR, third stage (Salmi et al. 2024): the vertical pass of the Gaussian, then the weighted least squares of every
// cell.
// VIEW: does the same work and writes one of its intermediate values to all pixels of the cell.
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#include "regression/flr.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant) uniform PushConstants {
  FlrConstants constants;
#ifdef VIEW
  uint view;  // Which quantity; numbered in viewOf.
#endif
};
#include "regression/flr.glsl"
#include "common/cholesky.glsl"

layout(std430) readonly buffer blurred { vec4 cells[]; };
layout(std430) readonly buffer moreBlurred { vec4 moreCells[]; };  // Read with learned guides.
#ifdef VIEW
layout(rgba32f) uniform writeonly image2D outView;
#else
layout(std430) writeonly buffer outCoefficients { vec4 outCells[]; };
#endif

// The normal equations about the means, that is, with the constant solved first: the ridge then restrains the slopes
// only, where on the constant it would darken the fit. Inverse depth is not of order 1 as the other guides are; its
// ridge is relative to its squared mean.
struct NormalEquations {
  vec3 y;  // Mean colour.
  float x[kFeatures];
  float ridge[kFeatures];
  float factor[kCovariances];  // Of the covariances with their ridge.
  vec3 yx[kFeatures];
};

// Needs at least one sample.
NormalEquations normalEquations(OuterProducts p) {
  const float scale = 1.0 / productAt(p, 0);
  NormalEquations e;
  e.y = scale * colourProductAt(p, 0);
  float covariances[kCovariances];
  [[unroll]] for (int i = 0; i < kUsedFeatures; ++i) e.x[i] = scale * productAt(p, productIndex(0, i + 1));
  [[unroll]] for (int i = 0; i < kUsedFeatures; ++i) {
    e.ridge[i] = constants.ridge * (i == kInverseDepth && !kLearnedAlone ? e.x[i] * e.x[i] : 1.0);
    e.yx[i] = scale * colourProductAt(p, i + 1) - e.y * e.x[i];
    [[unroll]] for (int j = 0; j < kUsedFeatures; ++j) {
      if (j < i) continue;
      covariances[triangleEntry(j, i)] = scale * productAt(p, productIndex(i + 1, j + 1)) - e.x[i] * e.x[j];
    }
  }
  e.factor = choleskyFactor(covariances, e.ridge, e.ridge);
  return e;
}

#ifdef VIEW
// The smallest pivot without its ridge, in units of the ridge; the number of pivots below their ridge.
vec2 pivotsOf(NormalEquations e) {
  float smallest = 3.0e38, outweighed = 0.0;
  [[unroll]] for (int i = 0; i < kUsedFeatures; ++i) {
    const float root = e.factor[triangleEntry(i, i)];
    const float pivot = root * root / e.ridge[i] - 1.0;
    smallest = min(smallest, pivot);
    outweighed += pivot < 1.0 ? 1.0 : 0.0;
  }
  return vec2(smallest, outweighed);
}

vec3 viewOf(OuterProducts p) {
  const float samples = productAt(p, 0);
  if (view == 1u) return vec3(samples, samples < float(kUsedFeatures + 1), samples <= 0.0);
  if (samples <= 0.0) return vec3(0.0);
  const vec2 pivots = pivotsOf(normalEquations(p));
  return vec3(pivots, pivots.y > 0.0);
}

void write(ivec2 cell, OuterProducts p) {
  const vec3 value = viewOf(p);
  for (int i = 0; i < constants.factor * constants.factor; ++i) {
    const ivec2 pixel = constants.factor * cell + ivec2(i % constants.factor, i / constants.factor);
    if (all(lessThan(pixel, imageSize(outView)))) imageStore(outView, pixel, vec4(value, 1.0));
  }
}
#else
Coefficients solve(OuterProducts p) {
  Coefficients result;
  result.constant = vec4(0.0);
  [[unroll]] for (int k = 0; k < kSlopeVectors; ++k) result.slope[k] = vec4(0.0);
  if (productAt(p, 0) <= 0.0) return result;

  const NormalEquations e = normalEquations(p);
  const vec3 slope[kFeatures] = choleskySolve(e.factor, e.yx);
  result.constant = vec4(e.y, 1.0);
  [[unroll]] for (int i = 0; i < kUsedFeatures; ++i) {
    result.constant.rgb -= slope[i] * e.x[i];
    [[unroll]] for (int c = 0; c < 3; ++c) result.slope[(3 * i + c) / 4][(3 * i + c) % 4] = slope[i][c];
  }
  return result;
}

void write(ivec2 cell, OuterProducts p) {
  const Coefficients result = solve(p);
  outCells[vectorIndex(cell, 0)] = result.constant;
  [[unroll]] for (int k = 0; k < kSlopeVectors; ++k) outCells[vectorIndex(cell, 1 + k)] = result.slope[k];
}
#endif

OuterProducts productsOf(ivec2 cell) {
  OuterProducts p;
  [[unroll]] for (int k = 0; k < kFirstVectors; ++k) p.v[k] = cells[vectorIndex(cell, k)];
  [[unroll]] for (int k = kFirstVectors; k < kProductVectors; ++k)
    p.v[k] = moreCells[vectorIndex(cell, k - kFirstVectors)];
  return p;
}

void main() {
  const ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
  if (!insideGrid(cell)) return;
  OuterProducts sum = noSamples();
  const int first = max(cell.y - constants.radius, 0), last = min(cell.y + constants.radius, constants.cells.y - 1);
  for (int y = first; y <= last; ++y) add(sum, gaussian(y - cell.y), productsOf(ivec2(cell.x, y)));
  write(cell, sum);
}
