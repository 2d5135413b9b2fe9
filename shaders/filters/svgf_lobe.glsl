// W_R, the edge-stopping function that takes the place of W_N for specular light. It follows from optics: two pixels
// reflect the same light as far as their lobes cover the same things. From the pixel itself, another pixel's light
// seems to come from the point that its lobe's middle meets. The weight falls with the angle between the direction to
// that point and the own lobe's middle, and with the difference between the two lobes' half angles. It falls at least
// as fast as W_N: mirrored directions turn by twice the angle a between normals, and cos^s a is nearly exp(-s a^2 / 2).
// Needs: `frame` (FrameConstants), `constants` (SvgfFilterConstants). Takes constant_id 4.
#ifndef WALR_SVGF_LOBE_GLSL
#define WALR_SVGF_LOBE_GLSL
#include "conventions/camera.glsl"
#include "conventions/packed_lobe.glsl"

// Part of a lobe's half angle over which its weight falls to exp(-1/2).
layout(constant_id = 4) const float kLobeShare = 1.0;

// The pixel at which W_R is 1.
struct Reflection {
  vec3 ray;  // View ray of the pixel.
  Lobe lobe;
  float inverseDepth;
  float falloff;  // W_R = 2^(-falloff a^2) at an angle of a radians.
};

const float kNarrowestLobe = 1e-4;  // Radians. Less than a pixel: a mirror keeps its accumulated light.

// `sampled`: whether the pixel has a sample. One that has none takes what is near.
Reflection reflectionOf(ivec2 p, float z, Lobe lobe, bool sampled) {
  const float angle = max(kLobeShare * lobe.angle, kNarrowestLobe);
  const float byLobe = sampled ? 1.0 / (angle * angle) : 0.0;
  const float falloff = 0.5 * kLog2OfE * (byLobe + 0.25 * constants.sigmaNormal);
  return Reflection(rayThrough(frame.rayFromPixel, pixelCentre(p)), lobe, 1.0 / z, falloff);
}

// log2(W_R) of the pixel `d` away.
float lobeExponent(Reflection own, vec2 d, float z, Lobe lobe) {
  const vec3 ray = own.ray + vec3(d * frame.rayFromPixel.xy, 0.0);
  // In units of the distance of what is reflected.
  const vec3 way = lobe.direction + (ray * (z * own.inverseDepth) - own.ray) * own.lobe.nearness;
  const vec3 turn = way * inversesqrt(max(dot(way, way), 1e-20)) - own.lobe.direction;
  const float wider = lobe.angle - own.lobe.angle;
  return -own.falloff * (dot(turn, turn) + wider * wider);
}

#endif
