#ifndef WALR_SHADERS_TEMPORAL_ANTILAG_H
#define WALR_SHADERS_TEMPORAL_ANTILAG_H
#include "../common/types.h"
#ifdef __cplusplus
namespace walr {
#endif

const int kAntilagTile = 8;  // Pixels per axis: a workgroup of temporal accumulation.
// Share of the longest history below which history does not count: rounding of bilinear weights leaves less of it.
const float kLeastHistoryShare = 1.0f / 1024.0f;

struct AntilagConstants {
  float scoreLow;   // Score up to which history counts in full, standard errors.
  float scoreHigh;  // Score from which history does not count, standard errors.
};

#ifdef __cplusplus
static_assert(sizeof(AntilagConstants) == 8);
}  // namespace walr
#endif
#endif
