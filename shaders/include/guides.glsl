// The guides of a pixel from the host's G-buffer (passes/WALR.md, 1): view depth (0 where there is nothing to denoise),
// the shading normal in octahedral form, and with GEOMETRIC_NORMAL the geometric normal.
// OCCLUSION: the shading normal shares a word with ambient occlusion, and the geometric normal takes 16 bits.
// Everything in the host's depth occludes, even a mirror, which is not denoised itself.
// Needs: `frame` (FrameConstants), `guideConstants` (PrepareGuidesConstants), and with GEOMETRIC_NORMAL work groups of
// 8 x 8 threads.
// Takes constant_id 20 to 23.
#ifndef WALR_GUIDES_GLSL
#define WALR_GUIDES_GLSL
#include "camera.glsl"
#include "finite.glsl"
#include "surface.glsl"

layout(constant_id = 20) const bool kNormalsInWorldSpace = false;
layout(constant_id = 21) const bool kSky = true;  // Some pixels show the sky.
#ifdef OCCLUSION
layout(constant_id = 22) const int kOcclusionRings = 4;
#endif
layout(constant_id = 23) const bool kDiffuseMask = true;  // Treat pixels without a diffuse lobe like sky.

uniform texture2D hostDepth;
uniform texture2D normal;
uniform texture2D albedo;

// Bit pattern of the depth at which surfaces end: that of the sky, or infinity. Patterns of positive numbers have the
// order of the numbers; those of negative numbers and NaN are larger than all of them.
uint surfaceDepthEnd() { return kSky ? uint(max(floatBitsToInt(frame.skyDepth), 1)) : 0x7f800000u; }

// Whether z is positive and less deep than that; one comparison.
bool isSurfaceDepth(float z, uint depthEnd) { return floatBitsToUint(z) - 1u < depthEnd - 1u; }

// A surface to denoise.
struct Surface {
  vec3 ray;      // View ray of the pixel (camera.glsl).
  vec3 normal;   // Shading normal: unit, in view space, towards the camera.
  float facing;  // normal . ray, at most -1e-6: the geometric normal is scaled by it.
  float depth;   // View depth; 0: none.
};
#ifdef GEOMETRIC_NORMAL
#include "geometric_normal.glsl"
#endif
#ifdef OCCLUSION
#include "ambient_occlusion.glsl"
#endif

// Diffuse albedo; 1 if it is not read.
vec3 albedoAt(ivec2 p) { return kDiffuseMask ? texelFetch(albedo, p, 0).xyz : vec3(1.0); }

// Whether the pixel reflects diffuse light.
bool hasDiffuseLobe(vec3 diffuse) {
  const bool bright = max(diffuse.x, max(diffuse.y, diffuse.z)) >= guideConstants.albedoThreshold;
  const bool finite = isFinite(diffuse.x + diffuse.y + diffuse.z);  // Not so if one of them is not.
  return bright && finite;
}

// Whether a normal of this squared length has a direction: positive and finite.
bool isUsable(float lengthSquared) { return floatBitsToUint(lengthSquared) - 1u < 0x7f7fffffu; }

// The surface that a pixel shows at depth z.
Surface surfaceAt(ivec2 p, float z, uint depthEnd) {
  const vec3 ray = rayThrough(frame.rayFromPixel, pixelCentre(p));
  vec3 n = texelFetch(normal, p, 0).xyz;
  const bool diffuse = hasDiffuseLobe(albedoAt(p));
  if (kNormalsInWorldSpace) n = mat3(frame.viewFromWorld) * n;
  const float lengthSquared = dot(n, n);
  const bool usable = isUsable(lengthSquared);
  const bool surface = isSurfaceDepth(z, depthEnd);
  n *= inversesqrt(lengthSquared);
  const float facing = dot(n, ray);
  return Surface(ray, facing > 0.0 ? -n : n, -max(abs(facing), 1e-6), usable && diffuse && surface ? z : 0.0);
}

// The guides of a pixel as textures hold them (surface.glsl). All of them are 0 without a surface.
struct PackedGuides {
  uint depth;            // With OCCLUSION and GEOMETRIC_NORMAL also the geometric normal.
  uint features;         // The shading normal, and with OCCLUSION ambient occlusion.
  uint geometricNormal;  // 0 without GEOMETRIC_NORMAL and with OCCLUSION.
};

// The guides of this thread's pixel. All threads of a work group must call it, even those outside the image: these
// read as if there were sky.
PackedGuides guidesOfPixel() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  const ivec2 q = min(p, textureSize(hostDepth, 0) - 1);
  const float depthThere = texelFetch(hostDepth, q, 0).x;
  const float z = p == q ? depthThere : 0.0;
  const uint depthEnd = surfaceDepthEnd();
  const Surface surface = surfaceAt(q, z, depthEnd);
#ifdef GEOMETRIC_NORMAL
  shareInverseDepths(z, depthEnd);
  barrier();
#endif
  PackedGuides guides = PackedGuides(0u, 0u, 0u);
  if (surface.depth == 0.0) return guides;

#if defined(OCCLUSION) && defined(GEOMETRIC_NORMAL)
  guides.depth = packDepthNormal(surface.depth, packShortNormal(geometricNormalOf(surface)));
#elif defined(OCCLUSION)
  guides.depth = packDepthNormal(surface.depth, 0u);
#else
  guides.depth = packDepthSdf(surface.depth, 0u);
#ifdef GEOMETRIC_NORMAL
  guides.geometricNormal = packNormal(geometricNormalOf(surface));
#endif
#endif
#ifdef OCCLUSION
  const float occlusion = ambientOcclusion(p, surface, depthEnd);
  guides.features = packNormalAndOcclusion(NormalAndOcclusion(surface.normal, occlusion));
#else
  guides.features = packNormal(surface.normal);
#endif
  return guides;
}

#endif
