#pragma once

#include <cstdint>

#include "framegraph/declare/graph.h"

namespace walr {

/// The picture's tiles of 8 x 8 pixels by what the regression over blocks has to do in them, for indirect dispatches: a
/// frame's work then goes by what it shows. What a list serves has shaders with `LISTED_TILES`.
struct TileLists {
  fg::Buffer words;         ///< `kTileLists` lists: group counts, number of tiles, then a word for each.
  std::uint64_t tiles = 0;  ///< Of the picture: each list has room for all.
};

/// Sort the tiles of a picture.
/// @param pixels     size of the picture
/// @param fitDepth   R32_UINT, a texel a block: depth, 0 without a surface, and whether its fit holds paths enough
///                   (block_storage.glsl)
/// @param blockSize  pixels per axis of a block
TileLists addTileLists(fg::Graph& graph, fg::Extent pixels, fg::Texture fitDepth, std::uint32_t blockSize);

/// Have a pass whose shader has `LISTED_TILES` work on the tiles of a list.
/// @param list  `kTilesGrowing`, `kTilesConverged` or `kTilesOfSky` (shaders/constants/tiles.h)
void dispatchTiles(fg::PassBuilder& pass, const TileLists& lists, std::uint32_t list);

}  // namespace walr
