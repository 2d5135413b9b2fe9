// How far two pixels reflect the same light: as far as their lobes cover the same things. From the pixel itself, another
// pixel's light seems to come from the point that its lobe's middle meets. The weight falls with the angle between the
// direction to that point and the own lobe's middle, with the difference between the two lobes' half angles, and with
// the distance from the tangent plane.
// A mirror shows an image, which is as smooth as what it shows, however narrow the lobe: in place of that angle, the
// weight falls with the ratio of the distances of what both pixels reflect.
// Needs: `frame` (FrameConstants).
#ifndef WALR_LOBE_WEIGHT_GLSL
#define WALR_LOBE_WEIGHT_GLSL
#include "common/natural_exponent.glsl"
#include "conventions/camera.glsl"
#include "conventions/lobe.glsl"
#include "conventions/reflector.glsl"

// Part of a lobe's half angle over which the weight falls to exp(-1/2).
float lobeShare(float angle) { return clamp(1.6 - 5.0 * angle, 0.7, 1.4); }
const float kWidestLobe = 0.41;       // Half angle of the widest part, radians: normals turn by half of it.
const float kMirrorAngle = 2.0 * kSharpUpTo * kSharpUpTo;  // weighedAngle of the roughest mirror.
const float kDistanceFalloff = 5.0;   // -log2 of a mirror's weight where one pixel reflects twice as far as the other.
const float kPlaneTolerance = 0.02;   // Distance from the plane at which the weight falls to 1/e, over depth.

// How wide the lobe is, and how near what it meets.
struct LobeReach {
  float angle;     // weighedAngle.
  float nearness;  // log2 of the surface's depth over the mean distance of what it reflects.
};

bool isMirror(LobeReach reach) { return reach.angle < kMirrorAngle; }

struct OwnLobe {
  vec3 base;       // Of the way to what another pixel reflects: its direction and its ray come to it.
  vec2 ray;
  float perDepth;  // Factor of another pixel's ray, per depth.
  vec3 direction;
  LobeReach reach;
  float falloff;          // The weight is 2^(-falloff a^2 / 2) at a chord of a between the lobes' directions,
  float widthFalloff;     // 2^(-widthFalloff a^2) for a difference a between their half angles,
  float distanceFalloff;  // and 2^-distanceFalloff per octave between the distances.
  // Distance from the plane: depth x (product + slope . offset) - planeOffset.
  float product;
  vec2 slope;
  float planeOffset;
};

// `hasLight`: one that has none takes what is near.
OwnLobe ownLobe(ivec2 p, float z, uvec2 reflector, vec3 direction, LobeReach reach, bool hasLight) {
  const vec3 ray = rayThrough(frame.rayFromPixel, pixelCentre(p));
  const float nearness = distanceOf(reflector).inverse;
  const float narrow = lobeShare(reach.angle) * max(reach.angle, kMirrorAngle);
  const float widest = 0.5 * kLog2OfE / (kWidestLobe * kWidestLobe);
  const float narrowest = widest + (hasLight ? 0.5 * kLog2OfE / (narrow * narrow) : 0.0);
  const bool mirror = hasLight && isMirror(reach);
  const vec3 normal = unpackLongNormal(reflector.x);
  const float scale = kLog2OfE / kPlaneTolerance, offset = scale * dot(normal, ray);
  return OwnLobe(-nearness * ray, ray.xy, nearness / z, direction, reach, 2.0 * (mirror ? widest : narrowest), narrowest,
                 mirror ? kDistanceFalloff : 0.0, offset / z, normal.xy * frame.rayFromPixel.xy * (scale / z), offset);
}

// Half angle of the lobe of a linear roughness where it is narrow. Wide ones weigh by kWidestLobe.
float weighedAngle(float roughness) { return 2.0 * roughness * roughness; }

LobeReach lobeReach(uvec2 reflector) {
  return LobeReach(weighedAngle(roughnessOf(reflector)), log2(max(distanceOf(reflector).inverse, kLeastNearness)));
}

// log2 of the weight of the pixel `d` away. `lobe`: its direction and depth.
float lobeExponent(OwnLobe own, vec2 d, vec4 lobe, LobeReach reach) {
  // In units of the distance of what is reflected.
  const float there = lobe.w * own.perDepth;
  const vec3 way = lobe.xyz + own.base + vec3(own.ray + d * frame.rayFromPixel.xy, -1.0) * there;
  const float cosine = dot(way, own.direction) * inversesqrt(dot(way, way) + 1e-20);
  const float wider = reach.angle - own.reach.angle, nearer = abs(reach.nearness - own.reach.nearness);
  const float distance = abs(lobe.w * (own.product + dot(own.slope, d)) - own.planeOffset);
  // The squared chord of an angle is 2 - 2 cos.
  const float turned = own.falloff * cosine - own.falloff;
  return turned - own.widthFalloff * (wider * wider) - own.distanceFalloff * nearer - distance;
}

#endif
