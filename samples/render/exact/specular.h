// The specular lobe of glTF 2.0 (appendix B): GGX, Smith's height-correlated masking, Schlick's Fresnel term. The
// direction of a reflection has the same bits in both path tracers. See arithmetic.h for why and how.
#ifndef WALR_RENDER_EXACT_SPECULAR_H
#define WALR_RENDER_EXACT_SPECULAR_H
#include "integration/include/walr/specular_albedo.h"
#include "samples/render/exact/path.h"
#ifdef __cplusplus
namespace walr::render::exact {
#endif

WALR_EXACT_CONSTANT float kDielectric = 0.04f;  // Reflectance at normal incidence.
// Paths that begin with a reflection take other random numbers than those of diffuse light.
WALR_EXACT_CONSTANT uint kSpecularSeed = 0x5bec0a12u;

// A mirror is a lobe that is narrower than a pixel, so that it needs no rules of its own.
WALR_EXACT float alphaOf(float roughness) {
  return max(roughness * roughness, 1e-4f);
}

// A metal of less linear roughness is a mirror whose picture is that of another surface. Its own diffuse light, the
// rest to a metallic of 1, is not in that picture and gets lost, so that there may only be little of it.
WALR_EXACT_CONSTANT float kMirrorRoughness = 0.15f;
WALR_EXACT_CONSTANT float kMirrorMetallic = 0.95f;

WALR_EXACT bool isMirror(float metallic, float roughness) {
  return metallic >= kMirrorMetallic && roughness < kMirrorRoughness;
}

// A pixel is followed through at most this many mirrors.
WALR_EXACT_CONSTANT int kMostMirrors = 8;

WALR_EXACT vec3 mirrorDirection(vec3 normal, vec3 towardsViewer) {
  return unitOr(normal * (2.0f * exactDot(normal, towardsViewer)) - towardsViewer, normal);
}

// The matrix that reflects points at the tangent plane of a mirror.
WALR_EXACT mat4 reflectionAt(vec3 normal, vec3 position) {
  return mat4(vec4(vec3(1.0f, 0.0f, 0.0f) - normal * (2.0f * normal.x), 0.0f),
              vec4(vec3(0.0f, 1.0f, 0.0f) - normal * (2.0f * normal.y), 0.0f),
              vec4(vec3(0.0f, 0.0f, 1.0f) - normal * (2.0f * normal.z), 0.0f),
              vec4(normal * (2.0f * exactDot(normal, position)), 1.0f));
}

// Reflectance of a lobe at normal incidence.
WALR_EXACT vec3 reflectanceOf(vec3 color, float metallic) {
  return vec3(kDielectric) * (1.0f - metallic) + color * metallic;
}

// The share of Schlick's term that does not depend on the reflectance.
WALR_EXACT float grazing(float cosine) {
  const float x = 1.0f - min(max(cosine, 0.0f), 1.0f);
  return x * x * x * x * x;
}

// The inverse of `fromLocal`.
WALR_EXACT vec3 toLocal(vec3 normal, vec3 direction) {
  return vec3(exactDot(fromLocal(normal, vec3(1.0f, 0.0f, 0.0f)), direction),
              exactDot(fromLocal(normal, vec3(0.0f, 1.0f, 0.0f)), direction), exactDot(normal, direction));
}

// What is left of a viewer's height after the caps of visible normals are bounded (K. Eto and Y. Tokuyoshi, "Bounded
// VNDF Sampling for Smith-GGX Reflections", SIGGRAPH Asia 2023), so that fewer reflections lead below rough surfaces.
WALR_EXACT float boundOf(vec3 viewer, float alpha) {
  const float reach = 1.0f + sqrt(viewer.x * viewer.x + viewer.y * viewer.y);
  const float squared = reach * reach;
  return (1.0f - alpha * alpha) * squared * (1.0f / (squared + alpha * alpha * viewer.z * viewer.z));
}

// A direction of reflection with the distribution of visible normals, sampled with spherical caps (J. Dupuy and A.
// Benyoub, "Sampling Visible GGX Normals with Spherical Caps", HPG 2023). It may lead below the surface.
WALR_EXACT vec3 reflectionDirection(vec3 normal, vec3 towardsViewer, float alpha, vec2 random) {
  const vec3 up = vec3(0.0f, 0.0f, 1.0f);
  const vec3 viewer = toLocal(normal, towardsViewer);
  const vec3 stretched = unitOr(vec3(alpha * viewer.x, alpha * viewer.y, viewer.z), up);
  const float low = boundOf(viewer, alpha) * stretched.z;
  const float z = (1.0f - random.y) * (1.0f + low) - low;
  const vec2 around = cosineAndSine(random.x) * sqrt(max(1.0f - z * z, 0.0f));
  const vec3 cap = vec3(around.x, around.y, z) + stretched;
  const vec3 facet = unitOr(vec3(alpha * cap.x, alpha * cap.y, max(cap.z, 1e-6f)), up);
  return unitOr(fromLocal(normal, facet * (2.0f * exactDot(viewer, facet)) - viewer), normal);
}

struct SpecularLobe {
  float value;    // BRDF without its Fresnel term.
  float density;  // Of `reflectionDirection`, per solid angle.
  float grazing;  // See above.
};

// The lobe for a direction of light above the surface.
WALR_EXACT SpecularLobe specularLobe(vec3 normal, vec3 towardsViewer, vec3 towardsLight, float alpha) {
  const vec3 viewer = toLocal(normal, towardsViewer);
  const vec3 light = toLocal(normal, towardsLight);
  const vec3 facet = unitOr(viewer + light, vec3(0.0f, 0.0f, 1.0f));
  const float z = max(viewer.z, 0.0f);
  // Products with cosines instead of quotients by them, which could be by 0.
  const float slope = (facet.x * facet.x + facet.y * facet.y) * (1.0f / (alpha * alpha)) + facet.z * facet.z;
  const float ofFacets = 1.0f / (kPi * alpha * alpha * slope * slope);
  const float ofViewer = sqrt(alpha * alpha + (1.0f - alpha * alpha) * z * z);
  const float ofLight = sqrt(alpha * alpha + (1.0f - alpha * alpha) * light.z * light.z);
  SpecularLobe lobe;
  lobe.value = 0.5f * ofFacets * (1.0f / (light.z * ofViewer + z * ofLight));
  lobe.density = 0.5f * ofFacets * (1.0f / (z * boundOf(viewer, alpha) + ofViewer));
  lobe.grazing = grazing(exactDot(viewer, facet));
  return lobe;
}

// The light that the lobe reflects is divided by this.
WALR_EXACT vec3 specularAlbedo(vec3 reflectance, float roughness, float cosine) {
  return vec3(walrSpecularAlbedo(reflectance.x, roughness, cosine),
              walrSpecularAlbedo(reflectance.y, roughness, cosine),
              walrSpecularAlbedo(reflectance.z, roughness, cosine));
}

#ifdef __cplusplus
}  // namespace walr::render::exact
#endif
#endif
