// The geometry of paths that both path tracers compute to the same bits: rays, hits, normals and directions. See
// arithmetic.h for why and how.
#ifndef WALR_RENDER_EXACT_PATH_H
#define WALR_RENDER_EXACT_PATH_H
#include "samples/render/exact/arithmetic.h"
#ifdef __cplusplus
namespace walr::render::exact {
#endif

// Direction of the ray through a pixel's sample position.
// `pixel`: column and row; `jitter`: sample position minus pixel centre; `size`: pixels
WALR_EXACT vec3 primaryDirection(vec2 pixel, vec2 jitter, vec2 size, mat4 projection, mat4 worldFromView) {
  const vec2 place = (pixel + 0.5f + jitter) * vec2(1.0f / size.x, 1.0f / size.y);
  const vec2 slope = vec2(1.0f / projection[0][0], 1.0f / projection[1][1]);
  const vec3 direction = vec3((place.x * 2.0f - 1.0f) * slope.x, (1.0f - place.y * 2.0f) * slope.y, -1.0f);
  return unitOr(transformDirection(mat3(worldFromView), direction), vec3(0.0f, 0.0f, -1.0f));
}

// Weights of a triangle's second and third corner where a ray meets it (Moeller and Trumbore 1997). What casts rays
// tells which triangle that is; its own weights have other roundings. The weights are clamped, because roundings lead
// out of the triangle.
WALR_EXACT vec2 weightsOfHit(vec3 origin, vec3 direction, vec3 first, vec3 second, vec3 third) {
  const float kLeastDeterminant = 1e-37f;  // Its reciprocal is finite.
  const vec3 edge1 = second - first;
  const vec3 edge2 = third - first;
  const float determinant = exactDot(direction, exactCross(edge1, edge2));
  const float scale = abs(determinant) >= kLeastDeterminant ? 1.0f / determinant : 0.0f;
  const vec3 across = exactCross(direction, origin - first);
  const float x = min(max(exactDot(edge2, across) * scale, 0.0f), 1.0f);
  const float y = min(max(-exactDot(edge1, across) * scale, 0.0f), 1.0f - x);
  return vec2(x, y);
}

// Unit normal of a triangle's front. `winding`: -1 for a mirrored object, otherwise 1.
WALR_EXACT vec3 frontNormal(vec3 first, vec3 second, vec3 third, float winding, vec3 fallback) {
  return winding * unitOr(exactCross(second - first, third - first), fallback);
}

// A normal with a normal map applied (glTF 2.0, section 3.9.3).
// `handedness`: sign of the bitangent; `encoded`: texel, 0..1; `scale`: of its x and y
WALR_EXACT vec3 mapNormal(vec3 normal, vec3 tangent, float handedness, vec3 encoded, float scale) {
  const vec3 bitangent = exactCross(normal, tangent) * handedness;
  const vec3 local = (encoded * 2.0f - 1.0f) * vec3(scale, scale, 1.0f);
  return unitOr(tangent * local.x + bitangent * local.y + normal * local.z, normal);
}

// Bends a normal that points away from the viewer until it is perpendicular to the view direction.
WALR_EXACT vec3 facing(vec3 normal, vec3 viewDirection, vec3 fallback) {
  const float away = exactDot(normal, viewDirection);
  return away <= 0.0f ? normal : unitOr(normal - viewDirection * away, fallback);
}

WALR_EXACT vec3 offsetAlong(vec3 position, vec3 direction, float distance) {
  return position + direction * distance;
}

// A direction from the local frame of a unit normal, where the normal is +Z, in the normal's space (Duff et al. 2017).
WALR_EXACT vec3 fromLocal(vec3 normal, vec3 local) {
  const float side = normal.z < 0.0f ? -1.0f : 1.0f;
  const float a = -1.0f / (side + normal.z);
  const float b = normal.x * normal.y * a;
  const vec3 tangent = vec3(1.0f + side * normal.x * normal.x * a, side * b, -side * normal.x);
  const vec3 bitangent = vec3(b, side + normal.y * normal.y * a, -normal.y);
  return tangent * local.x + bitangent * local.y + normal * local.z;
}

// A cosine-distributed direction around a unit normal.
WALR_EXACT vec3 cosineDirection(vec3 normal, vec2 random) {
  const vec2 around = cosineAndSine(random.y) * sqrt(random.x);
  return fromLocal(normal, vec3(around.x, around.y, sqrt(1.0f - random.x)));
}

// Cosine between shading normal and direction; 0 for light from behind the shading normal or from below the surface.
WALR_EXACT float lightCosine(vec3 geometricNormal, vec3 shadingNormal, vec3 direction) {
  return exactDot(geometricNormal, direction) > 0.0f ? max(0.0f, exactDot(shadingNormal, direction)) : 0.0f;
}

#ifdef __cplusplus
}  // namespace walr::render::exact
#endif
#endif
