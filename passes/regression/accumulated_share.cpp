#include "passes/regression/accumulated_share.h"

#include "passes/conventions/light_storage.h"
#include "passes/stage/grid_extent.h"
#include "passes/temporal/antilag.h"
#include "shaders/regression/accumulated_share.h"
#include "shaders/shaders.h"
#include "shaders/temporal/temporal_accumulation.h"

namespace walr {
namespace {

/// Share below which a tile is quiet, in units of the least share that counts.
constexpr float kQuietShare = 0.75F;
/// Statistics of quiet tiles, of which few are measured in a frame, fade so many times slower.
constexpr float kQuietMemory = 2.0F;

}  // namespace

SteeredHistory declareSteeredHistory(StageGraph graph, fg::Extent pixels, float maxHistory) {
  return {graph.history("steered history", {VK_FORMAT_R32G32_SFLOAT, antilagTiles(pixels)}), maxHistory};
}

void addAccumulatedShare(StageGraph graph, fg::PassBuilder& apply, const AccumulatedShareInputs& inputs,
                         const AccumulatedShareSettings& settings) {
  const fg::Extent pixels = graph->textureDesc(inputs.accumulated).extent;
  const bool packed = lightStorageOf(graph->textureDesc(inputs.accumulated).format) == LightStorage::Packed;
  // Beside the statistics of a tile's other pixels stand those of its pixels beside an edge.
  const fg::Extent twice = {2 * inputs.tiles.width, inputs.tiles.height};
  // Named by the size of tiles, because the history of another size is of other places.
  const std::string ofTiles = " of " + std::to_string(inputs.tileSize) + " x " + std::to_string(inputs.tileSize);
  const fg::History statistics =
      graph->history("residual statistics" + ofTiles, {VK_FORMAT_R16G16B16A16_SFLOAT, twice});
  const fg::History agreement =
      graph->history("residual agreement" + ofTiles, {VK_FORMAT_R16G16B16A16_SFLOAT, inputs.tiles});
  // Without a history that somebody steers, history may be as long as packed light can count.
  const SteeredHistory history =
      inputs.history ? *inputs.history : declareSteeredHistory(graph, pixels, kMostAccumulatedSamples);

  apply.specialize("kPackedMean", packed)
      .sampleIf(packed, "accumulatedPacked", inputs.accumulated, inputs.guides.depth)
      .sampleIf(!packed, "accumulatedHalf", inputs.accumulated, inputs.lighting)
      .sample("lighting", inputs.lighting)
      .specialize("kAntilag", inputs.antilag.valid())
      .sampleIf(inputs.antilag.valid(), "antilag", inputs.antilag, inputs.lighting)
      .sample("previousStatistics", statistics.previous)
      .sample("previousAgreement", agreement.previous);
  const fg::History innovation = graph->history("innovation", {VK_FORMAT_R8_UINT, gridExtent(pixels, 2)});
  apply.sample("previousInnovation", innovation.previous);
  static_cast<void>(apply.store("outInnovation", innovation.current));
  const fg::Texture sums =
      apply.store("outResidualSums", graph->texture("residual sums", {VK_FORMAT_R32G32B32A32_SFLOAT, twice}));
  const fg::Texture innovationSums = apply.store(
      "outInnovationSums", graph->texture("innovation sums", {VK_FORMAT_R32G32B32A32_SFLOAT, inputs.tiles}));

  // Noise alone gives the slope -1 / (2 N) (residual_statistics.comp).
  const float bias = 0.5F * settings.innovationBias / history.maxHistory;
  fg::PassBuilder pass = graph->compute("residual statistics", shaders::residualStatistics);
  pass.uniform("frameConstants", inputs.frame)
      .sample("fitDepth", inputs.blockDepth)
      .sample("sums", sums)
      .sample("innovationSums", innovationSums)
      .sample("previousStatistics", statistics.previous)
      .sample("previousAgreement", agreement.previous)
      .sample("previousSteering", history.limits.previous)
      .specialize("kTileSize", inputs.tileSize)
      .specialize("kRadius", settings.radius)
      .specialize("kBlockSize", inputs.blockSize)
      .constants(ResidualStatisticsConstants{.tileOffset = static_cast<std::int32_t>(inputs.tileOffset),
                                             .kept = 1.0F - 1.0F / settings.frames,
                                             .keptQuiet = 1.0F - 1.0F / (kQuietMemory * settings.frames),
                                             .maxHistory = history.maxHistory,
                                             .innovationGain = settings.innovationGain,
                                             .innovationBias = bias,
                                             .residualGain = settings.gain,
                                             .residualEdgeGain = settings.edgeGain,
                                             .quietShare = kQuietShare * settings.leastShare,
                                             .antialiasingShare = settings.antialiasingShare})
      // A tile of antilag is no smaller than one of the reconstruction, so that there are no more of them.
      .dispatch(inputs.tiles);
  static_cast<void>(pass.store("outStatistics", statistics.current));
  static_cast<void>(pass.store("outAgreement", agreement.current));
  static_cast<void>(pass.store("outSteering", history.limits.current));
}

}  // namespace walr
