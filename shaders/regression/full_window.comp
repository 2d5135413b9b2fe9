// REFWLR (Meunier & Harada 2022, 6): weighted linear regression over every pixel of a full window. The weight of a
// pixel is the smallest edge-stopping weight on the straight line to it. WALR's a-trous averages approximate this at a
// small part of its cost. One dispatch does one tile of the image.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_control_flow_attributes : require
#include "conventions/frame.h"
#include "regression/full_window.h"
#include "regression/regression.glsl"
#include "conventions/surface.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const int kRadius = 40;           // Half the window.
layout(constant_id = 1) const bool kNormalFactor = true;  // Weights fall with the cosine between the planes' normals.
layout(constant_id = 2) const bool kPivotFloor = false;   // Floor the pivots instead of adding a ridge.

layout(std140) uniform frameConstants { FrameConstants frame; };
uniform utexture2D depth;
uniform utexture2D planeNormal;
uniform utexture2D shadingNormal;
uniform texture2D accumulated;
layout(rgba16f) uniform image2D outFiltered;  // Pixels without a surface hold the pass-through.
layout(push_constant) uniform PushConstants { FullWindowConstants constants; };

#include "regression/edge_weight.glsl"

vec2 featuresAt(ivec2 q) { return unpackFeatures(texelFetch(shadingNormal, q, 0).x); }
Moments sampleAt(ivec2 q) { return momentsOf(featuresAt(q), texelFetch(accumulated, q, 0)); }
float weightAt(Plane plane, ivec2 q) { return edgeWeight(plane, q, texelFetch(depth, q, 0).x); }

// Smallest edge-stopping weight on the line from `p`, exclusive, to a pixel inside the image. The far end comes first,
// because most rejected pixels are rejected there. In between, Bresenham's algorithm visits one pixel per step along
// the longer axis, the nearest to the line, and of two equally near ones the farther from `p`, so that mirrored images
// give mirrored results. The loop takes eight steps at a time, of which the last may repeat a pixel: their reads
// overlap, and the largest window stays below the limit of Mesa's llvmpipe, which ends all loops of an invocation after
// 65535 rounds in total.
float traceLine(Plane plane, ivec2 p, ivec2 offset) {
  float weight = weightAt(plane, p + offset);
  const ivec2 way = abs(offset);
  const int steps = max(way.x, way.y);
  ivec2 at = p;
  ivec2 remainder = ivec2(steps);
  for (int step = 1; step < steps && weight > 0.0; step += 8) {
    [[unroll]] for (int i = 0; i < 8; ++i) {
      remainder += step + i < steps ? 2 * way : ivec2(0);
      const ivec2 moved = ivec2(greaterThanEqual(remainder, ivec2(2 * steps)));
      remainder -= moved * 2 * steps;
      at += moved * sign(offset);
      weight = min(weight, weightAt(plane, at));
    }
  }
  return weight;
}

void main() {
  const ivec2 p = constants.begin + ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(p, constants.end))) return;
  const float z = unpackDepth(texelFetch(depth, p, 0).x);
  if (z == 0.0) return;

  const vec3 normal = unpackLongNormal(texelFetch(planeNormal, p, 0).x);
  const Plane plane = planeAt(p, z, normal);
  const Moments centre = sampleAt(p);
  const ivec2 first = max(p - kRadius, ivec2(0));
  const ivec2 last = min(p + kRadius, textureSize(depth, 0) - 1);
  // Summed row by row, so that rounding grows with the side of the window and not with its area.
  MomentSum sum = startSum(centre);
  for (int y = first.y; y <= last.y; ++y) {
    MomentSum row = startSum(centre);
    for (int x = first.x; x <= last.x; ++x) {
      const ivec2 q = ivec2(x, y);
      float weight = traceLine(plane, p, q - p);
      if (weight <= 0.0) continue;
      if (kNormalFactor) weight *= clamp(dot(normal, unpackLongNormal(texelFetch(planeNormal, q, 0).x)), 0.0, 1.0);
      add(row, weight, sampleAt(q));
    }
    join(sum, row);
  }
  const Moments m = finish(sum);
  const vec3 colour = reconstruct(m, featuresAt(p), kPivotFloor, constants.ridge, constants.noiseRidge);
  // Below 0: the window has no sample, and anti-aliasing keeps its history.
  imageStore(outFiltered, p, vec4(colour, m.samples > 0.0 ? 1.0 : -1.0));
}
