// The tile of pixels that a workgroup of the reconstruction covers: squares between the centres of four blocks, so that all
// threads of a square read the same four fits. The first tile begins half a block before the image.
// Needs: `kBlockSize`: pixels per axis of a block, 2 to 8.
#ifndef WALR_RECONSTRUCTION_TILE_GLSL
#define WALR_RECONSTRUCTION_TILE_GLSL

const int kGroupSize = 8;                           // Threads per axis.
const int kTileSquares = kGroupSize / kBlockSize;   // Per axis.
const int kTilePixels = kTileSquares * kBlockSize;  // Per axis. Further threads have no pixel.
const int kTileStart = (kBlockSize + 1) / 2;        // Pixels before the image.

#endif
