// Where a surface was in the previous frame, and whether a history pixel shows it.
// Needs: `frame` (FrameConstants), `motion`, `depth`, `previousDepth`, `previousGeometricNormal`. Takes constant_id 0 and 1.
#ifndef WALR_REPROJECTION_GLSL
#define WALR_REPROJECTION_GLSL
#include "camera.glsl"
#include "finite.glsl"
#include "history_taps.glsl"
#include "surface.glsl"

layout(constant_id = 0) const bool kMotionDepthGiven = true;
layout(constant_id = 1) const bool kDilateMotion = false;  // Follow the nearest surface of the 3x3 neighbourhood.

struct Reprojection {
  vec2 pixel;      // Position in the previous frame, pixels.
  vec3 position;   // The surface in the previous frame's view space.
  vec3 normal;     // Its geometric normal there.
  bool valid;
};

// The pixel of the 3x3 neighbourhood that is nearest to the camera: along silhouettes it carries the occluder's motion.
ivec2 nearestPixel(ivec2 p, float z) {
  ivec2 nearest = p;
  for (int i = 0; i < 9; ++i) {
    const ivec2 q = clamp(p + ivec2(i % 3, i / 3) - 1, ivec2(0), textureSize(depth, 0) - 1);
    const float candidate = unpackDepth(texelFetch(depth, q, 0).x);
    if (candidate > 0.0 && candidate < z) {
      z = candidate;
      nearest = q;
    }
  }
  return nearest;
}

// `z` is the view depth of pixel `p`, `normal` its geometric normal.
Reprojection reproject(ivec2 p, float z, vec3 normal) {
  Reprojection r;
  const vec2 shift = texelFetch(motion, kDilateMotion ? nearestPixel(p, z) : p, 0).xy * frame.motionScale;
  r.pixel = pixelCentre(p) + shift - frame.jitterDelta;
  float previousDepthHere = z + texelFetch(motion, p, 0).z;
  if (!kMotionDepthGiven) {
    const vec3 position = rayThrough(frame.rayFromPixel, pixelCentre(p)) * z;
    previousDepthHere = -(frame.previousViewFromView * vec4(position, 1.0)).z;
  }
  r.position = rayThrough(frame.previousRayFromPixel, r.pixel) * previousDepthHere;
  r.normal = mat3(frame.previousViewFromView) * normal;
  const vec2 size = vec2(textureSize(previousDepth, 0));
  r.valid = isFinite(r.pixel) && all(greaterThan(r.pixel, vec2(-1.0))) && all(lessThan(r.pixel, size + 1.0)) &&
            isFinite(previousDepthHere) && previousDepthHere > 0.0;
  return r;
}

// True where the history pixel `q` lies on the reprojected surface: within a plane distance relative to depth, with a
// geometric normal that agrees.
bool historyMatches(Reprojection r, ivec2 q, float planeTolerance, float normalThreshold) {
  if (any(lessThan(q, ivec2(0))) || any(greaterThanEqual(q, textureSize(previousDepth, 0)))) return false;
  const float depth = unpackDepth(texelFetch(previousDepth, q, 0).x);
  if (depth == 0.0) return false;
  const vec3 position = rayThrough(frame.previousRayFromPixel, pixelCentre(q)) * depth;
  const vec3 normal = unpackNormal(texelFetch(previousGeometricNormal, q, 0).x);
  return abs(dot(r.normal, position - r.position)) <= planeTolerance * -r.position.z &&
         dot(r.normal, normal) >= normalThreshold;
}

HistoryTaps historyTaps(Reprojection r, float planeTolerance, float normalThreshold) {
  if (!r.valid) return acceptTaps(ivec2(0), vec2(0.0), 0u);
  const ivec2 base = ivec2(floor(r.pixel - 0.5));
  uint accepted = 0u;
  for (int i = 0; i < 4; ++i)
    if (historyMatches(r, base + tapOffset(i), planeTolerance, normalThreshold)) accepted |= 1u << i;
  return acceptTaps(base, r.pixel - 0.5 - vec2(base), accepted);
}

#endif
