// Sums over windows of tiles. A workgroup shares the tiles around its own, so that each is fetched once.
// Needs: kRadius, the radius of the window in tiles; kSharedLeast, a number of tiles for which the shared memory is to be
// sufficient; `tilesOfImage()`; `windowWeight(offset)`, the weight of tiles that lie so many away along an axis; workgroups
// of 8 x 8.
#ifndef WALR_WINDOW_SUM_GLSL
#define WALR_WINDOW_SUM_GLSL

const int kGroup = 8;
const int kSide = kGroup + 2 * kRadius;
const int kRows = kSide * kSide;  // Index of the first sum of a row.
const int kSharedWithRows = kRows + kSide * kGroup;
shared vec4 sharedTiles[kSharedWithRows > kSharedLeast ? kSharedWithRows : kSharedLeast];

bool isTile(ivec2 tile) { return all(greaterThanEqual(tile, ivec2(0))) && all(lessThan(tile, tilesOfImage())); }

// Shares `side` x `side` tiles of an image from the tile `first` on; 0 outside the image. `origin`: texel of the tile
// 0. All threads must call it.
void shareTiles(texture2D image, ivec2 origin, ivec2 first, int side) {
  barrier();  // What was there has been read.
  for (int i = int(gl_LocalInvocationIndex); i < side * side; i += kGroup * kGroup) {
    const ivec2 tile = first + ivec2(i % side, i / side);
    sharedTiles[i] = isTile(tile) ? texelFetch(image, origin + tile, 0) : vec4(0.0);
  }
  barrier();
}

// The first tile that a workgroup needs for its windows.
ivec2 firstOfWindows() { return ivec2(gl_WorkGroupID.xy) * kGroup - kRadius; }

// Sum over the window around this thread's tile of what is shared, one axis after the other. All threads must call it.
vec4 sharedWindowSum() {
  for (int i = int(gl_LocalInvocationIndex); i < kSide * kGroup; i += kGroup * kGroup) {
    const int first = i / kGroup * kSide + i % kGroup;
    vec4 row = vec4(0.0);
    for (int x = 0; x <= 2 * kRadius; ++x) row += windowWeight(x - kRadius) * sharedTiles[first + x];
    sharedTiles[kRows + i] = row;
  }
  barrier();
  vec4 sum = vec4(0.0);
  for (int y = 0; y <= 2 * kRadius; ++y) {
    sum += windowWeight(y - kRadius) * sharedTiles[kRows + kGroup * y + int(gl_LocalInvocationIndex)];
  }
  return sum;
}

// The same of an image. All threads must call it.
vec4 windowSum(texture2D image, ivec2 origin) {
  shareTiles(image, origin, firstOfWindows(), kSide);
  return sharedWindowSum();
}

#endif
