// The image of a point in a curved mirror. Lengths are in units of the view depth of the mirror's pixel, and curvatures
// are inverse lengths: positive ones are convex.
#ifndef WALR_MIRROR_IMAGE_GLSL
#define WALR_MIRROR_IMAGE_GLSL

// Curvatures below this are those of a flat mirror whose normals were rounded to halves.
const float kLeastCurvature = 0.05;
// At grazing angles, curvature would count without bound.
const float kLeastMirrorCosine = 0.15;
// An image that is this near to the eye, over the eye's distance from the mirror, may be anywhere in the picture.
const float kNearestImage = 0.15;
const float kFarthestImage = 3000.0;

// The plane of incidence on a surface with the normal `n`, seen along `v`: `within` lies in it, `across` is
// perpendicular to it, and both are tangents of the surface.
struct Incidence {
  vec3 within;
  vec3 across;
  float cosine;  // Of the angle of incidence.
};

Incidence incidenceOf(vec3 v, vec3 n) {
  vec3 across = cross(v, n);
  // Seen along its normal, a surface has no plane of incidence, and any will do.
  if (dot(across, across) < 1e-8) across = cross(n, abs(n.x) < 0.9 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0));
  across = normalize(across);
  return Incidence(cross(n, across), across, max(-dot(v, n), kLeastMirrorCosine));
}

// The shape operator from differences of positions and of normals along a surface, by least squares.
struct ShapeSums {
  mat2 positions;
  mat2 normals;
};

void addDifference(inout ShapeSums sums, Incidence incidence, vec3 position, vec3 normal) {
  const vec2 p = vec2(dot(position, incidence.within), dot(position, incidence.across));
  const vec2 n = vec2(dot(normal, incidence.within), dot(normal, incidence.across));
  sums.positions += outerProduct(p, p);
  sums.normals += outerProduct(n, p);
}

// Curvature within the plane of incidence, and across it.
vec2 curvaturesOf(ShapeSums sums) {
  const float ridge = 1e-3 * (sums.positions[0][0] + sums.positions[1][1]) + 1e-12;
  const mat2 shape = sums.normals * inverse(sums.positions + mat2(ridge));
  const vec2 curvatures = vec2(shape[0][0], shape[1][1]);
  return mix(curvatures, vec2(0.0), lessThan(abs(curvatures), vec2(kLeastCurvature)));
}

// The mirror equation 1 / d' = 1 / d + 2 C / cos within the plane of incidence, and 1 / d + 2 C cos across it, which
// are Coddington's equations for a mirror: d' for both. Negative: the image lies before the mirror.
vec2 imageDistances(float inverseDistance, vec2 curvatures, float cosine) {
  const vec2 inverse = inverseDistance + 2.0 * curvatures * vec2(1.0 / cosine, cosine);
  const vec2 least = vec2(1.0 / kFarthestImage);
  return 1.0 / mix(inverse, least, lessThan(abs(inverse), least));
}

// Whether the eye, at this distance from the mirror, is too close to an image to tell where it is.
bool isNearEye(vec2 images, float eye) { return any(lessThan(abs(1.0 + images / eye), vec2(kNearestImage))); }

#endif
