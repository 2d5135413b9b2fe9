// Where the light that a surface reflects was in the previous frame (passes/SPECULAR.md): where the previous frame's
// surface reflected the point that is reflected now. A place is judged by how much the reflected ray misses that point,
// and one step of Newton's method on the miss corrects it. The light of rough surfaces moves with the surface.
// Tests history by the plane of the shading normal, by roughness and, of mirrors, by the distance of what is reflected.
// Needs: what reprojection.glsl needs with KEEP_TAPS, `constants` (ReflectionMotionConstants), `lighting` with the
// distance of what is reflected as alpha (0: there is no sample), `roughness`, the usampler2D `previousReflector`, and
// `shadingNormal` or what HOST_SURFACES says. Work groups have 8 x 8 threads, all of which call fillTile.
// HOST_SURFACES: surfaces come from the host's G-buffer (host_surface.glsl, with its needs) in place of guides.
// Takes constant_id 8. Without kSpecularMotion, `specularMotion` is not read: what is reflected counts as still.
// DISTANCES: the reflector of every pixel holds the mean distance of what is reflected, which else only mirrors have.
#ifndef WALR_REFLECTION_MOTION_GLSL
#define WALR_REFLECTION_MOTION_GLSL
#include "conventions/lobe.glsl"
#include "conventions/reflector.glsl"
#include "temporal/confidence.glsl"
#include "temporal/reprojection.glsl"
#ifdef HOST_SURFACES
#include "guides/host_surface.glsl"
#endif

layout(constant_id = 8) const bool kSpecularMotion = false;
uniform texture2D specularMotion;  // World space, scene units: where what is reflected was, minus where it is.

#ifdef DISTANCES
const bool kDistances = true;
#else
const bool kDistances = false;
#endif
const float kLongestNewtonStep = 16.0;    // Pixels of the previous frame.
const float kMostTwist = 0.5;             // Of normals over a step, over the miss.
const float kRoundingOfTwist = 1e-4;      // Of four stored normals, each of which is within 2.2e-5 of its value.
const float kRoughnessTolerance = 0.1;    // Largest difference between surface and history pixel.
const float kFarthestObject = 3000.0;     // Over depth; what is farther is reflected from here.
const float kFollowsUpTo = 0.25;          // Roughness up to which things that move carry their images along.
const float kDistanceTolerance = 1.25;    // Largest ratio of two distances of one thing.
const float kNoHistory = 4.0;             // A miss larger than that of any two directions.

// A reflecting surface at a pixel, in the view space of its frame.
struct Reflector {
  vec3 position;
  vec3 normal;  // Shading normal.
  float roughness;
};

const float kNoSample = -1.0;  // In place of one over a distance.

// What the pixels of a work group show, and those around it.
const int kTileSide = int(gl_WorkGroupSize.x) + 2;
shared float tileDepths[kTileSide * kTileSide];  // 0 outside the image.
shared vec4 tileNormals[kTileSide * kTileSide];  // Shading normal; one over the distance of what is reflected.

// Shading normal and view depth of a pixel, as guides hold them; depth 0: there is no surface.
#ifdef HOST_SURFACES
ivec2 pictureSize() { return textureSize(hostDepth, 0); }
vec4 normalAndDepthAt(ivec2 q) {
  const Surface surface = surfaceAt(q, texelFetch(hostDepth, q, 0).x, surfaceDepthEnd());
  return vec4(unpackLongNormal(packNormal(surface.normal)), unpackDepth(packDepthSdf(surface.depth, 0u)));
}
#else
vec4 normalAndDepthAt(ivec2 q) {
  return vec4(unpackLongNormal(texelFetch(shadingNormal, q, 0).x), depthAt(q));
}
#endif

void fillTile() {
  const ivec2 first = ivec2(gl_WorkGroupID.xy * gl_WorkGroupSize.xy) - 1;
  for (int i = int(gl_LocalInvocationIndex); i < kTileSide * kTileSide; i += 64) {
    const ivec2 there = first + ivec2(i % kTileSide, i / kTileSide);
    const ivec2 q = clamp(there, ivec2(0), pictureSize() - 1);
    const vec4 seen = normalAndDepthAt(q);
    const float distance = texelFetch(lighting, q, 0).a;
    tileDepths[i] = q == there ? seen.w : 0.0;
    tileNormals[i] = vec4(seen.xyz, distance > 0.0 ? inverseDistance(distance) : kNoSample);
  }
  barrier();
}

// The place in the tile of the pixel that is `offset` away from this thread's.
int inTile(ivec2 offset) {
  const ivec2 q = ivec2(gl_LocalInvocationID.xy) + 1 + offset;
  return q.y * kTileSide + q.x;
}

#ifdef HOST_SURFACES
float depthAt(ivec2 p) { return tileDepths[inTile(p - ivec2(gl_GlobalInvocationID.xy))]; }
#endif

// That of this thread's pixel `p`.
Reflector reflectorAt(ivec2 p) {
  const int i = inTile(ivec2(0));
  return Reflector(rayThrough(frame.rayFromPixel, pixelCentre(p)) * tileDepths[i], tileNormals[i].xyz,
                   validRoughness(texelFetch(roughness, p, 0).x));
}

// Whether two points with these normals lie on one surface. The mean of the normals is perpendicular to the line
// between any two points of a sphere or a plane.
bool areOnOneSurface(vec3 a, vec3 normalA, vec3 b, vec3 normalB) {
  const bool facing = dot(normalA, normalB) >= constants.normalThreshold;
  return facing && abs(dot(b - a, normalA + normalB)) <= -2.0 * constants.planeTolerance * a.z;
}

// Whether the pixel `offset` away lies on the tangent plane of `own` and faces as it does.
bool showsSurface(ivec2 offset, Reflector own) {
  const int i = inTile(offset);
  // The product of a normal and the view ray is linear over the image.
  const float product = dot(own.normal, own.position) / -own.position.z;
  const float there = tileDepths[i] * (product + dot(own.normal.xy * frame.rayFromPixel.xy, vec2(offset)));
  const bool near = abs(there + own.position.z * product) <= constants.planeTolerance * -own.position.z;
  return tileDepths[i] > 0.0 && near && dot(own.normal, tileNormals[i].xyz) >= constants.normalThreshold;
}

// Depth of a pixel over the distances that the samples of the 3 x 3 pixels on the same surface have.
struct ReflectedSamples {
  float nearest;   // The largest. 0 without samples: what is reflected counts as far away.
  float farthest;  // The smallest, if there are samples.
  float nearness;  // The mean; below 0 without samples.
  ivec2 pixelOfNearest;
};
const ReflectedSamples kNoReflectedSamples = ReflectedSamples(0.0, 0.0, -1.0, ivec2(0));

ReflectedSamples samplesAround(ivec2 p, Reflector own) {
  float nearest = 0.0, farthest = kLargestHalf, sum = 0.0, count = 0.0;
  ivec2 offsetOfNearest = ivec2(0);
  for (int i = 0; i < 9; ++i) {
    const ivec2 offset = ivec2(i % 3, i / 3) - 1;
    const float inverse = tileNormals[inTile(offset)].w;
    const bool counts = showsSurface(offset, own) && inverse != kNoSample;
    const float nearness = counts ? nearnessOf(inverse, -own.position.z) : 0.0;
    if (nearness > nearest) offsetOfNearest = offset;
    nearest = max(nearest, nearness);
    farthest = counts ? min(farthest, nearness) : farthest;
    sum += nearness;
    count += counts ? 1.0 : 0.0;
  }
  return ReflectedSamples(nearest, farthest, count > 0.0 ? sum / count : -1.0, p + offsetOfNearest);
}

// What a pixel of the previous frame must show to be history.
struct Sought {
  Reflector surface;  // Where it was.
  bool valid;         // That is known.
  vec2 inverses;      // Smallest and largest one over the distance of what it reflects.
};

const vec2 kAnyInverses = vec2(-1.0, 1e30);

// The light of a mirror is that of what it shows: where another thing came into view, or went, there is no history.
vec2 soughtInverses(Reflector own, ReflectedSamples samples) {
  if (own.roughness > kMirrorUpTo || samples.nearness < 0.0) return kAnyInverses;
  return vec2(samples.farthest / kDistanceTolerance - kLeastNearness,
              samples.nearest * kDistanceTolerance + kLeastNearness) /
         -own.position.z;
}

// Of a pixel of the previous frame at the depth z.
bool isSought(ReflectedDistance distance, float z, vec2 inverses) {
  const float inverse = distance.inverse / z;
  return distance.frames == 0.0 || (inverse >= inverses.x && inverse <= inverses.y);
}

// What the previous frame shows at taps.
struct ShownBefore {
  bvec4 inside;
  vec4 depths;
  uvec2 reflectors[4];
};

ShownBefore shownBefore(HistoryTaps taps) {
  const vec2 corner = sharedCorner(taps, frame.previousTexel);
  const uvec4 words[2] = {gatherTaps(previousReflector, corner), textureGather(previousReflector, corner, 1).wzxy};
  ShownBefore shown;
  shown.inside = tapsInside(taps, textureSize(previousReflector, 0));
  shown.depths = unpackDepth(gatherTaps(previousDepth, corner));
  [[unroll]] for (int i = 0; i < 4; ++i) shown.reflectors[i] = uvec2(words[0][i], words[1][i]);
  return shown;
}

bool showsSurfaceBefore(ShownBefore shown, int i) { return shown.inside[i] && shown.depths[i] > 0.0; }

vec3 positionBefore(HistoryTaps taps, int i, float depth) {
  const vec2 q = vec2(historyTap(taps, i)) + 0.5;
  return rayThrough(frame.previousRayFromPixel, q * frame.pixelFromPreviousPixel) * depth;
}

// The surface's depth in the previous frame, over the depth that it would have if it stood still. The surface lay on the
// plane of a pixel there: of the four at its place that face as it does, the one with the least change counts. 1 if
// none fits.
float foundDepthChange(ivec2 p, vec2 motion, Reflector still) {
  const HistoryTaps taps = tapsAround(p, motion, frame.previousPixelFromPixel);
  const ShownBefore shown = shownBefore(taps);
  vec4 changes;
  bvec4 candidates;
  [[unroll]] for (int i = 0; i < 4; ++i) {
    const vec3 normal = unpackLongNormal(shown.reflectors[i].x), plane = still.normal + normal;
    changes[i] = dot(positionBefore(taps, i, shown.depths[i]), plane) / dot(still.position, plane);
    candidates[i] = showsSurfaceBefore(shown, i) && dot(still.normal, normal) >= constants.normalThreshold;
  }
  const float nearest = nearestTap(changes, candidates, 1.0, constants.planeTolerance);
  return nearest == kNoTap ? 1.0 : nearest;
}

// What the previous frame shows at a position: the mean of those of its pixels there that show what is sought.
struct Before {
  vec3 position;
  vec3 normal;  // Not normalised.
  // Their changes from one pixel of the previous frame to the next, if `whole`.
  vec3 positionSlopes[2];
  vec3 normalSlopes[2];
  vec3 normalTwist;  // By how much a slope of normals differs between the two sides.
  bvec4 accepted;
  bool found;
  bool whole;  // All four pixels show what is sought.
};

Before surfaceBefore(HistoryTaps taps, Sought sought) {
  const Reflector surface = sought.surface;
  const ShownBefore shown = shownBefore(taps);
  vec3 positions[4], normals[4];
  Before b;
  [[unroll]] for (int i = 0; i < 4; ++i) {
    const uvec2 reflector = shown.reflectors[i];
    positions[i] = positionBefore(taps, i, shown.depths[i]);
    normals[i] = unpackLongNormal(reflector.x);
    const float rougher = roughnessOf(reflector) - surface.roughness;
    b.accepted[i] = sought.valid && showsSurfaceBefore(shown, i) && abs(rougher) <= kRoughnessTolerance &&
                    isSought(distanceOf(reflector), shown.depths[i], sought.inverses) &&
                    areOnOneSurface(surface.position, surface.normal, positions[i], normals[i]);
  }
  taps.accepted = b.accepted;
  const vec4 weights = tapWeights(taps);
  const float sum = dot(weights, vec4(1.0)), scale = 1.0 / max(sum, kLeastTapWeight);
  b.position = b.normal = vec3(0.0);
  [[unroll]] for (int i = 0; i < 4; ++i) {
    b.position += scale * weights[i] * positions[i];
    b.normal += scale * weights[i] * normals[i];
  }
  b.found = sum > kLeastTapWeight;
  b.whole = all(b.accepted);
  const vec2 f = taps.fraction;
  b.positionSlopes[0] = mix(positions[1] - positions[0], positions[3] - positions[2], f.y);
  b.positionSlopes[1] = mix(positions[2] - positions[0], positions[3] - positions[1], f.x);
  b.normalTwist = normals[0] - normals[1] - normals[2] + normals[3];
  b.normalSlopes[0] = mix(normals[1] - normals[0], normals[3] - normals[2], f.y);
  b.normalSlopes[1] = mix(normals[2] - normals[0], normals[3] - normals[1], f.x);
  return b;
}

// Positions in the previous image are in pixels of this frame's size, and include its jitter.

// The place of a point that is still, given in the view space of this frame.
vec2 pixelBefore(vec3 point) {
  return nearPixelOf(frame.previousRayFromPixel, previousPosition(frame.previousViewFromView, point));
}

HistoryTaps tapsAt(vec2 position) {
  const vec2 before = position * frame.previousPixelFromPixel - 0.5, base = floor(before);
  return HistoryTaps(ivec2(base), before - base, bvec4(false));
}

// The difference between the direction that a surface reflects to the eye and that of a point, which is the angle by
// which the reflected ray misses the point where that is small.
vec3 missOf(vec3 object, vec3 position, vec3 normal) {
  const vec3 n = normal * inversesqrt(max(dot(normal, normal), 1e-20)), way = object - position;
  const vec3 seen = position * inversesqrt(max(dot(position, position), 1e-20));
  return reflect(seen, n) - way * inversesqrt(max(dot(way, way), 1e-20));
}

// Whether normals turn by less from pixel to pixel than view rays do: then, the mirror's image is that of a flat one.
bool isFlat() {
  const vec3 across = tileNormals[inTile(ivec2(1, 0))].xyz - tileNormals[inTile(ivec2(-1, 0))].xyz;
  const vec3 down = tileNormals[inTile(ivec2(0, 1))].xyz - tileNormals[inTile(ivec2(0, -1))].xyz;
  const float perPixel = 2.0 * frame.rayFromPixel.y;
  return max(dot(across, across), dot(down, down)) < perPixel * perPixel;
}

// A place in the previous image where the light may have been.
struct Candidate {
  vec2 position;
  float miss;  // Length of missOf; kNoHistory: there is none.
};

// Where one step of Newton's method on the miss leads from a place; that place, where slopes do not tell. They do not
// where normals turn unevenly, as on bumps. The miss there is the one that slopes predict.
Candidate newtonStep(Candidate from, Before b, vec3 missed, vec3 object) {
  const vec3 x = missOf(object, b.position + b.positionSlopes[0], b.normal + b.normalSlopes[0]) - missed;
  const vec3 y = missOf(object, b.position + b.positionSlopes[1], b.normal + b.normalSlopes[1]) - missed;
  // Least squares: the three components have two degrees of freedom.
  const float xx = dot(x, x), yy = dot(y, y), xy = dot(x, y), determinant = xx * yy - xy * xy;
  if (!(determinant > 1e-6 * xx * yy)) return from;
  const vec2 right = -vec2(dot(x, missed), dot(y, missed));
  vec2 step = vec2(yy * right.x - xy * right.y, xx * right.y - xy * right.x) / determinant;
  step *= min(1.0, kLongestNewtonStep * inversesqrt(max(dot(step, step), 1e-20)));
  if ((length(b.normalTwist) - kRoundingOfTwist) * dot(step, step) > kMostTwist * from.miss) return from;
  const vec3 left = missed + step.x * x + step.y * y;
  return Candidate(from.position + step * frame.pixelFromPreviousPixel, length(left));
}

Candidate candidateNear(vec2 start, Sought sought, vec3 object) {
  const Before b = surfaceBefore(tapsAt(start), sought);
  const vec3 missed = missOf(object, b.position, b.normal);
  const Candidate there = Candidate(start, b.found ? length(missed) : kNoHistory);
  if (!b.whole) return there;
  return newtonStep(there, b, missed, object);
}

// Where the point that is reflected was in the previous frame, minus where it is: in view space of this frame. Values
// that are not finite are no statement. What a wide lobe shows does not move as a single sample does.
vec3 motionOfReflected(Reflector own, ReflectedSamples samples) {
  if (!kSpecularMotion || samples.nearest == 0.0 || own.roughness > kFollowsUpTo) return vec3(0.0);
  const vec3 moved = texelFetch(specularMotion, samples.pixelOfNearest, 0).xyz;
  return isFinite(moved) ? mat3(frame.viewFromWorld) * moved : vec3(0.0);
}

// The place of a pixel's reflected light in the previous frame.
struct ReflectionMotion {
  vec2 motion;    // As kept taps hold it.
  bvec4 taps;     // Which are accepted.
  float history;  // Longest, frames.
  float miss;     // Over the half angle that it is compared with.
  bool followed;  // It is another place than the surface's.
  ReflectedSamples samples;  // Only with DISTANCES, or below constants.surfaceFrom.
};

ReflectionMotion reflectionMotionAt(ivec2 p, Reflector own) {
  const Reprojection r = reproject(p, -own.position.z);
  const vec2 ofSurface = pixelCentre(p) + r.motion + frame.jitterDelta;
  Reflector surface = Reflector(rayThrough(frame.previousRayFromPixel, ofSurface) * r.depth,
                                mat3(frame.previousViewFromView) * own.normal, own.roughness);
  if (kMotionDepthFound) surface.position *= foundDepthChange(p, r.motion, surface);
  Sought sought = Sought(surface, r.valid, kAnyInverses);
  ReflectionMotion result =
      ReflectionMotion(r.motion, bvec4(false), constants.maxHistory, 0.0, false, kNoReflectedSamples);
  if (kDistances || own.roughness < constants.surfaceFrom) result.samples = samplesAround(p, own);
  if (own.roughness < constants.surfaceFrom) {
    sought.inverses = soughtInverses(own, result.samples);
    const float distance = -own.position.z / max(result.samples.nearest, 1.0 / kFarthestObject);
    const vec3 seen = normalize(own.position);
    const vec3 object = own.position + distance * reflect(seen, own.normal);
    const vec3 moved = motionOfReflected(own, result.samples);
    const vec3 objectBefore = previousPosition(frame.previousViewFromView, object + moved);
    vec2 start = ofSurface;
    if (own.roughness <= kSharpUpTo && isFlat()) {
      // Objects that move carry their images along, and so do mirrors.
      const vec3 image = own.position + distance * seen + reflect(moved, own.normal);
      start += pixelBefore(image) - pixelBefore(own.position);
    }
    const Candidate best = candidateNear(start, sought, objectBefore);
    result.followed = best.position != ofSurface;
    if (result.followed) result.motion = keepableMotion(best.position - frame.jitterDelta - pixelCentre(p));
    // No picture tells angles below half a pixel apart.
    const float allowed = max(lobeAngle(own.roughness), 0.5 * abs(frame.rayFromPixel.y));
    result.miss = best.miss / allowed;
    result.history = min(constants.historyPerLobe / max(result.miss, 1e-6), constants.maxHistory);
  }
  result.history = confidentLength(p, result.history, constants.maxHistory);
  result.taps = surfaceBefore(tapsAround(p, result.motion, frame.previousPixelFromPixel), sought).accepted;
  return result;
}

HistoryTaps tapsOf(ivec2 p, ReflectionMotion m) {
  HistoryTaps taps = tapsAround(p, m.motion, frame.previousPixelFromPixel);
  taps.accepted = m.taps;
  return taps;
}

// Depth of a pixel over the distance of what it reflects, by this frame's samples; below 0 without any. A rough surface
// reflects many things, and the pixel's own sample shows one of them by chance.
float nearnessAt(Reflector own, ReflectionMotion m) {
  const float inverse = tileNormals[inTile(ivec2(0))].w;
  const float sharp = inverse == kNoSample ? inverse : nearnessOf(inverse, -own.position.z);
  return own.roughness <= kSharpUpTo ? sharp : m.samples.nearness;
}

// The mean over time of what samples tell of the distance of what a pixel reflects.
ReflectedDistance meanDistance(ivec2 p, Reflector own, ReflectionMotion m) {
  const HistoryTaps taps = tapsOf(p, m);
  const vec4 weights = tapWeights(taps);
  const uvec4 texels = textureGather(previousReflector, sharedCorner(taps, frame.previousTexel), 1).wzxy;
  ReflectedDistance mean = ReflectedDistance(0.0, 0.0);
  float known = 0.0;
  [[unroll]] for (int i = 0; i < 4; ++i) {
    const ReflectedDistance tap = distanceOf(uvec2(0u, texels[i]));
    const float weight = tap.frames > 0.0 ? weights[i] : 0.0;
    mean.inverse += weight * tap.inverse;
    mean.frames += weight * tap.frames;
    known += weight;
  }
  const float scale = known > kLeastTapWeight ? 1.0 / known : 0.0;
  mean.inverse *= scale;
  mean.frames = min(scale * mean.frames, m.history);
  const float inverse = nearnessAt(own, m);
  if (inverse < 0.0) return mean;
  mean.frames = min(mean.frames + 1.0, constants.maxHistory);
  mean.inverse += (inverse - mean.inverse) / mean.frames;
  return mean;
}

// What tells of the light that the pixel reflects, for the filter and the next frame.
uvec2 packedReflectorOf(ivec2 p, Reflector own, ReflectionMotion m) {
  ReflectedDistance distance = ReflectedDistance(0.0, 0.0);
  if (kDistances || own.roughness <= kMirrorUpTo) distance = meanDistance(p, own, m);
  return packReflector(packNormal(own.normal), own.roughness, distance);
}

#endif
