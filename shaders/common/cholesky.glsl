// Cholesky decomposition of the covariance matrix of the features, and the solution for the slopes.
// Needs: `kFeatures`, the length of arrays of features; `kCovariances`, the number of entries of one triangle of their
// matrix; `kUsedFeatures`, how many of them there are, which may be a specialization constant;
// GL_EXT_control_flow_attributes.
#ifndef WALR_CHOLESKY_GLSL
#define WALR_CHOLESKY_GLSL
#include "common/triangle.glsl"

// The loops are marked [[unroll]], because some drivers unroll loops of this size only on request. An array whose index
// is not a constant turns into a tree of branches, one for each entry.

// Lower factor of the covariance matrix with `ridge` added to its diagonal. Rounding may make a variance negative or a
// pivot too small: variances are raised to 0, pivots to `least`.
float[kCovariances] choleskyFactor(float covariances[kCovariances], float ridge[kFeatures], float least[kFeatures]) {
  float l[kCovariances];
  [[unroll]] for (int j = 0; j < kUsedFeatures; ++j) {
    [[unroll]] for (int i = 0; i < kUsedFeatures; ++i) {
      if (i < j) continue;
      float value = covariances[triangleEntry(i, j)];
      if (i == j) value = max(value, 0.0) + ridge[i];
      [[unroll]] for (int c = 0; c < kUsedFeatures; ++c) {
        if (c < j) value -= l[triangleEntry(i, c)] * l[triangleEntry(j, c)];
      }
      l[triangleEntry(i, j)] = i == j ? sqrt(max(value, least[i])) : value / l[triangleEntry(j, j)];
    }
  }
  return l;
}

// Slopes of the colour over the features: solves L L^T x = yx by forward, then back substitution.
vec3[kFeatures] choleskySolve(float l[kCovariances], vec3 yx[kFeatures]) {
  vec3 x[kFeatures];
  [[unroll]] for (int i = 0; i < kUsedFeatures; ++i) {
    vec3 value = yx[i];
    [[unroll]] for (int c = 0; c < kUsedFeatures; ++c) {
      if (c < i) value -= l[triangleEntry(i, c)] * x[c];
    }
    x[i] = value / l[triangleEntry(i, i)];
  }
  [[unroll]] for (int i = kUsedFeatures - 1; i >= 0; --i) {
    vec3 value = x[i];
    [[unroll]] for (int c = 0; c < kUsedFeatures; ++c) {
      if (c > i) value -= l[triangleEntry(c, i)] * x[c];
    }
    x[i] = value / l[triangleEntry(i, i)];
  }
  return x;
}

#endif
