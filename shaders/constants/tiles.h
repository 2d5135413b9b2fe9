#ifndef WALR_SHADERS_CONSTANTS_TILES_H
#define WALR_SHADERS_CONSTANTS_TILES_H
#include "types.h"
#ifdef __cplusplus
namespace walr {
#endif

const int kTileSide = 8;           // Pixels per axis: a workgroup of the passes that lists serve.
const uint kTileListHeader = 4;    // Words before the tiles of a list: the group counts and the number of tiles.
const uint kTileListColumns = 256; // Workgroups a row: no device need take more than 65535 in one dimension.

#ifdef __cplusplus
}  // namespace walr
#endif
#endif
