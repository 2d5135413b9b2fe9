#ifndef WALR_SHADERS_CONSTANTS_TILES_H
#define WALR_SHADERS_CONSTANTS_TILES_H
#include "types.h"
#ifdef __cplusplus
namespace walr {
#endif

const int kTileSide = 8;           // Pixels per axis: a workgroup of the passes that lists serve.
const uint kTileListHeader = 4;    // Words before the tiles of a list: the group counts and the number of tiles.
const uint kTileListColumns = 256; // Workgroups a row: no device need take more than 65535 in one dimension.

// The lists, in this order in one buffer.
const uint kTilesGrowing = 0;    // Whose pixels may want more than their blocks' fits.
const uint kTilesConverged = 1;  // Whose blocks hold paths enough.
const uint kTilesOfSky = 2;      // Without a surface.
const uint kTileLists = 3;

struct TileListConstants {
  uint columns;  // Tiles of the picture.
  uint rows;
};

#ifdef __cplusplus
static_assert(sizeof(TileListConstants) == 8);
}  // namespace walr
#endif
#endif
