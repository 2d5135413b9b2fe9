// Counts what looks wrong in a host's inputs, and which other convention would explain it. lint_inputs.h says what
// is counted; the files passes/lint/lint_*.cpp draw the conclusions.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "conventions/frame.h"
#include "lint/lint_inputs.h"
#include "conventions/camera.glsl"
#include "common/finite.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool kNormalsInWorldSpace = false;
layout(constant_id = 1) const bool kMotionDepthGiven = true;
layout(constant_id = 2) const bool kMotionJittered = true;

layout(std140) uniform frameConstants { FrameConstants frame; };
uniform texture2D lighting;
uniform texture2D depth;
uniform texture2D normal;
uniform texture2D motion;
uniform texture2D albedo;
layout(std430) buffer counters { uint words[]; };
#include "conventions/light_sample.glsl"

shared uint partial[kLintWords];

void count(uint word, bool condition) {
  if (condition) atomicAdd(partial[word], 1u);
}

bool inside(ivec2 p) { return all(lessThan(p, textureSize(depth, 0))); }
bool isSurfaceDepth(float z) { return isFinite(z) && z > 0.0 && z < frame.skyDepth; }
bool isInfinity(float z) { return floatBitsToUint(z) == 0x7f800000u; }

float depthAt(ivec2 p) { return texelFetch(depth, p, 0).x; }
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

// Whether `given` is `scale` times `expected`, within a quarter.
bool isTimes(float given, float scale, float expected) {
  return abs(given - scale * expected) < 0.25 * abs(scale * expected);
}

void countReading(uint base, float given, float expected, float size) {
  count(base + kReadingTested, true);
  uint reading = kReadings;
  const float scales[4] = float[](1.0, 1.0 / size, 2.0 / size, size);
  for (uint i = 0u; i < 4u; ++i) {
    if (isTimes(given, scales[i], expected)) reading = kReadingAsStated + 2u * i;
    if (isTimes(given, -scales[i], expected)) reading = kReadingAsStated + 2u * i + 1u;
  }
  // Smaller than under any of these readings.
  if (abs(given) * size < 0.25 * abs(expected)) reading = kReadingNone;
  count(base + reading, reading < kReadings);
}

// `given`: the host's motion by its stated convention, in pixels, y down.
void countMotion(ivec2 p, float z, vec2 given, float givenDepth) {
  const vec3 before = previousPosition(frame.previousViewFromView, rayThrough(frame.rayFromPixel, pixelCentre(p)) * z);
  if (!(before.z < 0.0) || !isFinite(given)) return;
  // Motion between the jittered images, because both rays are jittered.
  const vec2 betweenImages = pixelOf(frame.previousRayFromPixel, before) - pixelCentre(p);
  const vec2 still = betweenImages - frame.jitterDelta;
  const vec2 expected = kMotionJittered ? betweenImages : still;
  const vec2 residual = given - expected;
  const float jitter = length(frame.jitterDelta);

  const float kLeastMotion = 0.25;  // Pixels. A quarter of it exceeds rounding and a sample's offset in its pixel.
  if (abs(still.x) > kLeastMotion + 4.0 * jitter)
    countReading(kLintMotionX, given.x, expected.x, float(textureSize(depth, 0).x));
  if (abs(still.y) > kLeastMotion + 4.0 * jitter)
    countReading(kLintMotionY, given.y, expected.y, float(textureSize(depth, 0).y));
  if (length(still) < 0.05) {
    count(kLintStillTested, true);
    count(kLintStillMoves, length(residual) > 0.5 + 2.0 * jitter);
    const float kMostJitter = 1.5;  // Pixels: jitter within a pixel differs by at most sqrt(2) from frame to frame.
    const float kRounding = 0.01;   // Pixels: motion below two pixels is off by a thousandth as a half.
    const vec2 inTheMiddle = texelFetch(motion, textureSize(depth, 0) / 2, 0).xy * frame.motionScale;
    count(kLintStillMovesAlike, length(residual) > 0.5 + 2.0 * jitter &&
                                    length(residual) < kMostJitter + 2.0 * jitter &&
                                    length(given - inTheMiddle) < kRounding);
  }
  if (jitter > 0.125) {
    const vec2 included = kMotionJittered ? -frame.jitterDelta : frame.jitterDelta;
    const vec2 opposite = kMotionJittered ? -2.0 * frame.jitterDelta : -frame.jitterDelta;
    count(kLintJitterTested, true);
    count(kLintJitterAsStated, length(residual) < 0.25 * jitter);
    count(kLintJitterOther, length(residual - included) < 0.25 * jitter);
    count(kLintJitterOpposite, length(residual - opposite) < 0.25 * jitter);
  }
  const float away = -before.z - z;
  if (kMotionDepthGiven && abs(away) > 0.005 * z) {
    count(kLintMotionZ + kReadingTested, true);
    count(kLintMotionZ + kReadingAsStated, isTimes(givenDepth, 1.0, away));
    count(kLintMotionZ + kReadingOpposite, isTimes(givenDepth, -1.0, away));
    count(kLintMotionZ + kReadingNone, abs(givenDepth) < 0.05 * abs(away));
  }
}

// View depth from what the host wrote, under a hypothesis, up to a constant factor that does not change slopes.
float assumedDepth(uint hypothesis, float z, vec3 ray) {
  switch (hypothesis) {
    case kHypothesisInverseDepth: return 1.0 / z;
    case kHypothesisDeviceDepth: return 1.0 / max(1.0 - z, 1e-7);
    case kHypothesisDistance: return z / length(ray);
  }
  return z;
}

vec3 assumedPosition(uint hypothesis, ivec2 p) {
  const vec3 ray = rayThrough(frame.rayFromPixel, pixelCentre(p));
  return ray * assumedDepth(hypothesis, depthAt(p), ray);
}

// Normal of the surface that depth shows, under a hypothesis.
vec3 slopeNormal(uint hypothesis, ivec2 p) {
  return normalize(cross(assumedPosition(hypothesis, p + ivec2(0, 1)) - assumedPosition(hypothesis, p - ivec2(0, 1)),
                         assumedPosition(hypothesis, p + ivec2(1, 0)) - assumedPosition(hypothesis, p - ivec2(1, 0))));
}

bool isSmoothAlong(ivec2 p, ivec2 axis, float z) {
  const float left = depthAt(p - axis), right = depthAt(p + axis);
  return isSurfaceDepth(left) && isSurfaceDepth(right) &&
         abs(left + right - 2.0 * z) < 0.1 * abs(right - left) + 1e-3 * z;
}

vec3 inViewSpace(vec3 n, bool world) { return normalize(world ? mat3(frame.viewFromWorld) * n : n); }

void countNormals(ivec2 p, float z, vec3 n) {
  if (any(lessThan(p, ivec2(1))) || !inside(p + 1)) return;
  if (!isUsable(n) || !isSmoothAlong(p, ivec2(1, 0), z) || !isSmoothAlong(p, ivec2(0, 1), z)) return;
  const vec3 stated = inViewSpace(n, kNormalsInWorldSpace);
  const float fit = abs(dot(stated, slopeNormal(kHypothesisOtherSpace, p)));
  if (!isFinite(fit)) return;
  count(kLintNormalTested, true);
  count(kLintNormalFits, fit > kFittingCosine);
  for (uint h = 0u; h < kHypothesisCount; ++h) {
    vec3 assumed = stated;
    if (h == kHypothesisOtherSpace) assumed = inViewSpace(n, !kNormalsInWorldSpace);
    if (h == kHypothesisFlippedY) assumed = inViewSpace(n * vec3(1.0, -1.0, 1.0), kNormalsInWorldSpace);
    if (h == kHypothesisInverseView && kNormalsInWorldSpace) assumed = normalize(n * mat3(frame.viewFromWorld));
    const float otherFit = abs(dot(assumed, slopeNormal(h, p)));
    const float kMargin = 0.02;
    count(kLintHypotheses + 2u * h, otherFit > fit + kMargin);
    count(kLintHypotheses + 2u * h + 1u, fit > otherFit + kMargin);
  }
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
  if (!isSurfaceDepth(otherDepth) || abs(otherDepth - z) > 0.02 * z) return;
  if (dot(n, otherNormal) < 0.99 * length(n) * length(otherNormal)) return;
  // The channel in which their albedo differs most.
  float ofAlbedo = 0.0, ofLight = 0.0;  // Octaves.
  for (int c = 0; c < 3; ++c) {
    if (!(min(diffuse[c], otherDiffuse[c]) >= kAlbedoLeast && min(light[c], otherLight[c]) > 0.0)) continue;
    const float contrast = log2(diffuse[c] / otherDiffuse[c]);
    if (!(abs(contrast) > abs(ofAlbedo))) continue;
    ofAlbedo = contrast;
    ofLight = log2(light[c] / otherLight[c]);
  }
  const float steps = abs(ofAlbedo) / kAlbedoContrastStep;
  if (steps < 1.0) return;
  const uint contrastClass = min(uint(steps), kAlbedoContrasts) - 1u;
  // Light that ignores albedo lies on either side of none at random, light that holds it on either side of albedo's.
  const bool follows = ofLight * sign(ofAlbedo) > 0.5 * abs(ofAlbedo);
  count((follows ? kLintFollowsAlbedo : kLintIgnoresAlbedo) + contrastClass, true);
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
  const vec3 given = texelFetch(motion, p, 0).xyz;
  const vec3 diffuse = albedoAt(p);
  countSurfaceValues(n, given.xy, diffuse);
  // Each component of the translation is off by half a unit in the last place, in this frame and in the previous one.
  const float rounding = length(frame.viewFromWorld[3].xyz) * exp2(-24.0) * 2.0;
  count(kLintRounded, rounding > kMostRounding * z * abs(frame.rayFromPixel.x));
  countMotion(p, z, given.xy * frame.motionScale, given.z);
  countNormals(p, z, n);
  // Textures have edges at several scales.
  for (int distance = 1; distance <= kAlbedoFarthest; distance *= 2) {
    countPair(p, p + ivec2(distance, 0), z, n, light, diffuse);
    countPair(p, p + ivec2(0, distance), z, n, light, diffuse);
  }
}

void main() {
  for (uint i = gl_LocalInvocationIndex; i < kLintWords; i += gl_WorkGroupSize.x * gl_WorkGroupSize.y) partial[i] = 0u;
  barrier();
  const ivec2 p = ivec2(gl_GlobalInvocationID.xy);
  if (inside(p)) countPixel(p);
  countFireflies(p);
  barrier();
  for (uint i = gl_LocalInvocationIndex; i < kLintWords; i += gl_WorkGroupSize.x * gl_WorkGroupSize.y)
    if (partial[i] > 0u) atomicAdd(words[i], partial[i]);
}
