#include "passes/light_change.h"

#include <stdexcept>

#include "passes/grid_extent.h"
#include "shaders/constants/light_change.h"
#include "shaders/shaders.h"

namespace walr {

LightChange declareLightChange(fg::Graph& graph, fg::Extent pixels) {
  constexpr auto kTile = static_cast<std::uint32_t>(kLightChangeTile);
  const fg::Extent tiles = gridExtent(pixels, kTile);
  return {graph.history("light change.doubt", {VK_FORMAT_R32_SFLOAT, tiles}),
          graph.texture("light change.tiles", {VK_FORMAT_R32G32_SFLOAT, tiles})};
}

void addLightChange(fg::Graph& graph, const LightChange& change, const LightChangeSettings& settings) {
  if (!(settings.scoreLow < settings.scoreHigh)) {
    throw std::invalid_argument("setting accumulation.change-low must be below accumulation.change-high");
  }
  const LightChangeConstants constants{static_cast<std::int32_t>(settings.radius), settings.scoreLow,
                                       settings.scoreHigh};
  fg::PassBuilder pass = graph.compute("light change", shaders::lightChange);
  pass.sample("tiles", change.tiles).constants(constants).dispatch(graph.textureDesc(change.tiles).extent);
  static_cast<void>(pass.store("outDoubt", change.doubt.current));
}

}  // namespace walr
