// Joint bilateral filter of one noisy frame (Wang 2024, 2): the mean over a square window, weighted by Gaussians of the
// distance in the image, the difference in colour, the angle between normals and the angle to the tangent plane.
// VIEW: does the same work and writes one of its intermediate values instead of the result.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "conventions/frame.h"
#include "filters/joint_bilateral.h"
#include "conventions/camera.glsl"
#include "common/finite.glsl"
#include "common/luminance.glsl"
#include "stage/pass_through.glsl"
#include "conventions/surface.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const int kRadius = 16;  // Pixels on each side of the centre.

layout(std140) uniform frameConstants { FrameConstants frame; };
uniform utexture2D depth;
uniform utexture2D shadingNormal;
uniform utexture2D geometricNormal;
uniform texture2D lighting;
#ifdef VIEW
layout(rgba32f) uniform writeonly image2D outView;
#else
layout(rgba16f) uniform writeonly image2D outFiltered;
#endif
layout(push_constant) uniform PushConstants {
  JointBilateralConstants constants;
#ifdef VIEW
  uint view;  // Which quantity; numbered in viewOf.
#endif
};

struct Surface {
  vec3 position;         // View space.
  vec3 normal;           // Shading normal.
  vec3 geometricNormal;
  vec3 radiance;
  bool valid;            // A surface to denoise, with a finite sample of its light.
};

vec3 positionAt(ivec2 p, float z) { return rayThrough(frame.rayFromPixel, pixelCentre(p)) * z; }

Surface surfaceAt(ivec2 q) {
  Surface s = Surface(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), false);
  // All fetches come before the first test, so that they overlap.
  const float z = unpackDepth(texelFetch(depth, q, 0).x);
  const vec3 radiance = texelFetch(lighting, q, 0).rgb;
  const uint shading = texelFetch(shadingNormal, q, 0).x;
  const uint geometric = texelFetch(geometricNormal, q, 0).x;
  if (z == 0.0) return s;
  s.valid = isFinite(radiance);
  s.position = positionAt(q, z);
  s.normal = unpackLongNormal(shading);
  s.geometricNormal = unpackLongNormal(geometric);
  if (s.valid) s.radiance = clampedRadiance(radiance);
  return s;
}

// Angle between unit vectors, from their chord: the arc cosine loses all precision at small angles.
float angleBetween(vec3 a, vec3 b) { return 2.0 * asin(min(0.5 * length(a - b), 1.0)); }

// Sine of the angle between the plane of `centre` and the vector to `position`; 0 for the centre itself.
float planeSine(Surface centre, vec3 position) {
  const vec3 way = position - centre.position;
  const float distance = length(way);
  return distance > 0.0 ? dot(centre.geometricNormal, way) / distance : 0.0;
}

// Mean luminance of 9 x 9 pixels spread over the window: the unit of colour differences, so that their sigma does not
// depend on exposure.
float windowLuminance(ivec2 p) {
  const ivec2 last = textureSize(depth, 0) - 1;
  float sum = 0.0, count = 0.0;
  for (int i = 0; i < 81; ++i) {
    const ivec2 q = p + (ivec2(i % 9, i / 9) - 4) * kRadius / 4;
    if (any(lessThan(q, ivec2(0))) || any(greaterThan(q, last))) continue;
    const Surface s = surfaceAt(q);
    if (!s.valid) continue;
    sum += luminance(s.radiance);
    count += 1.0;
  }
  return count > 0.0 ? sum / count : 0.0;
}

struct Filtered {
  vec3 sum;         // Of weighted colours.
  float weightSum;
};

Filtered filterAround(ivec2 p, Surface centre) {
  // Without samples and in the dark all colours are alike: the smallest unit keeps the quotient finite.
  const float unit = constants.colour > 0.0 ? max(windowLuminance(p), 1e-6) : 1.0;
  const float colourFalloff = centre.valid ? constants.colour / (unit * unit) : 0.0;
  const ivec2 begin = max(p - kRadius, ivec2(0)), end = min(p + kRadius, textureSize(depth, 0) - 1);
  Filtered result = Filtered(vec3(0.0), 0.0);
  for (int y = begin.y; y <= end.y; ++y) {
    for (int x = begin.x; x <= end.x; ++x) {
      const Surface s = surfaceAt(ivec2(x, y));
      if (!s.valid) continue;
      const vec2 offset = vec2(x, y) - vec2(p);
      const float angle = angleBetween(centre.normal, s.normal);
      const float sine = planeSine(centre, s.position);
      const vec3 difference = s.radiance - centre.radiance;
      const float exponent = dot(offset, offset) * constants.position + dot(difference, difference) * colourFalloff +
                             angle * angle * constants.normal + sine * sine * constants.plane;
      const float weight = exp(-exponent);
      result.sum += weight * s.radiance;
      result.weightSum += weight;
    }
  }
  return result;
}

#ifdef VIEW
vec3 viewOf(ivec2 p) {
  if (unpackDepth(texelFetch(depth, p, 0).x) == 0.0) return vec3(0.0);
  const Surface centre = surfaceAt(p);
  const float weightSum = filterAround(p, centre).weightSum;
  return vec3(weightSum, !centre.valid, weightSum <= 0.0);
}
#endif

void main() {
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, textureSize(depth, 0)))) return;
#ifdef VIEW
  imageStore(outView, p, vec4(view == 0u ? viewOf(p) : vec3(0.0), 1.0));
#else
  if (unpackDepth(texelFetch(depth, p, 0).x) == 0.0) {
    imageStore(outFiltered, p, vec4(passThroughLight(lighting, p), 1.0));
    return;
  }
  const Filtered filtered = filterAround(p, surfaceAt(p));
  // Alpha below 0: the window has no sample, so there is no light.
  const bool known = filtered.weightSum > 0.0;
  imageStore(outFiltered, p, known ? vec4(filtered.sum / filtered.weightSum, 1.0) : vec4(vec3(0.0), -1.0));
#endif
}
