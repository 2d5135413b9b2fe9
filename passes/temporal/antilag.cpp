#include "passes/temporal/antilag.h"

#include <stdexcept>

#include "passes/stage/grid_extent.h"
#include "shaders/shaders.h"
#include "shaders/temporal/antilag.h"

namespace walr {

fg::Extent antilagTiles(fg::Extent pixels) {
  return gridExtent(pixels, static_cast<std::uint32_t>(kAntilagTile));
}

Antilag declareAntilag(StageGraph graph, fg::Extent pixels, fg::Texture steering) {
  const fg::Extent tiles = antilagTiles(pixels);
  return {graph.history("antilag.factor", {VK_FORMAT_R16G16_SFLOAT, tiles}),
          graph.texture("antilag.tiles", {VK_FORMAT_R32G32B32A32_SFLOAT, tiles}), steering};
}

AntilagResult addAntilag(StageGraph graph, const Antilag& antilag, const AntilagSettings& settings, float maxHistory) {
  if (!(settings.scoreLow < settings.scoreHigh)) {
    throw std::invalid_argument("setting accumulation.antilag-low must be below accumulation.antilag-high");
  }
  // Samples in the history of 7 x 7 tiles, about what a fine window spans.
  const float samples = maxHistory * static_cast<float>(49 * kAntilagTile * kAntilagTile);
  const AntilagConstants constants{settings.scoreLow, settings.scoreHigh, 1.0F / maxHistory,
                                   settings.fireflies > 0.0F ? samples / settings.fireflies : 0.0F};
  const bool steered = antilag.steering.valid();
  const fg::Extent tiles = graph.textureDesc(antilag.tiles).extent;
  fg::PassBuilder pass = graph.compute("antilag", shaders::antilag({.steered = steered}));
  pass.sample("tiles", antilag.tiles)
      .sample("previous", antilag.factor.previous)
      .specialize("kRadius", settings.radius)
      .constants(constants)
      .dispatch(tiles);
  AntilagResult result{.factor = pass.store("outFactor", antilag.factor.current), .shortening = {}};
  if (!steered) return result;
  pass.sample("steering", antilag.steering);
  result.shortening =
      pass.store("outShortening", graph.texture("anti-aliasing shortening", {VK_FORMAT_R32_UINT, tiles}));
  return result;
}

}  // namespace walr
