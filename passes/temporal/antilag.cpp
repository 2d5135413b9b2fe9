#include "passes/temporal/antilag.h"

#include <stdexcept>

#include "passes/stage/grid_extent.h"
#include "shaders/shaders.h"
#include "shaders/temporal/antilag.h"

namespace walr {

fg::Extent antilagTiles(fg::Extent pixels) {
  return gridExtent(pixels, static_cast<std::uint32_t>(kAntilagTile));
}

Antilag declareAntilag(StageGraph graph, fg::Extent pixels, fg::Texture steering, bool growsAtRest) {
  const fg::Extent tiles = antilagTiles(pixels);
  const fg::Texture sums = graph.texture("antilag.tiles", {VK_FORMAT_R32G32B32A32_SFLOAT, tiles});
  if (!steering.valid() && !growsAtRest) {
    return {graph.history("antilag.factor", {VK_FORMAT_R16G16_SFLOAT, tiles}), sums, steering, std::nullopt};
  }
  return {graph.history("antilag.factor", {VK_FORMAT_R16G16B16A16_SFLOAT, tiles}), sums, steering,
          graph.history("antilag.innovations", {VK_FORMAT_R32_SFLOAT, tiles})};
}

AntilagResult addAntilag(StageGraph graph, const Antilag& antilag, const AntilagSettings& settings,
                         const LongestHistory& longest, fg::Buffer frame) {
  if (!(settings.scoreLow < settings.scoreHigh)) {
    throw std::invalid_argument("setting accumulation.antilag-low must be below accumulation.antilag-high");
  }
  // Samples in the history of 7 x 7 tiles, about what a fine window spans.
  const float samples = longest.frames * static_cast<float>(49 * kAntilagTile * kAntilagTile);
  const AntilagConstants constants{settings.scoreLow, settings.scoreHigh, 1.0F / longest.frames, longest.restFactor,
                                   settings.fireflies > 0.0F ? samples / settings.fireflies : 0.0F};
  const bool steered = antilag.steering.valid(), changesLengths = antilag.innovations.has_value();
  const fg::Extent tiles = graph.textureDesc(antilag.tiles).extent;
  fg::PassBuilder pass =
      graph.compute("antilag", changesLengths ? shaders::antilagAtRest({.steered = steered}) : shaders::antilag);
  pass.sample("tiles", antilag.tiles)
      .sample("previous", antilag.factor.previous)
      .specialize("kRadius", settings.radius)
      .constants(constants)
      .dispatch(tiles);
  AntilagResult result{.factor = pass.store("outFactor", antilag.factor.current), .shortening = {}};
  if (!changesLengths) return result;
  pass.uniform("frameConstants", frame).sample("previousInnovations", antilag.innovations->previous);
  if (steered) pass.sample("steering", antilag.steering);
  static_cast<void>(pass.store("outInnovations", antilag.innovations->current));
  result.shortening =
      pass.store("outShortening", graph.texture("anti-aliasing shortening", {VK_FORMAT_R32_UINT, tiles}));
  return result;
}

}  // namespace walr
