// Arithmetic of paths that both path tracers compute to the same bits; C++ and shaders include it.
//
// A normal map turns a rounding of a hit into another direction, so that the next hit lies elsewhere, and every bounce
// enlarges the difference. Everything that a path's next ray depends on is therefore computed by the functions of this
// folder. They use only operations that IEEE 754 rounds correctly (+, -, *, 1 / x and square roots), in the order that
// is written: `precise` in GLSL and -ffp-contract=off in C++ keep compilers from changing it. A quotient is written as
// a product with a reciprocal, because drivers divide so.
//
// Vulkan lets a device's 1 / x err by 2.5 units in the last place and its square root by more, and denormalized numbers
// may become 0. On a device that uses this the paths agree less.
#ifndef WALR_RENDER_EXACT_ARITHMETIC_H
#define WALR_RENDER_EXACT_ARITHMETIC_H
#ifdef __cplusplus
#include <cmath>

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "shaders/common/types.h"

#define WALR_EXACT inline
#define WALR_EXACT_CONSTANT inline constexpr
namespace walr::render::exact {
using glm::mat3;
using glm::max;
using glm::min;
using glm::vec3;
using std::abs;
using std::floor;
using std::sqrt;
#else
#define WALR_EXACT precise
#define WALR_EXACT_CONSTANT const
#endif

WALR_EXACT_CONSTANT float kPi = 3.14159265358979f;

WALR_EXACT float exactDot(vec3 a, vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

WALR_EXACT vec3 exactCross(vec3 a, vec3 b) {
  return vec3(a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y);
}

// A vector scaled to length 1; `fallback` if its length is 0 or not finite.
WALR_EXACT vec3 unitOr(vec3 v, vec3 fallback) {
  const float size = sqrt(exactDot(v, v));
  return size > 0.0f && size <= 3.4e38f ? v * (1.0f / size) : fallback;
}

WALR_EXACT vec3 transformDirection(mat3 m, vec3 v) {
  return m[0] * v.x + m[1] * v.y + m[2] * v.z;
}

WALR_EXACT vec3 transformPoint(mat4 m, vec3 p) {
  return (vec3(m[0]) * p.x + vec3(m[1]) * p.y) + (vec3(m[2]) * p.z + vec3(m[3]));
}

// Values at a triangle's corners, interpolated by the weights of the second and third.
WALR_EXACT vec2 interpolate(vec2 first, vec2 second, vec2 third, vec2 weights) {
  return first * (1.0f - weights.x - weights.y) + second * weights.x + third * weights.y;
}
WALR_EXACT vec3 interpolate(vec3 first, vec3 second, vec3 third, vec2 weights) {
  return first * (1.0f - weights.x - weights.y) + second * weights.x + third * weights.y;
}
WALR_EXACT vec4 interpolate(vec4 first, vec4 second, vec4 third, vec2 weights) {
  return first * (1.0f - weights.x - weights.y) + second * weights.x + third * weights.y;
}

WALR_EXACT vec4 blend(vec4 first, vec4 second, float weightOfSecond) {
  return first * (1.0f - weightOfSecond) + second * weightOfSecond;
}

// Cosine (x) and sine (y) of an angle in turns, from 0 on, to within a few roundings. The polynomials are those of
// Cephes' sinf and cosf (S. Moshier).
WALR_EXACT vec2 cosineAndSine(float turns) {
  const int quarters = int(4.0f * turns + 0.5f);
  const float angle = (4.0f * turns - float(quarters)) * (0.5f * kPi);
  const float z = angle * angle;
  const float sine = ((-1.9515295891e-4f * z + 8.3321608736e-3f) * z - 1.6666654611e-1f) * z * angle + angle;
  const float cosine =
      ((2.443315711809948e-5f * z - 1.388731625493765e-3f) * z + 4.166664568298827e-2f) * z * z - 0.5f * z + 1.0f;
  // Turns by quarters without branches, which processors would predict wrongly.
  const float odd = float(quarters & 1);
  const float even = 1.0f - odd;
  const float side = float(1 - (quarters & 2));
  return vec2(cosine * even - sine * odd, sine * even + cosine * odd) * side;
}

#ifdef __cplusplus
}  // namespace walr::render::exact
#endif
#endif
