// Where the previous frame showed a tile of the reconstruction, whose middle pixel stands for all.
// Needs: `frame` (FrameConstants) and `depthAtMiddle(p)`, the depth at a pixel that may lie outside the image; 0 without
// a surface.
#ifndef WALR_TILE_BEFORE_GLSL
#define WALR_TILE_BEFORE_GLSL
#include "conventions/camera.glsl"

// The position of its centre in units of tiles, if nothing but the camera moved; negative if there is none. `side`: pixels
// of a tile per axis; `offset`: of those that lie before the image.
vec2 tileBefore(ivec2 tile, int side, int offset) {
  if (frame.previousPixelFromPixel != vec2(1.0)) return vec2(-1.0);  // The image has changed its size, and so have tiles.
  const ivec2 p = max(side * tile - offset + side / 2, ivec2(0));
  const float z = depthAtMiddle(p);
  if (z == 0.0) return vec2(tile) + 0.5;
  const vec3 before =
      previousPosition(frame.previousViewFromView, z * rayThrough(frame.rayFromPixel, pixelCentre(p)));
  if (before.z >= 0.0) return vec2(-1.0);
  const vec2 corner = nearPixelOf(frame.previousRayFromPixel, before) - (float(side / 2) + 0.5);
  return (corner + float(offset)) / float(side) + 0.5;
}

#endif
