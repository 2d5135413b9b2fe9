// The guides of Fast Local Regression (flr-flnr.txt), their outer products and the grid these live on.
// Needs: `settings` (FlrConstants).
#ifndef WALR_FLR_GLSL
#define WALR_FLR_GLSL
#include "surface.glsl"

// The guides beside the constant: shading normal and inverse depth, which is linear over the image of a plane.
vec4 guidesOf(float z, uint shadingNormal) { return vec4(unpackNormal(shadingNormal), 1.0 / z); }

// Sums over samples of the distinct entries of (1, x)(1, x)^T and of (1, x) y^T, x the four guides, y the colour.
struct OuterProducts {
  vec4 x;
  vec4 xx0;  // x[0] * x
  vec4 xx1;  // x[1] * x[1..3], then the number of samples.
  vec4 xx2;  // x[2] * x[2], x[2] * x[3], x[3] * x[3]; unused.
  vec4 y;    // rgb; unused.
  vec4 yx[3];  // red * x, green * x, blue * x.
};

OuterProducts noSamples() {
  return OuterProducts(vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4[3](vec4(0.0), vec4(0.0), vec4(0.0)));
}

OuterProducts outerProducts(vec4 x, vec3 y) {
  return OuterProducts(x, x.x * x, vec4(x.y * x.yzw, 1.0), vec4(x.z * x.zw, x.w * x.w, 0.0), vec4(y, 0.0),
                       vec4[3](y.r * x, y.g * x, y.b * x));
}

void add(inout OuterProducts sum, float weight, OuterProducts p) {
  sum.x += weight * p.x;
  sum.xx0 += weight * p.xx0;
  sum.xx1 += weight * p.xx1;
  sum.xx2 += weight * p.xx2;
  sum.y += weight * p.y;
  for (int c = 0; c < 3; ++c) sum.yx[c] += weight * p.yx[c];
}

float gaussian(int distance) {
  const float d = float(distance) / settings.sigma;
  return exp(-0.5 * d * d);
}

// Colour = constant + slope^T x.
struct Coefficients {
  vec4 constant;  // rgb; 1 where there is a fit, else 0.
  vec4 slope[3];  // Of red, green and blue over the guides.
};

bool insideGrid(ivec2 cell) { return all(greaterThanEqual(cell, ivec2(0))) && all(lessThan(cell, settings.cells)); }
uint cellIndex(ivec2 cell) { return uint(cell.y * settings.cells.x + cell.x); }

#endif
