#ifndef WALR_SHADERS_STAGE_COUNT_H
#define WALR_SHADERS_STAGE_COUNT_H
#include "../common/types.h"
#ifdef __cplusplus
namespace walr {
#endif

const uint kCounterWords = 256;  // Size of the buffer that receives all counters of a frame.

struct CountConstants {
  uint word;  // First of the three words that receive the sums of the view's components.
};

#ifdef __cplusplus
static_assert(sizeof(CountConstants) == 4);
}  // namespace walr
#endif
#endif
