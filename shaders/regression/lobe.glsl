// The lobe of a pixel's specular light, of which the regression over blocks takes its features (passes/SPECULAR.md):
// the mirrored direction in place of the normal, the distance of the virtual image in place of the depth, and
// roughness in place of ambient occlusion.
#ifndef WALR_BLOCK_LOBE_GLSL
#define WALR_BLOCK_LOBE_GLSL
#include "conventions/lobe.glsl"
#include "conventions/reflector.glsl"
#include "regression/block_moments.glsl"

struct Lobe {
  vec3 direction;  // Mirrored, view space.
  float roughness;
  float distance;  // Of what is reflected from the surface, over that of the surface from the eye.
};

const float kFarthestReflection = 1000.0;  // A `distance`.

// `ray`: the view ray at depth 1.
Lobe lobeAt(uvec2 reflector, vec3 ray) {
  const float eye = length(ray);
  const float inverse = eye * distanceOf(reflector).inverse;
  return Lobe(reflect(ray / eye, unpackLongNormal(reflector.x)), roughnessOf(reflector),
              1.0 / max(inverse, 1.0 / kFarthestReflection));
}

// The depth of the virtual image over that of the surface, if the surface were flat.
float imageDepth(Lobe lobe) { return 1.0 + lobe.distance; }

// What stands in for the other features.
NormalAndOcclusion featuresOf(Lobe lobe) { return NormalAndOcclusion(lobe.direction, lobe.roughness); }

// The lobe with these features, of which that of depth must be relative to the surface's own.
Lobe lobeOf(float x[kFeatures]) {
  const float image = 1.0 / max(x[kDepthFeature] + 1.0, 1.0 / kFarthestReflection);
  return Lobe(vec3(x[0], x[1], x[2]), x[kOcclusionFeature], max(image - 1.0, 1.0 / kFarthestReflection));
}

// Weight of another lobe's light in the window of a lobe. The window is as wide as the lobe.
float sameLobe(Lobe own, Lobe other) {
  const vec3 turned = other.direction - own.direction;
  const float width = max(lobeAngle(own.roughness), 1e-3);
  const float farther = log(other.distance / own.distance) / 0.4, rougher = (other.roughness - own.roughness) / 0.1;
  return exp(-0.5 * (dot(turned, turned) / (width * width) + farther * farther + rougher * rougher));
}

// Weight of the fit of a window with this mean mirrored direction. To wide lobes all fits are near, from a roughness of
// .3 on.
float inLobe(Lobe own, vec3 mirrored) {
  const vec3 turned = (mirrored - own.direction) / max(lobeAngle(own.roughness), 1e-3);
  return exp(-0.5 * clamp(3.0 - 10.0 * own.roughness, 0.0, 1.0) * dot(turned, turned));
}

// Factor of the samples that a coarse fit counts for: no edge of a lobe ends its window.
float coarseTrust(float roughness) { return pow(min(roughness / 0.6, 1.0), 4.0); }

// Whether a lobe is so narrow that the fits miss more than elsewhere.
bool isNarrow(float roughness) { return roughness < 0.25; }

// Factor of the gain of accumulated light: the wider a lobe, the less there is that a fit could miss.
float residualGain(float roughness) {
  const float narrow = min(0.3 / max(roughness, 1e-3), 1.0);
  return narrow * narrow;
}

// Least share of accumulated light: a lobe that is narrower than some pixels shows an image. `pixel`: the angle of one.
float imageShare(float roughness, float pixel) {
  const float pixels = lobeAngle(roughness) / (4.0 * pixel);
  return 1.0 / (1.0 + pixels * pixels);
}

#endif
