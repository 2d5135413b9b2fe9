// FLR, third stage (flr-flnr.txt): the vertical half of the Gaussian, then the weighted least squares of every cell.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "constants/flr.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant) uniform PushConstants { FlrConstants settings; };
#include "include/flr.glsl"
#include "include/cholesky.glsl"

layout(set = 0, binding = 0, std430) readonly buffer blurred { OuterProducts cells[]; };
layout(set = 0, binding = 1, std430) writeonly buffer outCoefficients { Coefficients outCells[]; };

// Solving the constant first leaves the system of the covariances, so that the ridge holds the slopes and not the mean:
// on the constant it would darken the fit. Inverse depth is not of order 1 as the other guides are; its ridge is
// relative.
Coefficients solve(OuterProducts p) {
  Coefficients result;
  result.constant = vec4(0.0);
  for (int k = 0; k < kSlopeVectors; ++k) result.slope[k] = vec4(0.0);
  const float samples = productAt(p, 0);
  if (samples <= 0.0) return result;

  const float scale = 1.0 / samples;
  const vec3 y = scale * colourProductAt(p, 0);
  float x[kFeatures], ridge[kFeatures], covariances[kCovariances];
  vec3 yx[kFeatures];
  for (int i = 0; i < kFeatures; ++i) x[i] = scale * productAt(p, kMeanX + i);
  for (int i = 0; i < kFeatures; ++i) {
    ridge[i] = settings.ridge * (i == kInverseDepth ? x[i] * x[i] : 1.0);
    yx[i] = scale * colourProductAt(p, i + 1) - y * x[i];
    for (int j = 0; j < kFeatures; ++j) {
      if (j < i) continue;
      const int k = triangleEntry(j, i);
      covariances[k] = scale * productAt(p, kSquares + k) - x[i] * x[j];
    }
  }
  const vec3 slope[kFeatures] = choleskySolve(choleskyFactor(covariances, ridge, ridge), yx);

  result.constant = vec4(y, 1.0);
  for (int i = 0; i < kFeatures; ++i) {
    result.constant.rgb -= slope[i] * x[i];
    for (int c = 0; c < 3; ++c) result.slope[(3 * i + c) / 4][(3 * i + c) % 4] = slope[i][c];
  }
  return result;
}

void main() {
  const ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
  if (!insideGrid(cell)) return;
  OuterProducts sum = noSamples();
  for (int i = -settings.radius; i <= settings.radius; ++i) {
    const ivec2 tap = cell + ivec2(0, i);
    if (insideGrid(tap)) add(sum, gaussian(i), cells[cellIndex(tap)]);
  }
  outCells[cellIndex(cell)] = solve(sum);
}
