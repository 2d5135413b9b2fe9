// Reprojection: where a surface was in the previous frame, and which history taps show it.
// Needs: `frame` (FrameConstants), `depth`, `motion`, `previousDepth`, `previousGeometricNormal`, and the macro
// HISTORY, the name of a texture of the previous frame's size.
// OBJECTS: also tests object ids; needs `objects` and `previousObjects`.
// KEEP_TAPS: motion is rounded to what kept taps can hold (history_taps.glsl); with VIEW, kKeepableMotion says whether
// it is.
// A texture is not read if no specialization constant asks for it: `motion` with kMotionFromCamera (nothing but the
// camera moves), the others without the test that reads them (kRejectByPlane, kRejectByDepth, kRejectByObject). Without
// any test, every pixel inside the image is accepted.
// Takes constant_id 0, 1 and 10 to 15.
#ifndef WALR_REPROJECTION_GLSL
#define WALR_REPROJECTION_GLSL
#include "camera.glsl"
#include "finite.glsl"
#include "history_taps.glsl"
#include "surface.glsl"

layout(constant_id = 0) const bool kMotionDepthGiven = true;
layout(constant_id = 12) const bool kMotionFromCamera = false;
layout(constant_id = 13) const bool kRejectByPlane = true;
layout(constant_id = 14) const bool kRejectByDepth = false;
#ifdef OBJECTS
layout(constant_id = 15) const bool kRejectByObject = false;
#endif
layout(constant_id = 10) const bool kJitter = true;
#if defined(KEEP_TAPS)
const bool kKeepableMotion = true;
#elif defined(VIEW)
layout(constant_id = 11) const bool kKeepableMotion = false;
#else
const bool kKeepableMotion = false;
#endif
layout(constant_id = 1) const bool kDilateMotion = false;  // Follow the nearest surface of the 3x3 neighbourhood.

struct Reprojection {
  vec2 motion;     // To the previous frame, pixels of this one.
  vec3 position;   // The surface in the previous frame's view space.
#ifdef OBJECTS
  uint object;     // Object id of the surface plus 1; 0: none. Only with kRejectByObject.
#endif
  bool valid;
};

// The pixel of the 3 x 3 neighbourhood that is nearest to the camera. Along silhouettes it is one of the occluder,
// whose motion the history follows.
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

// Position of pixel `p` at depth `z` in the view space of the previous camera, if its surface did not move.
vec3 previousPositionAt(ivec2 p, float z) {
  return previousPosition(frame.previousViewFromView, rayThrough(frame.rayFromPixel, pixelCentre(p)) * z);
}

vec2 motionAt(ivec2 p) {
  if (!kMotionFromCamera) return texelFetch(motion, p, 0).xy * frame.motionScale;
  const vec3 before = previousPositionAt(p, unpackDepth(texelFetch(depth, p, 0).x));
  return pixelOf(frame.previousRayFromPixel, before) - pixelCentre(p);
}
float previousDepthOf(ivec2 p, float z) {
  if (!kMotionFromCamera && kMotionDepthGiven) return z + texelFetch(motion, p, 0).z;
  return -previousPositionAt(p, z).z;
}

Reprojection reproject(ivec2 p, float z) {
  Reprojection r;
  vec2 exact = motionAt(kDilateMotion ? nearestPixel(p, z) : p);
  if (kJitter) exact -= frame.jitterDelta;
  // Motion that is not finite leads outside any image.
  r.motion = isFinite(exact) ? exact : vec2(kLargestHalf);
  if (kKeepableMotion) r.motion = keepableMotion(r.motion);
  const vec2 pixel = pixelCentre(p) + r.motion;
  const float previousDepthHere = previousDepthOf(p, z);
  r.position = rayThrough(frame.previousRayFromPixel, pixel) * previousDepthHere;
#ifdef OBJECTS
  r.object = kRejectByObject ? texelFetch(objects, p, 0).x : 0u;
#endif
  const vec2 size = vec2(textureSize(depth, 0));
  r.valid = all(greaterThan(pixel, vec2(-1.0))) && all(lessThan(pixel, size + 1.0)) && isFinite(previousDepthHere) &&
            previousDepthHere > 0.0;
  return r;
}

// Whether the history pixel `q` shows the reprojected surface. kRejectByPlane: it is within `tolerance` x depth of the
// surface's plane, and its geometric normal agrees. kRejectByDepth: its depth is within `tolerance` x depth.
// kRejectByObject: it shows the same object.
bool historyMatches(Reprojection r, vec3 normal, ivec2 q, float tolerance, float normalThreshold) {
  if (any(lessThan(q, ivec2(0))) || any(greaterThanEqual(q, textureSize(HISTORY, 0)))) return false;
#ifdef OBJECTS
  if (kRejectByObject && (r.object == 0u || texelFetch(previousObjects, q, 0).x != r.object)) return false;
#endif
  if (!kRejectByPlane && !kRejectByDepth) return true;
  const float depthThere = unpackDepth(texelFetch(previousDepth, q, 0).x);
  if (depthThere == 0.0) return false;
  if (kRejectByDepth) return abs(depthThere + r.position.z) <= tolerance * -r.position.z;
  const vec2 pixel = pixelCentre(q) * frame.pixelFromPreviousPixel;
  const vec3 position = rayThrough(frame.previousRayFromPixel, pixel) * depthThere;
  const vec3 normalThere = unpackNormal(texelFetch(previousGeometricNormal, q, 0).x);
  return abs(dot(normal, position - r.position)) <= tolerance * -r.position.z &&
         dot(normal, normalThere) >= normalThreshold;
}

// The history taps of pixel `p`. `normal`: its geometric normal, used only by kRejectByPlane.
HistoryTaps historyTaps(ivec2 p, Reprojection r, vec3 normal, float tolerance, float normalThreshold) {
  HistoryTaps taps = tapsAround(p, r.motion, frame.previousPixelFromPixel);
  if (!r.valid) return taps;
  const vec3 normalBefore = mat3(frame.previousViewFromView) * normal;
  for (int i = 0; i < 4; ++i)
    if (historyMatches(r, normalBefore, historyTap(taps, i), tolerance, normalThreshold)) taps.accepted |= 1u << i;
  return taps;
}

#endif
