// Ambient occlusion by what the depth buffer shows around a pixel: the mean over eight directions of the sine at which
// the horizon stands above the tangent plane (after Bavoil, Sainz and Dimitrov, "Image-space horizon-based ambient
// occlusion", 2008), each occluder fading out at the search radius. Same pattern at every pixel and no randomness: it
// serves as a feature of the regression, and a noisy feature would print its noise. With LISTED_TILES only tiles with a
// surface have a value.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_control_flow_attributes : require
#include "constants/ambient_occlusion.h"
#include "constants/frame.h"
#include "include/camera.glsl"
#include "include/listed_tiles.glsl"
#include "include/surface.glsl"

layout(local_size_x = kTileSide, local_size_y = kTileSide) in;
layout(constant_id = 0) const int kSteps = 5;  // Of a direction; their distances grow with the square, from one pixel on.

layout(set = 0, binding = 0, std140) uniform frameConstants { FrameConstants frame; };
layout(set = 0, binding = 1) uniform utexture2D depth;
layout(set = 0, binding = 2) uniform utexture2D shadingNormal;
layout(set = 0, binding = 3, r8) uniform writeonly image2D outOcclusion;
layout(push_constant) uniform PushConstants { AmbientOcclusionConstants settings; };

void main() {
  const ivec2 p = pixelOfThread();
  const ivec2 size = textureSize(depth, 0);
  if (any(greaterThanEqual(p, size))) return;
  const float z = unpackDepth(texelFetch(depth, p, 0).x);
  if (z == 0.0) {
    imageStore(outOcclusion, p, vec4(0.0));
    return;
  }
  const vec3 normal = unpackNormal(texelFetch(shadingNormal, p, 0).x);
  const vec3 ray = rayThrough(frame.rayFromPixel, pixelCentre(p));
  // Lengths in units of the pixel's depth, so that no scale over- or underflows.
  const float inverseDepth = 1.0 / z;
  const float reach = settings.radius * abs(frame.rayFromPixel.x);
  const float falloff = 1.0 / (reach * reach);
  // All directions side by side: their fetches do not wait for each other, and distances are the same for all pixels.
  float horizon[9] = float[](0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
  for (int step = 1; step <= kSteps; ++step) {
    const float share = float(step) / float(kSteps);
    const int distance = max(int(settings.radius * share * share), step);
    [[unroll]] for (int i = 0; i < 9; ++i) {
      if (i != 4) {
        const ivec2 direction = ivec2(i % 3, i / 3) - 1;
        const ivec2 q = p + distance * direction;
        const ivec2 inside = clamp(q, ivec2(0), size - 1);
        const float zq = unpackDepth(texelFetch(depth, inside, 0).x);
        const vec2 turn = float(distance) * vec2(direction) * frame.rayFromPixel.xy;  // Of the ray.
        const vec3 v = zq * inverseDepth * (ray + vec3(turn, 0.0)) - ray;
        const float squared = max(dot(v, v), 1e-12);
        const float sine = max(1.0 - squared * falloff, 0.0) * dot(normal, v) * inversesqrt(squared);
        horizon[i] = max(horizon[i], inside == q && zq > 0.0 ? sine : 0.0);
      }
    }
  }
  float sum = 0.0;
  [[unroll]] for (int i = 0; i < 9; ++i) sum += horizon[i];
  // Storing may round either way; this is the nearest.
  imageStore(outOcclusion, p, vec4(round(255.0 * sum / 8.0) / 255.0));
}
