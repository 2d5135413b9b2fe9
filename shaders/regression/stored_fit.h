// Fits in storage buffers: one element per block or cell, row by row. block_fit.glsl makes them and
// stored_fit.glsl evaluates them.
#ifndef WALR_SHADERS_REGRESSION_STORED_FIT_H
#define WALR_SHADERS_REGRESSION_STORED_FIT_H
#include "../common/types.h"
#ifdef __cplusplus
namespace walr {
#endif

// A fit: colour = constant + sum over features of slope times feature.
struct StoredFit {
  vec4 constant;   // rgb in units of kLightUnit; alpha: depth that the depth feature is relative to.
  uvec4 slope[2];  // Sixteen halves: rgb of the slope of each feature in turn, and W, the sample count, in units of
                   // kSampleCountUnit. W is 0 where there is no fit.
};

// The fit of a block, and the plane of the block's representative pixel.
struct StoredBlockFit {
  StoredFit fit;
  vec4 plane;  // Normal over depth, and the offset of conventions/plane.glsl. All 0 where there is no fit.
};

#ifdef __cplusplus
static_assert(sizeof(StoredFit) == 48);
static_assert(sizeof(StoredBlockFit) == 64);
}  // namespace walr
#endif
#endif
