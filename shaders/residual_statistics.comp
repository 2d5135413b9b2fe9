// WALR, share of the accumulated light (passes/WALR_EXPERIMENTS.md): running means of the residuals around a tile,
// relative to the square of the light. x: product of the residuals of both halves; y: square of the residual; z: frames
// in these means.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "constants/accumulated_share.h"
#include "constants/frame.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(std140) uniform frameConstants { FrameConstants frame; };
uniform utexture2D depth;
uniform texture2D sums;  // Of each tile: include/accumulated_share.glsl.
uniform texture2D previousStatistics;
layout(rgba32f) uniform writeonly image2D outStatistics;
layout(push_constant) uniform PushConstants { ResidualStatisticsConstants constants; };
#include "include/camera.glsl"
#include "include/surface.glsl"

// The tile that showed the middle of this one in the previous frame, if nothing but the camera moved.
ivec2 previousTile(ivec2 tile) {
  const ivec2 first = constants.tileSize * tile - constants.tileOffset;
  const ivec2 p = clamp(first + constants.tileSize / 2, ivec2(0), textureSize(depth, 0) - 1);
  const float z = unpackDepth(texelFetch(depth, p, 0).x);
  if (z == 0.0) return tile;
  const vec3 before =
      previousPosition(frame.previousViewFromView, z * rayThrough(frame.rayFromPixel, pixelCentre(p)));
  if (before.z >= 0.0) return ivec2(-1);
  const vec2 pixel = clamp(pixelOf(frame.previousRayFromPixel, before), vec2(-1e6), vec2(1e6));
  return ivec2(floor((pixel + float(constants.tileOffset)) / float(constants.tileSize)));
}

void main() {
  const ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  const ivec2 size = textureSize(sums, 0);
  if (any(greaterThanEqual(tile, size))) return;

  vec3 statistics = vec3(0.0);
  const ivec2 before = previousTile(tile);
  if (all(greaterThanEqual(before, ivec2(0))) && all(lessThan(before, size))) {
    statistics = texelFetch(previousStatistics, before, 0).xyz;
  }
  const ivec2 first = max(tile - constants.radius, ivec2(0));
  const ivec2 last = min(tile + constants.radius, size - 1);
  vec3 sum = vec3(0.0);  // z: pixels.
  for (int y = first.y; y <= last.y; ++y) {
    for (int x = first.x; x <= last.x; ++x) {
      sum += texelFetch(sums, ivec2(x, y), 0).xyz;
    }
  }
  if (sum.z > 0.0) {
    statistics.z = min(statistics.z + 1.0, constants.mostFrames);
    statistics.xy = mix(statistics.xy, sum.xy / sum.z, 1.0 / statistics.z);
  }
  imageStore(outStatistics, tile, vec4(statistics, 0.0));
}
