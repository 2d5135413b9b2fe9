#ifndef WALR_SHADERS_NETWORK_GUIDE_NETWORK_H
#define WALR_SHADERS_NETWORK_GUIDE_NETWORK_H
#include "../common/types.h"
#ifdef __cplusplus
namespace walr {
#endif

struct LayerConstants {
  ivec2 extent;       // Of the result, texels.
  ivec2 firstExtent;  // Of the first input, which the layer may pool or grow.
  uint weights;       // Index of the layer's first weights in the buffer, in groups of four.
};

// How a layer reads its first input.
const uint kInputAsItIs = 0u;
const uint kInputPooled = 1u;  // The largest of 2 x 2 texels.
const uint kInputGrown = 2u;   // Each texel stands for 2 x 2.

// Features of a pixel that a network sees.
const int kNetworkFeatures = 8;

// Pixels per axis of a tile of flnr_means.comp.
const int kMeansTile = 64;

#ifdef __cplusplus
static_assert(sizeof(LayerConstants) == 20);
}  // namespace walr
#endif
#endif
