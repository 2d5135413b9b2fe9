// Counts what looks wrong in a host's values, and takes samples of what must agree with the cameras. lint_inputs.h says
// what they are; the files passes/lint/lint_*.cpp draw the conclusions.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "conventions/frame.h"
#include "lint/lint_inputs.h"
#include "common/finite.glsl"
#include "common/hash.glsl"
#include "lint/albedo_contrast.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std140) uniform frameConstants { FrameConstants frame; };
uniform texture2D lighting;
uniform texture2D depth;
uniform texture2D normal;
uniform texture2D motion;
uniform texture2D albedo;
layout(std430) buffer counters { uint words[]; };
#include "conventions/light_sample.glsl"

const uint kFirstCount = 0u, kCounts = kLintInputWords;
#include "lint/counts.glsl"
#include "lint/surfaces.glsl"

vec3 normalAt(ivec2 p) { return texelFetch(normal, p, 0).xyz; }
vec3 albedoAt(ivec2 p) { return texelFetch(albedo, p, 0).xyz; }
bool isUsable(vec3 n) { return isFinite(n) && isFinite(length(n)) && length(n) > 0.0; }

void countValues(vec3 light, float z) {
  count(kLintPixels, true);
  count(kLintSurfaces, isSurfaceDepth(z));
  count(kLintDepthNotFinite, !isFinite(z) && !isInfinity(z));
  count(kLintDepthNegative, isFinite(z) && z < 0.0);
  count(kLintDepthZero, z == 0.0);
  count(kLintLightingNotFinite, !isFinite(light));
  count(kLintLightingNegative, isFinite(light) && any(lessThan(light, vec3(0.0))));
}

void countSurfaceValues(vec3 n, vec2 xy, vec3 diffuse) {
  // Rounding to eight bits per component changes the length of a unit vector by at most sqrt(3) / 255, a third of this.
  const float kUnitTolerance = 0.02;
  const bool zero = all(equal(n, vec3(0.0)));
  count(kLintNormalNotFinite, !isFinite(n));
  count(kLintNormalZero, zero);
  count(kLintNormalNotUnit, isFinite(n) && !zero && !(abs(length(n) - 1.0) <= kUnitTolerance));
  count(kLintMotionNotFinite, !isFinite(xy));
  count(kLintAlbedoNotFinite, !isFinite(diffuse));
  count(kLintAlbedoOutside,
        isFinite(diffuse) && (any(lessThan(diffuse, vec3(0.0))) || any(greaterThan(diffuse, vec3(1.0)))));
  count(kLintDiffuse, isFinite(diffuse) && any(greaterThanEqual(diffuse, vec3(kAlbedoLeast))));
}

void countPair(ivec2 p, ivec2 q, float z, vec3 n, LightSample here, vec3 diffuse) {
  if (!inside(q)) return;
  const float otherDepth = depthAt(q);
  const vec3 otherNormal = normalAt(q);
  const LightSample there = lightSampleAt(lighting, q);
  const vec3 otherDiffuse = albedoAt(q);
  if (!here.exists || !there.exists) return;
  const vec3 light = here.radiance, otherLight = there.radiance;
  if (!isUsable(n) || !isUsable(otherNormal) || !isFinite(light) || !isFinite(otherLight)) return;
  if (!areOnOneSurface(z, n, otherDepth, otherNormal)) return;
  bool follows;
  const uint contrast = albedoContrast(light, otherLight, diffuse, otherDiffuse, follows);
  count((follows ? kLintFollowsAlbedo : kLintIgnoresAlbedo) + contrast - 1u, contrast > 0u);
}

void countSamples(ivec2 p, LightSample light) {
  count(kLintSamples, light.exists);
  ivec2 texel;
  if (!kLightCounted || !hasLightTexel(p, texel)) return;
  const float samples = texelFetch(lighting, texel, 0).a;
  count(kLintCountInvalid, !(samples >= 0.0 && samples <= kLargestHalf));
}

shared float brightness[64];

// In the brightest channel of a sample on a surface.
float brightnessAt(ivec2 p) {
  const vec3 light = inside(p) && isSurfaceDepth(depthAt(p)) ? lightSampleAt(lighting, p).radiance : vec3(0.0);
  return isFinite(light) ? max(max(light.r, light.g), max(light.b, 0.0)) : 0.0;
}

// All threads of the workgroup must call it.
void countFireflies(ivec2 p) {
  brightness[gl_LocalInvocationIndex] = brightnessAt(p);
  barrier();
  if (gl_LocalInvocationIndex > 0u) return;
  float most = 0.0, others = 0.0;
  uint lit = 0u;
  for (uint i = 0u; i < 64u; ++i) {
    others += min(brightness[i], most);
    most = max(most, brightness[i]);
    lit += brightness[i] > 0.0 ? 1u : 0u;
  }
  count(kLintFireflies, lit > kFireflyNeighbours && most > kFireflyContrast * others);
}

void countPixel(ivec2 p) {
  const LightSample light = lightSampleAt(lighting, p);
  countSamples(p, light);
  const float z = depthAt(p);
  countValues(light.radiance, z);
  if (!isSurfaceDepth(z)) return;
  const vec3 n = normalAt(p);
  const vec3 diffuse = albedoAt(p);
  countSurfaceValues(n, texelFetch(motion, p, 0).xy, diffuse);
  const bool lit = any(notEqual(light.radiance, vec3(0.0)));
  count((lit ? kLintLit : kLintDark) + uint(p.x & 1) + 2u * uint(p.y & 1), true);
  // Textures have edges at several scales.
  for (int distance = 1; distance <= kAlbedoFarthest; distance *= 2) {
    countPair(p, p + ivec2(distance, 0), z, n, light, diffuse);
    countPair(p, p + ivec2(0, distance), z, n, light, diffuse);
  }
}

void writeSample(uint word, ivec2 p) {
  words[word + kSamplePixel] = uint(p.x) | uint(p.y) << 16;
  words[word + kSampleDepth] = floatBitsToUint(depthAt(p));
  const ivec2 around[4] = ivec2[](ivec2(-1, 0), ivec2(1, 0), ivec2(0, -1), ivec2(0, 1));
  for (uint i = 0u; i < 4u; ++i) {
    const ivec2 q = p + around[i];
    words[word + kSampleAround + i] = floatBitsToUint(all(greaterThanEqual(q, ivec2(0))) && inside(q) ? depthAt(q) : 0.0);
  }
  const vec3 n = normalAt(p);
  const vec3 given = texelFetch(motion, p, 0).xyz;
  for (uint c = 0u; c < 3u; ++c) {
    words[word + kSampleNormal + c] = floatBitsToUint(n[c]);
    words[word + kSampleMotion + c] = floatBitsToUint(given[c]);
  }
}

void samplePixel(ivec2 p) {
  const ivec2 size = textureSize(depth, 0);
  const ivec2 grid = min(ivec2(kLintColumns, kLintRows), size);
  const ivec2 cell = p * grid / size;
  const ivec2 first = (cell * size + grid - 1) / grid;
  const ivec2 end = ((cell + 1) * size + grid - 1) / grid;
  const uint number = uint(cell.y * grid.x + cell.x);
  const uint random = hashOfPixel(uvec2(cell), frame.frameIndex, 0u);
  const ivec2 chosen = first + ivec2(uvec2(random >> 16, random & 0xffffu) % uvec2(end - first));
  if (p == chosen) writeSample(kLintFirstSample + number * kLintSampleWords, p);
}

void main() {
  clearCounts();
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (inside(p)) {
    countPixel(p);
    samplePixel(p);
  }
  countFireflies(p);
  addCounts();
}
