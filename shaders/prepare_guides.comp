// Converts the host's G-buffer into the guides that every later pass reads (passes/WALR.md, 1): view depth (0 where
// there is nothing to denoise) and the shading normal in octahedral form, whose two coordinates are features of the
// regression over pixels.
// GEOMETRIC_NORMAL: also the geometric normal, which spans planes.
// OCCLUSION, for filters over blocks or cells: ambient occlusion shares a texel with the shading normal, and the
// geometric normal is packed in 16 bits. Everything in the host's depth occludes, even a mirror, which is not denoised
// itself.
// VIEW: writes why pixels are not denoised, or which inputs are not finite, instead of guides.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_control_flow_attributes : require
#include "constants/frame.h"
#include "constants/prepare_guides.h"
#include "include/camera.glsl"
#include "include/finite.glsl"
#include "include/surface.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool kNormalsInWorldSpace = false;
layout(constant_id = 1) const bool kSky = true;  // Some pixels show the sky.

layout(std140) uniform frameConstants { FrameConstants frame; };
uniform texture2D depth;
uniform texture2D normal;
layout(constant_id = 3) const bool kDiffuseMask = true;  // Treat pixels without a diffuse lobe like sky.
uniform texture2D albedo;
#ifdef VIEW
layout(constant_id = 8) const uint kView = 0;  // Which quantity; numbered in viewOf.
layout(rgba32f) uniform writeonly image2D outView;
#else
layout(r32ui) uniform writeonly uimage2D outDepth;
#ifdef OCCLUSION
layout(constant_id = 2) const int kOcclusionSteps = 5;
layout(r32ui) uniform writeonly uimage2D outFeatures;
#else
layout(r32ui) uniform writeonly uimage2D outShadingNormal;
#endif
#endif
#ifdef GEOMETRIC_NORMAL
#ifdef OCCLUSION
layout(r16ui) uniform writeonly uimage2D outGeometricNormal;
#else
layout(r32ui) uniform writeonly uimage2D outGeometricNormal;
#endif
#endif
layout(push_constant) uniform PushConstants { PrepareGuidesConstants constants; };

bool isSurfaceDepth(float z, float skyDepth) { return isFinite(z) && z > 0.0 && (!kSky || z < skyDepth); }

#if defined(GEOMETRIC_NORMAL) || defined(OCCLUSION)
// View depth; 0 outside the image and on sky.
float surfaceDepthAt(ivec2 p, float skyDepth) {
  const ivec2 inside = clamp(p, ivec2(0), textureSize(depth, 0) - 1);
  const float z = texelFetch(depth, inside, 0).x;
  return inside == p && isSurfaceDepth(z, skyDepth) ? z : 0.0;
}
#endif
#ifdef OCCLUSION
#include "include/ambient_occlusion.glsl"
#endif

#ifdef GEOMETRIC_NORMAL
// Inverse depth, which is linear over the image of a plane; 0 outside the image and on sky.
float inverseDepthAt(ivec2 p) {
  const float z = surfaceDepthAt(p, frame.skyDepth);
  return z > 0.0 ? 1.0 / z : 0.0;
}

// One-sided difference of position along `axis`. It takes the side whose two pixels extrapolate better to the inverse
// depth of this one: across an edge the extrapolation fails. On an object one pixel wide it fails on both sides,
// perhaps by the same amount.
vec3 tangent(ivec2 p, ivec2 axis, float inverseDepth, out bool found) {
  const vec3 centre = rayThrough(frame.rayFromPixel, pixelCentre(p)) / inverseDepth;
  float bestError = constants.tangentTolerance * inverseDepth;
  found = false;
  vec3 best = vec3(0.0);
  for (int side = -1; side <= 1; side += 2) {
    const float near = inverseDepthAt(p + side * axis);
    if (near == 0.0) continue;
    const float far = inverseDepthAt(p + 2 * side * axis);
    const float error = far > 0.0 ? abs(2.0 * near - far - inverseDepth) : abs(near - inverseDepth);
    if (error <= bestError) {
      bestError = error;
      found = true;
      const vec3 neighbour = rayThrough(frame.rayFromPixel, pixelCentre(p + side * axis)) / near;
      best = float(side) * (neighbour - centre);
    }
  }
  return best;
}

// The normal of the visible surface, without normal mapping. What depth does not determine comes from the shading
// normal: on an object one pixel wide, depth says only that the normal is perpendicular to the one tangent.
vec3 geometricNormal(ivec2 p, float inverseDepth, vec3 shadingNormal) {
  bool foundX, foundY;
  const vec3 alongX = tangent(p, ivec2(1, 0), inverseDepth, foundX);
  const vec3 alongY = tangent(p, ivec2(0, 1), inverseDepth, foundY);
  vec3 n = cross(alongY, alongX);
  if (foundX != foundY) {
    const vec3 along = foundX ? alongX : alongY;
    n = shadingNormal * dot(along, along) - along * dot(along, shadingNormal);
  }
  const float lengthSquared = dot(n, n);
  if (!(lengthSquared > 0.0)) return shadingNormal;
  const vec3 unit = n * inversesqrt(lengthSquared);
  return dot(unit, shadingNormal) >= constants.normalAgreement ? unit : shadingNormal;
}

uint packGeometricNormal(vec3 n) {
#ifdef OCCLUSION
  return packShortNormal(n);
#else
  return packNormal(n);
#endif
}
#endif

// Diffuse albedo; 1 if it is not read.
vec3 albedoAt(ivec2 p) { return kDiffuseMask ? texelFetch(albedo, p, 0).xyz : vec3(1.0); }

// Whether the pixel reflects diffuse light.
bool hasDiffuseLobe(vec3 diffuse) {
  return isFinite(diffuse) && any(greaterThanEqual(diffuse, vec3(constants.albedoThreshold)));
}

bool isUsable(vec3 normal) {
  const float normalLength = length(normal);
  return isFinite(normal) && isFinite(normalLength) && normalLength > 0.0;
}

#ifdef VIEW
vec3 viewOf(ivec2 p) {
  const float z = texelFetch(depth, p, 0).x;
  const vec3 n = texelFetch(normal, p, 0).xyz;
  const vec3 diffuse = albedoAt(p);
  switch (kView) {
    case 0u:
      if (!isSurfaceDepth(z, frame.skyDepth)) return vec3(1.0, 0.0, 0.0);
      if (!isUsable(n)) return vec3(0.0, 1.0, 0.0);
      return vec3(0.0, 0.0, !hasDiffuseLobe(diffuse));
    case 1u: return vec3(!isFinite(z), !isFinite(n), !isFinite(diffuse));
  }
  return vec3(0.0);
}

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, textureSize(depth, 0)))) return;
  imageStore(outView, p, vec4(viewOf(p), 1.0));
}
#else
void storeGuides(ivec2 p, uint packedDepth, uint features, uint geometricNormal) {
  imageStore(outDepth, p, uvec4(packedDepth));
#ifdef OCCLUSION
  imageStore(outFeatures, p, uvec4(features));
#else
  imageStore(outShadingNormal, p, uvec4(features));
#endif
#ifdef GEOMETRIC_NORMAL
  imageStore(outGeometricNormal, p, uvec4(geometricNormal));
#endif
}

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, textureSize(depth, 0)))) return;

  const float z = texelFetch(depth, p, 0).x;
  const vec3 hostNormal = texelFetch(normal, p, 0).xyz;
  if (!isSurfaceDepth(z, frame.skyDepth) || !isUsable(hostNormal) || !hasDiffuseLobe(albedoAt(p))) {
    storeGuides(p, 0u, 0u, 0u);
    return;
  }

  const vec3 ray = rayThrough(frame.rayFromPixel, pixelCentre(p));
  vec3 shadingNormal = hostNormal / length(hostNormal);
  if (kNormalsInWorldSpace) shadingNormal = normalize(mat3(frame.viewFromWorld) * shadingNormal);
  if (dot(shadingNormal, ray) > 0.0) shadingNormal = -shadingNormal;

#ifdef GEOMETRIC_NORMAL
  const uint packedGeometry = packGeometricNormal(geometricNormal(p, 1.0 / z, shadingNormal));
#else
  const uint packedGeometry = 0u;
#endif
#ifdef OCCLUSION
  const float occlusion = ambientOcclusion(p, z, shadingNormal, constants.occlusionRadius, kOcclusionSteps);
  const uint features = packNormalAndOcclusion(NormalAndOcclusion(shadingNormal, occlusion));
#else
  const uint features = packNormal(shadingNormal);
#endif
  storeGuides(p, packDepthSdf(z, 0u), features, packedGeometry);
}
#endif
