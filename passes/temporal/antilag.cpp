#include "passes/temporal/antilag.h"

#include <stdexcept>

#include "passes/stage/grid_extent.h"
#include "shaders/shaders.h"
#include "shaders/temporal/antilag.h"

namespace walr {

fg::Extent antilagTiles(fg::Extent pixels) {
  return gridExtent(pixels, static_cast<std::uint32_t>(kAntilagTile));
}

Antilag declareAntilag(StageGraph graph, fg::Extent pixels, fg::Texture least) {
  const fg::Extent tiles = antilagTiles(pixels);
  return {graph.history("antilag.factor", {VK_FORMAT_R16G16_SFLOAT, tiles}),
          graph.texture("antilag.tiles", {VK_FORMAT_R32G32B32A32_SFLOAT, tiles}), least};
}

fg::Texture addAntilag(StageGraph graph, const Antilag& antilag, const AntilagSettings& settings, float maxHistory) {
  if (!(settings.scoreLow < settings.scoreHigh)) {
    throw std::invalid_argument("setting accumulation.antilag-low must be below accumulation.antilag-high");
  }
  // Samples in the history of 7 x 7 tiles, about what a fine window spans.
  const float samples = maxHistory * static_cast<float>(49 * kAntilagTile * kAntilagTile);
  const AntilagConstants constants{settings.scoreLow, settings.scoreHigh,
                                   settings.fireflies > 0.0F ? samples / settings.fireflies : 0.0F};
  fg::PassBuilder pass = graph.compute("antilag", shaders::antilag);
  pass.sample("tiles", antilag.tiles)
      .specialize("kHasLeast", antilag.least.valid())
      .sampleIf(antilag.least.valid(), "least", antilag.least, antilag.tiles)
      .sample("previous", antilag.factor.previous)
      .specialize("kRadius", settings.radius)
      .constants(constants)
      .dispatch(graph.textureDesc(antilag.tiles).extent);
  return pass.store("outFactor", antilag.factor.current);
}

}  // namespace walr
