// FLR, third stage (flr-flnr.txt): the vertical half of the Gaussian, then the weighted least squares of every cell.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "constants/flr.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant) uniform PushConstants { FlrConstants settings; };
#include "include/flr.glsl"

layout(set = 0, binding = 0, std430) readonly buffer blurred { OuterProducts cells[]; };
layout(set = 0, binding = 1, std430) writeonly buffer outCoefficients { Coefficients outCells[]; };

// Lower Cholesky factor of a symmetric matrix; pivots that rounding has taken below `least` are raised to it.
mat4 choleskyFactor(mat4 a, vec4 least) {
  mat4 l = mat4(0.0);  // l[column][row]
  for (int j = 0; j < 4; ++j) {
    for (int i = j; i < 4; ++i) {
      float value = a[j][i];
      for (int k = 0; k < j; ++k) value -= l[k][i] * l[k][j];
      l[j][i] = i == j ? sqrt(max(value, least[j])) : value / l[j][j];
    }
  }
  return l;
}

// Solve l l^T x = b.
vec4 choleskySolve(mat4 l, vec4 b) {
  vec4 x = b;
  for (int i = 0; i < 4; ++i) {
    for (int k = 0; k < i; ++k) x[i] -= l[k][i] * x[k];
    x[i] /= l[i][i];
  }
  for (int i = 3; i >= 0; --i) {
    for (int k = i + 1; k < 4; ++k) x[i] -= l[i][k] * x[k];
    x[i] /= l[i][i];
  }
  return x;
}

// Solving the constant first leaves the system of the covariances, so that the ridge holds the slopes and not the mean:
// on the constant it would darken the fit. Inverse depth is not of order 1 as the normal is; its ridge is relative.
Coefficients solve(OuterProducts p) {
  const float samples = p.xx1.w;
  if (samples <= 0.0) return Coefficients(vec4(0.0), vec4[3](vec4(0.0), vec4(0.0), vec4(0.0)));
  const float scale = 1.0 / samples;
  const vec4 x = p.x * scale;
  const mat4 xx = mat4(p.xx0, vec4(p.xx0.y, p.xx1.xyz), vec4(p.xx0.z, p.xx1.y, p.xx2.xy), vec4(p.xx0.w, p.xx1.z, p.xx2.yz));
  const vec4 ridge = settings.ridge * vec4(1.0, 1.0, 1.0, x.w * x.w);
  mat4 covariance = xx * scale - outerProduct(x, x);
  for (int i = 0; i < 4; ++i) covariance[i][i] = max(covariance[i][i], 0.0) + ridge[i];
  const mat4 factor = choleskyFactor(covariance, ridge);

  Coefficients result;
  result.constant = vec4(0.0, 0.0, 0.0, 1.0);
  for (int c = 0; c < 3; ++c) {
    const float y = p.y[c] * scale;
    result.slope[c] = choleskySolve(factor, p.yx[c] * scale - y * x);
    result.constant[c] = y - dot(result.slope[c], x);
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
