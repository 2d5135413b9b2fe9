#ifndef WALR_SHADERS_TEMPORAL_BMFR_ACCUMULATION_H
#define WALR_SHADERS_TEMPORAL_BMFR_ACCUMULATION_H
#include "../common/types.h"
#ifdef __cplusplus
namespace walr {
#endif

struct BmfrAccumulationConstants {
  float maxHistory;  // History length at which the cumulative mean turns exponential.
};

#ifdef __cplusplus
static_assert(sizeof(BmfrAccumulationConstants) == 4);
}  // namespace walr
#endif
#endif
