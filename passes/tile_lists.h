#pragma once

#include "framegraph/graph.h"

namespace walr {

/// The picture's tiles of 8 x 8 pixels by what they show, in the order of the picture, for indirect dispatches: a
/// frame's work then goes by how much of it shows a surface. What a list serves has shaders with `LISTED_TILES`.
struct TileLists {
  fg::Buffer surfaces;  ///< Tiles with some surface: group counts, number of tiles, then a word for each.
  fg::Buffer sky;       ///< The others.
};

/// Sort the tiles of a picture.
/// @param depth  as of `Guides`
TileLists addTileLists(fg::Graph& graph, fg::Texture depth);

/// Have a pass whose shader has `LISTED_TILES` work on the tiles of a list.
void dispatchTiles(fg::PassBuilder& pass, fg::Buffer list);

}  // namespace walr
