// Counts what looks wrong in specular light, and in what a host says of what it reflects. lint_inputs.h says what the
// counts are; passes/lint/lint_specular.cpp draws the conclusions.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "conventions/frame.h"
#include "conventions/camera.glsl"
#include "conventions/lobe.glsl"
#include "lint/lint_inputs.h"
#include "lint/albedo_contrast.glsl"
#include "walr/specular_albedo.h"
#include "common/finite.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
// What the host has.
layout(constant_id = 0) const bool kDistance = true;  // Of what is reflected, in the alpha of the light.
layout(constant_id = 1) const bool kRoughness = true;
layout(constant_id = 2) const bool kMotion = true;  // Of what is reflected, and of depth.
layout(constant_id = 3) const bool kDiffuseAlbedo = true;
layout(constant_id = 4) const bool kDiffuseLight = true;
layout(constant_id = 5) const bool kNormalsInWorldSpace = false;
layout(constant_id = 6) const bool kMotionJittered = true;
layout(constant_id = 7) const bool kOwnAlbedo = true;  // The albedo depends on roughness as walrSpecularAlbedo does.

layout(std140) uniform frameConstants { FrameConstants frame; };
uniform texture2D lighting;
uniform texture2D depth;
uniform texture2D normal;
uniform texture2D motion;
uniform texture2D specularAlbedo;
uniform texture2D roughness;
uniform texture2D specularMotion;
uniform texture2D albedo;
uniform texture2D diffuse;
layout(std430) buffer counters { uint words[]; };
#include "conventions/light_sample.glsl"

const uint kFirstCount = kLintInputWords, kCounts = kLintCountWords - kLintInputWords;
#include "lint/counts.glsl"
#include "lint/surfaces.glsl"

struct Pixel {
  ivec2 place;
  float depth;
  vec3 normal;  // In view space, not of unit length.
  vec3 albedo;  // Of the lobe.
  float roughness;
  LightSample light;
  float distance;
};

float largest(vec3 v) { return max(max(v.x, v.y), v.z); }

vec3 positionAt(ivec2 p) { return rayThrough(frame.rayFromPixel, pixelCentre(p)) * depthAt(p); }

float distanceAt(ivec2 p) {
  ivec2 texel;
  return hasLightTexel(p, texel) ? texelFetch(lighting, texel, 0).a : 0.0;
}

Pixel pixelAt(ivec2 p) {
  const vec3 n = texelFetch(normal, p, 0).xyz;
  return Pixel(p, depthAt(p), kNormalsInWorldSpace ? mat3(frame.viewFromWorld) * n : n,
               texelFetch(specularAlbedo, p, 0).xyz, kRoughness ? texelFetch(roughness, p, 0).x : 0.0,
               lightSampleAt(lighting, p), kDistance ? distanceAt(p) : 0.0);
}

bool reflectsSurface(Pixel at) { return at.distance > 0.0 && at.distance < min(frame.skyDepth, kLargestHalf); }

void countValues(Pixel at) {
  const vec3 moved = kMotion ? texelFetch(specularMotion, at.place, 0).xyz : vec3(0.0);
  // What halves cannot hold, such as 1e10, may be infinity, and is far away.
  const bool distanceFinite = isFinite(at.distance) || isInfinity(at.distance);
  count(kSpecularNotFinite, !isFinite(at.light.radiance) || !isFinite(at.albedo) || !distanceFinite ||
                                !isFinite(at.roughness) || !isFinite(moved));
  count(kSpecularNegative, any(lessThan(at.light.radiance, vec3(0.0))));
  count(kSpecularDistanceNegative, at.distance < 0.0);
  count(kSpecularDistances, reflectsSurface(at));
  count(kSpecularDistanceOne, at.distance == 1.0);
  count(kSpecularDistanceShort, at.distance > 0.0 && at.distance < kShortDistance * at.depth);
  count(kSpecularRoughnessOutside, at.roughness < 0.0 || at.roughness > 1.0);
  count(kLintSpecularSurfaces, true);
  count(kLintSpecularSampled, !kDistance || at.distance > 0.0);
  count(kLintSpecularLit, largest(at.light.radiance) > 0.0);
  count(kLintSpecularAlbedo, largest(at.albedo) > 0.0);
}

void countPair(Pixel here, ivec2 q) {
  if (!kRoughness || !inside(q)) return;
  const Pixel there = pixelAt(q);
  if (!here.light.exists || !there.light.exists) return;
  if (!areOnOneSurface(here.depth, here.normal, there.depth, there.normal)) return;
  if (!(abs(here.roughness - there.roughness) <= 0.02)) return;
  bool follows;
  const uint contrast =
      albedoContrast(here.light.radiance, there.light.radiance, here.albedo, there.albedo, follows);
  count((follows ? kSpecularFollowsAlbedo : kSpecularIgnoresAlbedo) + contrast - 1u, contrast > 0u);
}

// On dielectrics, whose albedo depends on roughness in a known way.
void countRoughness(Pixel at) {
  const bool dielectric = at.albedo.x == at.albedo.y && at.albedo.y == at.albedo.z &&
                          (!kDiffuseAlbedo || largest(texelFetch(albedo, at.place, 0).xyz) > kAlbedoLeast);
  if (!dielectric || !(at.roughness > 0.0 && at.roughness < 1.0)) return;
  const vec3 ray = normalize(rayThrough(frame.rayFromPixel, pixelCentre(at.place)));
  const float cosine = min(abs(dot(at.normal, ray)), 1.0);
  const float readings[kRoughnessReadingCount] =
      float[](at.roughness, sqrt(at.roughness), at.roughness * at.roughness);
  float errors[kRoughnessReadingCount];
  uint best = 0u;
  for (uint i = 0u; i < kRoughnessReadingCount; ++i) {
    errors[i] = abs(walrSpecularAlbedo(0.04, readings[i], cosine) / at.albedo.x - 1.0);
    if (errors[i] < errors[best]) best = i;
  }
  // Beyond the error of the formula and of halves; the others must be clearly farther away.
  const float kFits = 0.08;
  uint near = 0u;
  for (uint i = 0u; i < kRoughnessReadingCount; ++i) near += errors[i] < errors[best] + kFits ? 1u : 0u;
  count(kRoughnessReadings + best, errors[best] < kFits && near == 1u);
}

void countMetal(Pixel at) {
  const float kMetallic = 0.1;  // Above dielectrics, which are near .04 unless seen at grazing angles.
  if (!kDiffuseLight || !kDiffuseAlbedo) return;
  if (!(largest(texelFetch(albedo, at.place, 0).xyz) < kAlbedoLeast && largest(at.albedo) > kMetallic)) return;
  count(kLintMetals, true);
  count(kLintMetalsDiffuse, largest(texelFetch(diffuse, at.place, 0).xyz) > 0.0);
  count(kLintMetalsSpecular, largest(at.light.radiance) > 0.0);
}

// Whether the picture shows a point, and which pixel does.
bool countPoint(vec3 point, uint seenWord, uint inAirWord, out ivec2 pixel) {
  const float kOnSurface = 0.02;  // Over depth: so near to a surface, it lies on it. Lobes of mirrors are .005 radians wide.
  pixel = ivec2(0);
  if (!(point.z < 0.0)) return false;
  const vec2 place = pixelOf(frame.rayFromPixel, point);
  // One pixel around it is looked at, too.
  const vec2 size = vec2(textureSize(depth, 0));
  if (!(all(greaterThanEqual(place, vec2(1.0))) && all(lessThan(place, size - 1.0)))) return false;
  pixel = ivec2(place);
  bool seen = false, inAir = true;
  for (int i = 0; i < 9; ++i) {
    const float z = depthAt(pixel + ivec2(i % 3, i / 3) - 1);
    seen = seen || abs(z + point.z) <= -kOnSurface * point.z;
    inAir = inAir && z > -(1.0 + kOnSurface) * point.z;
  }
  count(seenWord, seen);
  count(inAirWord, inAir);
  return abs(depthAt(pixel) + point.z) <= -kOnSurface * point.z;
}

// What a mirror shows moves as the same surface does where the picture shows it, at pixel `p`.
void countMotion(ivec2 p, vec3 told) {
  const float kLeastMotion = 0.5;  // Pixels; what moves by less says little, because motion is in halves.
  const vec3 given = texelFetch(motion, p, 0).xyz;
  const vec2 jittered = kMotionJittered ? vec2(0.0) : frame.jitterDelta;
  const vec2 before = pixelCentre(p) + given.xy * frame.motionScale + jittered;
  const float z = depthAt(p);
  const vec3 previous = rayThrough(frame.previousRayFromPixel, before) * (z + given.z);
  // In view space of this frame, as a still camera sees it.
  const vec3 moved = (inverse(frame.previousViewFromView) * vec4(previous, 1.0)).xyz - positionAt(p);
  if (!isFinite(moved) || !isFinite(told) || length(moved) < kLeastMotion * z * abs(frame.rayFromPixel.y)) return;
  if (told == vec3(0.0)) {
    count(kReflectedMotions + kReflectedMotionCount - 1u, true);
    return;
  }
  const vec3 turned = mat3(frame.viewFromWorld) * told;
  const float errors[kReflectedMotionCount] =
      float[](distance(turned, moved), distance(-turned, moved), distance(told, moved), length(moved));
  uint best = 0u;
  for (uint i = 1u; i < kReflectedMotionCount; ++i) best = errors[i] < errors[best] ? i : best;
  // Only one that is clearly nearer than the others counts.
  uint near = 0u;
  for (uint i = 0u; i < kReflectedMotionCount; ++i) near += errors[i] <= 2.0 * errors[best] ? 1u : 0u;
  count(kReflectedMotions + best, near == 1u);
}

void countReflection(Pixel at) {
  if (!(at.roughness >= 0.0 && at.roughness <= kMirrorUpTo)) return;
  if (!reflectsSurface(at)) return;
  if (!isFinite(at.normal) || length(at.normal) < 0.5) return;
  const vec3 position = positionAt(at.place);
  const vec3 mirrored = reflect(normalize(position), normalize(at.normal));
  ivec2 shown, unused;
  const bool isShown = countPoint(position + at.distance * mirrored, kReflectedSeen, kReflectedInAir, shown);
  const float rest = at.distance - length(position);
  if (rest > 0.0) countPoint(position + rest * mirrored, kFromEyeSeen, kFromEyeInAir, unused);
  if (kMotion && isShown) countMotion(shown, texelFetch(specularMotion, at.place, 0).xyz);
}

void main() {
  clearCounts();
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (inside(p) && isSurfaceDepth(depthAt(p))) {
    const Pixel at = pixelAt(p);
    countValues(at);
    countPair(at, p + ivec2(1, 0));
    countPair(at, p + ivec2(0, 1));
    if (kRoughness && kOwnAlbedo) countRoughness(at);
    if (kRoughness && kDistance) countReflection(at);
    countMetal(at);
  }
  addCounts();
}
