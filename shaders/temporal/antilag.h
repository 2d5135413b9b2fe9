#ifndef WALR_SHADERS_TEMPORAL_ANTILAG_H
#define WALR_SHADERS_TEMPORAL_ANTILAG_H
#include "../common/types.h"
#ifdef __cplusplus
namespace walr {
#endif

const int kAntilagTile = 8;  // Pixels per axis: a workgroup of temporal accumulation.
// Share of the longest history below which history does not count: rounding of bilinear weights leaves less of it.
const float kLeastHistoryShare = 1.0f / 1024.0f;

// Pixels of a tile that have this frame's light among them from which it is no firefly: more than a pair.
const float kFireflyWitnesses = 3.0f;
// From this brightness on, in units of the brightest that passes whole, a sample is left with the less the brighter it
// is: at default settings the squares have room for fewer than four of its kind.
const float kFireflyRoom = 2.0f;

struct AntilagConstants {
  float scoreLow;    // Score up to which history counts in full, standard errors.
  float scoreHigh;   // Score from which history does not count, standard errors.
  float oneFrame;    // Over the longest history. Read where history may be longer at rest only.
  float restFactor;  // At rest, history is at most so many times as long. Read where innovations of tiles tell it only.
  float mostSquare;  // Square of the brightest sample, in units of the mean square of those around it; 0: no bound.
};

#ifdef __cplusplus
static_assert(sizeof(AntilagConstants) == 20);
}  // namespace walr
#endif
#endif
