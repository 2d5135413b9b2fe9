// Reprojection: where a surface was in the previous frame, and which history taps show it.
// Needs: `frame` (FrameConstants), `depth`, `geometricNormal`, `motion`, the usampler2D `previousDepth` and
// `previousGeometricNormal`, and the macro HISTORY, the name of a texture of the previous frame's size.
// OBJECTS: also tests object ids; needs `objects` and `previousObjects`, a usampler2D.
// GUIDES: `ownGuides` (guides.glsl) are the guides of this thread's pixel, in place of `depth` and `geometricNormal`;
// without kDilateMotion.
// HOST_SURFACES: the includer defines `depthAt`, for this thread's pixel and the eight around it, and `pictureSize`;
// `depth` is not read.
// LIGHT_GRID_TAPS: also tests the history taps of accumulated light on the light grid (light_sample.glsl).
// KEEP_TAPS: motion is rounded to what kept taps can hold (history_taps.glsl); with VIEW, kKeepableMotion says whether
// it is.
// A texture is not read if no specialization constant asks for it: `motion` with kMotionFromCamera (nothing but the
// camera moves), the others without the test that reads them (kRejectByPlane, kRejectByDepth, kRejectByObject). Without
// any test, every pixel inside the image is accepted.
// Takes constant_id 0, 1 and 10 to 17.
#ifndef WALR_REPROJECTION_GLSL
#define WALR_REPROJECTION_GLSL
#include "conventions/camera.glsl"
#include "common/finite.glsl"
#include "temporal/history_taps.glsl"
#include "conventions/surface.glsl"

layout(constant_id = 0) const bool kMotionDepthGiven = true;
layout(constant_id = 17) const bool kMotionDepthFound = false;  // Instead, by the taps (nearestTap).
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

// kNormalBesideDepth: a texel of depth also holds the geometric normal (surface.glsl).
#ifdef GUIDES
const bool kNormalBesideDepth = true;
PackedGuides ownGuides;
uint packedDepthAt(ivec2 p) { return ownGuides.depth; }
uint packedGeometricNormalAt(ivec2 p) { return ownGuides.depth; }
uvec4 gatherNormals(uvec4 packedDepths, vec2 corner) { return packedDepths; }
#else
layout(constant_id = 16) const bool kNormalBesideDepth = false;
uint packedDepthAt(ivec2 p) { return texelFetch(depth, p, 0).x; }
uint packedGeometricNormalAt(ivec2 p) {
  return kNormalBesideDepth ? packedDepthAt(p) : texelFetch(geometricNormal, p, 0).x;
}
// Those of the taps whose depths are given.
uvec4 gatherNormals(uvec4 packedDepths, vec2 corner) {
  return kNormalBesideDepth ? packedDepths : gatherTaps(previousGeometricNormal, corner);
}
#endif
#ifdef HOST_SURFACES
ivec2 pictureSize();
float depthAt(ivec2 p);
#else
float depthAt(ivec2 p) {
  const uint packed = packedDepthAt(p);
  return kNormalBesideDepth ? unpackDepthBesideNormal(packed) : unpackDepth(packed);
}
#ifndef GUIDES
ivec2 pictureSize() { return textureSize(depth, 0); }
#endif
#endif

struct Reprojection {
  vec2 motion;  // To the previous frame, pixels of this one.
  float depth;  // Of the surface in the previous frame; with kMotionDepthFound, if it did not move.
#ifdef OBJECTS
  uint object;  // Object id of the surface plus 1; 0: none. Only with kRejectByObject.
#endif
  bool valid;  // Whether `depth` is finite and above 0.
};

#ifdef GUIDES
ivec2 pixelToFollow(ivec2 p, float z) { return p; }
#else
layout(constant_id = 1) const bool kDilateMotion = false;  // Follow the nearest surface of the 3x3 neighbourhood.

// The pixel of the 3 x 3 neighbourhood that is nearest to the camera. Along silhouettes it is one of the occluder,
// whose motion the history follows.
ivec2 nearestPixel(ivec2 p, float z) {
  ivec2 nearest = p;
  for (int i = 0; i < 9; ++i) {
    const ivec2 q = clamp(p + ivec2(i % 3, i / 3) - 1, ivec2(0), pictureSize() - 1);
    const float candidate = depthAt(q);
    if (candidate > 0.0 && candidate < z) {
      z = candidate;
      nearest = q;
    }
  }
  return nearest;
}

ivec2 pixelToFollow(ivec2 p, float z) { return kDilateMotion ? nearestPixel(p, z) : p; }
#endif

// Position of pixel `p` at depth `z` in the view space of the previous camera, if its surface did not move.
vec3 previousPositionAt(ivec2 p, float z) {
  return previousPosition(frame.previousViewFromView, rayThrough(frame.rayFromPixel, pixelCentre(p)) * z);
}

vec2 motionAt(ivec2 p) {
  if (!kMotionFromCamera) return texelFetch(motion, p, 0).xy * frame.motionScale;
  const vec3 before = previousPositionAt(p, depthAt(p));
  return pixelOf(frame.previousRayFromPixel, before) - pixelCentre(p);
}
float previousDepthOf(ivec2 p, float z) {
  if (!kMotionFromCamera && kMotionDepthGiven) return z + texelFetch(motion, p, 0).z;
  return -previousPositionAt(p, z).z;
}

// `followed`: the pixel whose motion the history of `p` follows.
Reprojection reprojectWith(ivec2 p, float z, ivec2 followed) {
  Reprojection r;
  vec2 exact = motionAt(followed);
  if (kJitter) exact -= frame.jitterDelta;
  // Motion that is not finite leads outside any image, and none leads further.
  r.motion = isFinite(exact) ? exact : vec2(kLargestHalf);
  r.motion = kKeepableMotion ? keepableMotion(r.motion) : clamp(r.motion, vec2(-kLargestHalf), vec2(kLargestHalf));
  r.depth = previousDepthOf(p, z);
#ifdef OBJECTS
  r.object = kRejectByObject ? texelFetch(objects, p, 0).x : 0u;
#endif
  r.valid = isFinite(r.depth) && r.depth > 0.0;
  return r;
}

Reprojection reproject(ivec2 p, float z) { return reprojectWith(p, z, pixelToFollow(p, z)); }

// The geometric normal of pixel `p` in the previous view space.
vec3 previousNormalAt(ivec2 p) {
  const uint packed = packedGeometricNormalAt(p);
  const vec3 normal = kNormalBesideDepth ? unpackShortNormal(packed) : unpackLongNormal(packed);
  return mat3(frame.previousViewFromView) * normal;
}

bvec4 both(bvec4 a, bvec4 b) { return mix(bvec4(false), a, b); }

// If depth is found, a surface may change its depth from one frame to the next by this share of it, besides the change
// that the camera makes (integration/docs/images.md, "Motion without depth").
const float kMostDepthChange = 0.1;
const float kNoTap = 3.4e38;

// The value of the candidate that is nearest to that of a still surface, kNoTap if none is near enough. Values are
// depths or, all of one direction, proportional to depths.
float nearestTap(vec4 values, bvec4 candidates, float still, float tolerance) {
  float most = max(kMostDepthChange * abs(still), tolerance);
  float nearest = kNoTap;
  for (int i = 0; i < 4; ++i) {
    const float distance = abs(values[i] - still);
    if (!candidates[i] || distance > most) continue;
    nearest = values[i];
    most = distance;
  }
  return nearest;
}

// Which taps, of the given depths, are within `tolerance` x depth of the surface. If depth is found, it is that of a
// candidate.
bvec4 tapsNear(Reprojection r, bvec4 candidates, vec4 depths, float tolerance) {
  tolerance *= r.depth;
  const float surface = kMotionDepthFound ? nearestTap(depths, candidates, r.depth, tolerance) : r.depth;
  return lessThanEqual(abs(depths - surface), vec4(tolerance));
}

// Where history taps lie: texel t is pixel t * spacing + first of the previous frame.
struct TapGrid {
  ivec2 spacing;
  ivec2 first;
};
const TapGrid kEveryPixel = TapGrid(ivec2(1), ivec2(0));

// Which taps, of the given depths, are within `tolerance` x depth of the surface's plane. The product of its normal and
// the view ray is linear over the image: it is computed at the first tap, and the others follow by its slope.
// If depth is found, it is that of a candidate.
bvec4 tapsOnPlane(TapGrid grid, HistoryTaps taps, Reprojection r, bvec4 candidates, vec3 normal, vec4 depths,
                  float tolerance) {
  const vec2 firstPixel = (vec2(taps.base * grid.spacing + grid.first) + 0.5) * frame.pixelFromPreviousPixel;
  const float first = dot(normal, rayThrough(frame.previousRayFromPixel, firstPixel));
  const vec2 perPixel = normal.xy * frame.previousRayFromPixel.xy;  // Pixels of this frame.
  const vec2 slope = perPixel * frame.pixelFromPreviousPixel * vec2(grid.spacing);
  const vec4 products = first + vec4(0.0, slope.x, slope.y, slope.x + slope.y);
  tolerance *= r.depth;
  // The taps surround the reprojected pixel centre. Depths belong to the samples, which jitter moves away from centres.
  float surface = r.depth * (first + dot(slope, taps.fraction) + dot(perPixel, frame.jitterDelta));
  if (kMotionDepthFound) surface = nearestTap(depths * products, candidates, surface, tolerance);
  return lessThanEqual(abs(depths * products - surface), vec4(tolerance));
}

// Which taps, of the given packed geometric normals, have at least the cosine `threshold` with `normal`.
bvec4 tapsFacing(uvec4 packed, vec3 normal, float threshold) {
  vec4 excess;  // At least 0 where the cosine is at least the threshold.
  for (int i = 0; i < 4; ++i) {
    if (kNormalBesideDepth) {
      // (cosine - threshold) (1 + e . e), e being the point of the projection.
      const vec2 e = shortNormalPoint(packed[i]);
      const vec2 factors = 2.0 * normal.xy - (normal.z + threshold) * e;
      excess[i] = dot(e, factors) + (normal.z - threshold);
    } else {
      const vec3 direction = longNormalDirection(packed[i]);
      excess[i] = dot(normal, direction) * inversesqrt(dot(direction, direction)) - threshold;
    }
  }
  return greaterThanEqual(excess, vec4(0.0));
}

// The history taps of pixel `p`, accepted where they show the reprojected surface. kRejectByPlane: they are within
// `tolerance` x depth of the surface's plane, and the cosine of their geometric normals with its own is at least
// `normalThreshold`. kRejectByDepth: their depths are within `tolerance` x depth. kRejectByObject: they show the same
// object.
HistoryTaps historyTaps(ivec2 p, Reprojection r, float tolerance, float normalThreshold) {
  HistoryTaps taps = tapsAround(p, r.motion, frame.previousPixelFromPixel);
#ifdef LIGHT_GRID_TAPS
  const ivec2 size = kLightGrid ? textureSize(previousDepth, 0) : textureSize(HISTORY, 0);
#else
  const ivec2 size = textureSize(HISTORY, 0);
#endif
  const vec2 corner = sharedCorner(taps, frame.previousTexel);
  bvec4 accepted = both(tapsInside(taps, size), bvec4(r.valid));
#ifdef OBJECTS
  if (kRejectByObject) {
    const bvec4 same = equal(gatherTaps(previousObjects, corner), uvec4(r.object));
    accepted = both(accepted, both(same, bvec4(r.object != 0u)));
  }
#endif
  if (kRejectByPlane || kRejectByDepth) {
    const uvec4 packedDepths = gatherTaps(previousDepth, corner);
    const vec4 depths = kNormalBesideDepth ? unpackDepthBesideNormal(packedDepths) : unpackDepth(packedDepths);
    accepted = both(accepted, greaterThan(depths, vec4(0.0)));
    if (kRejectByDepth) {
      accepted = both(accepted, tapsNear(r, accepted, depths, tolerance));
    } else {
      const vec3 normal = previousNormalAt(p);
      // Depth is found among the taps that face the surface. Without that, this order takes fewer registers.
      if (!kMotionDepthFound)
        accepted = both(accepted, tapsOnPlane(kEveryPixel, taps, r, accepted, normal, depths, tolerance));
      accepted = both(accepted, tapsFacing(gatherNormals(packedDepths, corner), normal, normalThreshold));
      if (kMotionDepthFound)
        accepted = both(accepted, tapsOnPlane(kEveryPixel, taps, r, accepted, normal, depths, tolerance));
    }
  }
  taps.accepted = accepted;
  return taps;
}

#ifdef LIGHT_GRID_TAPS
// The history taps among the pixels that the light grid of the previous frame shows, around `position` in pixels from
// the centre of the first. They are accepted by plane and normal, as above; normals must lie beside depths.
HistoryTaps lightGridTaps(ivec2 p, Reprojection r, vec2 position, float tolerance, float normalThreshold) {
  const TapGrid grid = TapGrid(lightGroup(), frame.previousLightOffset);
  const vec2 texel = (position - vec2(grid.first)) / vec2(grid.spacing), base = floor(texel);
  HistoryTaps taps = HistoryTaps(ivec2(base), texel - base, bvec4(false));
  const ivec2 size = textureSize(previousDepth, 0);
  uvec4 packed;
  bvec4 accepted;
  for (int i = 0; i < 4; ++i) {
    const ivec2 q = historyTap(taps, i) * grid.spacing + grid.first;
    accepted[i] = r.valid && all(lessThan(uvec2(q), uvec2(size)));
    packed[i] = texelFetch(previousDepth, clamp(q, ivec2(0), size - 1), 0).x;
  }
  const vec4 depths = unpackDepthBesideNormal(packed);
  const vec3 normal = previousNormalAt(p);
  accepted = both(accepted, greaterThan(depths, vec4(0.0)));
  accepted = both(accepted, tapsFacing(packed, normal, normalThreshold));
  taps.accepted = both(accepted, tapsOnPlane(grid, taps, r, accepted, normal, depths, tolerance));
  return taps;
}
#endif

#endif
