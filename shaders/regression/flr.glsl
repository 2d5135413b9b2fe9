// FLR (Salmi et al. 2024): the guides of the regression, their outer products, and the grid of cells.
// Needs: `constants` (FlrConstants), GL_EXT_control_flow_attributes. Takes constant_id 10 and 11.
#ifndef WALR_FLR_GLSL
#define WALR_FLR_GLSL

// The guides besides the constant: shading normal, inverse depth, which is linear over the image of a plane, ambient
// occlusion, and three of a network. The first kUsedFeatures are used: 4, 5 or all of them. With kLearnedAlone there are
// five of a network instead. Their number is known when the pipeline is made, so that loops over them are unrolled and
// arrays stay in registers.
const int kInverseDepth = 3, kOcclusion = 4, kLearned = 5, kFeatures = 8;
layout(constant_id = 10) const int kUsedFeatures = 4;
layout(constant_id = 11) const bool kLearnedAlone = false;
const bool kOcclusionGuide = kUsedFeatures > kOcclusion, kLearnedGuides = kLearnedAlone || kUsedFeatures > kLearned;
const int kCovariances = kFeatures * (kFeatures + 1) / 2;
#include "common/triangle.glsl"

// Sums over samples of the distinct entries of (1, x)(1, x)^T, row by row, then of (1, x) y^T, where x are the guides
// and y is the colour. The first sum is the number of samples.
const int kMeanY = (kUsedFeatures + 1) * (kUsedFeatures + 2) / 2;
const int kProducts = kMeanY + 3 * (kUsedFeatures + 1);
const int kProductVectors = (kProducts + 3) / 4;

// Index of entry (i, j) of (1, x)(1, x)^T, i <= j.
int productIndex(int i, int j) { return i * (2 * kUsedFeatures - i + 1) / 2 + j; }

const int kFirstVectors = kProductVectors < kMostFirstVectors ? kProductVectors : kMostFirstVectors;

struct OuterProducts {
  vec4 v[18];  // kProductVectors of all guides.
};

float productAt(OuterProducts p, int k) { return p.v[k / 4][k % 4]; }
// Sum of the colour (`i` = 0), or of the colour times guide `i`, where guides count from 1.
vec3 colourProductAt(OuterProducts p, int i) {
  const int k = kMeanY + 3 * i;
  return vec3(productAt(p, k), productAt(p, k + 1), productAt(p, k + 2));
}

OuterProducts noSamples() {
  OuterProducts p;
  [[unroll]] for (int k = 0; k < kProductVectors; ++k) p.v[k] = vec4(0.0);
  return p;
}

OuterProducts outerProducts(float x[kFeatures], vec3 y) {
  float row[kFeatures + 1];
  row[0] = 1.0;
  [[unroll]] for (int i = 0; i < kUsedFeatures; ++i) row[i + 1] = x[i];
  OuterProducts p = noSamples();
  [[unroll]] for (int i = 0; i <= kUsedFeatures; ++i) {
    [[unroll]] for (int j = 0; j <= kUsedFeatures; ++j) {
      const int k = productIndex(i, j);
      if (j >= i) p.v[k / 4][k % 4] = row[i] * row[j];
    }
  }
  [[unroll]] for (int i = 0; i <= kUsedFeatures; ++i) {
    [[unroll]] for (int c = 0; c < 3; ++c) {
      const int k = kMeanY + 3 * i + c;
      p.v[k / 4][k % 4] = row[i] * y[c];
    }
  }
  return p;
}

void add(inout OuterProducts sum, float weight, OuterProducts p) {
  [[unroll]] for (int k = 0; k < kProductVectors; ++k) sum.v[k] += weight * p.v[k];
}

float gaussian(int distance) {
  const float d = float(distance) / constants.sigma;
  return exp(-0.5 * d * d);
}

// Colour = constant + slope^T x. In a buffer the constant is vector 0.
const int kSlopeVectors = (3 * kUsedFeatures + 3) / 4;
struct Coefficients {
  vec4 constant;                  // rgb; 1 where there is a fit, else 0.
  vec4 slope[3 * kFeatures / 4];  // rgb of every guide in turn.
};

bool insideGrid(ivec2 cell) { return all(greaterThanEqual(cell, ivec2(0))) && all(lessThan(cell, constants.cells)); }

// A buffer holds the first vectors of all cells, then the second ones, and so on: neighbouring threads access
// neighbouring addresses.
uint vectorIndex(ivec2 cell, int vector) {
  return uint(cell.y * constants.cells.x + cell.x) + uint(vector) * uint(constants.cells.x * constants.cells.y);
}

#endif
