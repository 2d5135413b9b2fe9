#include "passes/tile_lists.h"

#include "passes/grid_extent.h"
#include "shaders/constants/tiles.h"
#include "shaders/shaders.h"

namespace walr {

TileLists addTileLists(fg::Graph& graph, fg::Extent pixels, fg::Texture fitDepth, std::uint32_t blockSize) {
  const fg::Extent tiles = gridExtent(pixels, static_cast<std::uint32_t>(kTileSide));
  const std::uint64_t count = static_cast<std::uint64_t>(tiles.width) * tiles.height;
  const TileListConstants constants{.columns = tiles.width, .rows = tiles.height};

  fg::PassBuilder clear = graph.compute("clear tile lists", shaders::listTilesClear);
  clear.constants(constants).dispatch({1, 1});
  const fg::Buffer empty = clear.store(
      "tileLists", graph.buffer("tile lists", {kTileLists * (kTileListHeader + count) * sizeof(std::uint32_t)}));

  fg::PassBuilder list = graph.compute("tile lists", shaders::listTiles);
  list.sample("fitDepth", fitDepth).specialize("kBlockSize", blockSize).constants(constants).dispatch(tiles);
  return {list.update("tileLists", empty), count};
}

void dispatchTiles(fg::PassBuilder& pass, const TileLists& lists, std::uint32_t list) {
  const std::uint64_t header = list * (kTileListHeader + lists.tiles);
  pass.load("tileLists", lists.words)
      .specialize("kTileListHeaderAt", static_cast<std::uint32_t>(header))
      .dispatchIndirect(lists.words, header * sizeof(std::uint32_t));
}

}  // namespace walr
