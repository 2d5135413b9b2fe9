#include "passes/tile_lists.h"

#include <cstdint>

#include "passes/grid_extent.h"
#include "shaders/constants/tiles.h"
#include "shaders/shaders.h"

namespace walr {

TileLists addTileLists(fg::Graph& graph, fg::Texture depth) {
  constexpr auto kSide = static_cast<std::uint32_t>(kTileSide);
  const fg::Extent pixels = graph.textureDesc(depth).extent;
  const fg::Extent tiles = gridExtent(pixels, kSide);

  fg::PassBuilder find = graph.compute("surface tiles", shaders::surfaceTiles);
  find.sample("depth", depth).dispatch(pixels);
  const fg::Texture found = find.store("outTiles", graph.texture("surface tiles", {VK_FORMAT_R32_UINT, tiles}));

  const std::uint64_t words = kTileListHeader + static_cast<std::uint64_t>(tiles.width) * tiles.height;
  fg::PassBuilder list = graph.compute("tile lists", shaders::listTiles);
  list.sample("tiles", found).dispatch({1, 1});
  return {list.store("outSurfaces", graph.buffer("tiles with surfaces", {words * sizeof(std::uint32_t)})),
          list.store("outSky", graph.buffer("tiles of sky", {words * sizeof(std::uint32_t)}))};
}

void dispatchTiles(fg::PassBuilder& pass, fg::Buffer list) {
  pass.load("tileList", list).dispatchIndirect(list);
}

}  // namespace walr
