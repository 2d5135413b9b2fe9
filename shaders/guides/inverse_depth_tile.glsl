// Inverse depths of a work group of 8 x 8 pixels and of two pixels beyond each of its sides, in shared memory. Each
// thread reads its own pixel and one of the 64 beyond the sides.
// Needs: `hostDepth`, `isSurfaceDepth`.
#ifndef WALR_INVERSE_DEPTH_TILE_GLSL
#define WALR_INVERSE_DEPTH_TILE_GLSL

// Inverse depths, which are linear over the image of a plane; 0 outside the image and on sky. The tile is 12 x 12
// pixels and begins two pixels before the work group in x and y. Its corners are not read.
const uint kInverseDepthRow = 12u;
shared float sharedInverseDepth[kInverseDepthRow * kInverseDepthRow];

uint inverseDepthIndex(uvec2 pixelOfTile) { return pixelOfTile.y * kInverseDepthRow + pixelOfTile.x; }

// Shares the inverse depth of this thread's pixel, whose depth is `z`, and that of a pixel beyond the work group's
// sides. The other threads see them after the next barrier.
void shareInverseDepths(float z, uint depthEnd) {
  const uvec2 local = gl_LocalInvocationID.xy;
  sharedInverseDepth[inverseDepthIndex(local + 2u)] = isSurfaceDepth(z, depthEnd) ? 1.0 / z : 0.0;

  // Threads of rows 0 to 3 read the tile's columns 0, 1, 10 and 11, those of rows 4 to 7 its rows 0, 1, 10 and 11.
  const uint across = (local.y & 1u) + ((local.y & 2u) != 0u ? 10u : 0u);
  const uint along = local.x + 2u;
  const uvec2 beyond = local.y < 4u ? uvec2(across, along) : uvec2(along, across);
  const uvec2 q = gl_WorkGroupID.xy * 8u - 2u + beyond;
  const uvec2 last = uvec2(textureSize(hostDepth, 0) - 1);
  const bool inside = all(lessThanEqual(q, last));  // Coordinates below 0 are huge.
  const float zBeyond = texelFetch(hostDepth, ivec2(min(q, last)), 0).x;
  const bool surface = isSurfaceDepth(zBeyond, depthEnd);
  sharedInverseDepth[inverseDepthIndex(beyond)] = inside && surface ? 1.0 / zBeyond : 0.0;
}

#endif
