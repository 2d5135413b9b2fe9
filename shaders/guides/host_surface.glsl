// The surface that a pixel shows, from the host's G-buffer (passes/WALR.md, 1): its view depth, 0 where there is nothing
// to denoise, and its shading normal.
// Needs: `frame` (FrameConstants), `guideConstants` (PrepareGuidesConstants).
// Takes constant_id 20, 21 and 23.
#ifndef WALR_HOST_SURFACE_GLSL
#define WALR_HOST_SURFACE_GLSL
#include "conventions/camera.glsl"
#include "common/finite.glsl"
#include "conventions/surface.glsl"

layout(constant_id = 20) const bool kNormalsInWorldSpace = false;
layout(constant_id = 21) const bool kSky = true;  // Some pixels show the sky.
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

#endif
