// Where a surface was in the previous frame, and whether a history pixel shows it.
// Needs: `frame` (FrameConstants), `motion`, `previousDepth`, `previousNormals`.
#ifndef WALR_REPROJECTION_GLSL
#define WALR_REPROJECTION_GLSL
#include "camera.glsl"
#include "finite.glsl"
#include "surface.glsl"

layout(constant_id = 0) const bool kMotionDepthGiven = true;

struct Reprojection {
  vec2 pixel;      // Position in the previous frame, pixels.
  vec3 position;   // The surface in the previous frame's view space.
  vec3 normal;     // Its geometric normal there.
  bool valid;
};

// `p` is the pixel whose motion is followed, `depth` its view depth, `normal` its geometric normal.
Reprojection reproject(ivec2 p, float depth, vec3 normal) {
  Reprojection r;
  const vec3 motionHere = texelFetch(motion, p, 0).xyz;
  r.pixel = pixelCentre(p) + motionHere.xy * frame.motionScale - frame.jitterDelta;
  float previousDepthHere = depth + motionHere.z;
  if (!kMotionDepthGiven) {
    const vec3 position = rayThrough(frame.rayFromPixel, pixelCentre(p)) * depth;
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
  const vec3 normal = unpackGeometricNormal(texelFetch(previousNormals, q, 0).xy);
  return abs(dot(r.normal, position - r.position)) <= planeTolerance * -r.position.z &&
         dot(r.normal, normal) >= normalThreshold;
}

// The four history pixels around the reprojected position, each tested on its own.
struct HistoryTaps {
  ivec2 base;       // The upper left one.
  vec2 fraction;    // Position past its centre, in [0, 1).
  vec4 weights;     // Bilinear weights of those that show the surface, with sum 1; in the order of `historyTap`.
  bool any, all;    // Whether one, and whether every one, of the four shows it.
};

ivec2 historyTap(HistoryTaps taps, int i) { return taps.base + ivec2(i & 1, i >> 1); }

HistoryTaps historyTaps(Reprojection r, float planeTolerance, float normalThreshold) {
  HistoryTaps taps = HistoryTaps(ivec2(0), vec2(0.0), vec4(0.0), false, false);
  if (!r.valid) return taps;
  taps.base = ivec2(floor(r.pixel - 0.5));
  taps.fraction = r.pixel - 0.5 - vec2(taps.base);
  const vec2 f = taps.fraction, g = 1.0 - taps.fraction;
  const vec4 bilinear = vec4(g.x * g.y, f.x * g.y, g.x * f.y, f.x * f.y);
  int matching = 0;
  for (int i = 0; i < 4; ++i) {
    if (!historyMatches(r, historyTap(taps, i), planeTolerance, normalThreshold)) continue;
    taps.weights[i] = bilinear[i];
    ++matching;
  }
  const float sum = dot(taps.weights, vec4(1.0));
  // Below a hundredth of a pixel the remaining taps say next to nothing about this position.
  taps.any = sum > 0.01;
  taps.all = matching == 4;
  taps.weights = taps.any ? taps.weights / sum : vec4(0.0);
  return taps;
}

#endif
