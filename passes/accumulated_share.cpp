#include "passes/accumulated_share.h"

#include <string>

#include "passes/antilag.h"
#include "passes/light_storage.h"
#include "shaders/constants/accumulated_share.h"
#include "shaders/shaders.h"

namespace walr {

SteeredHistory declareSteeredHistory(StageGraph graph, fg::Extent pixels, float maxHistory) {
  return {graph.history("least antilag factor", {VK_FORMAT_R32_SFLOAT, antilagTiles(pixels)}), maxHistory};
}

void addAccumulatedShare(StageGraph graph, fg::PassBuilder& apply, const AccumulatedShareInputs& inputs,
                         const AccumulatedShareSettings& settings) {
  const fg::Extent pixels = graph->textureDesc(inputs.accumulated).extent;
  const bool packed = lightStorageOf(graph->textureDesc(inputs.accumulated).format) == LightStorage::Packed;
  const fg::TextureDesc ofTiles{VK_FORMAT_R32G32B32A32_SFLOAT, inputs.tiles};
  const auto storeSums = [&](const std::string& binding, const std::string& name) {
    return apply.store(binding, graph->texture(name, ofTiles));
  };
  const fg::History statistics = graph->history("residual statistics", ofTiles);
  const fg::History edges = graph->history("residual statistics at edges", ofTiles);
  const fg::History agreement = graph->history("residual agreement", ofTiles);
  const fg::History innovation = graph->history("innovation", {VK_FORMAT_R16_SFLOAT, pixels});
  const SteeredHistory history =
      inputs.history ? *inputs.history : declareSteeredHistory(graph, pixels, 1.0F);  // Nobody reads it.

  apply.specialize("kPackedMean", packed)
      .sampleIf(packed, "accumulatedPacked", inputs.accumulated, inputs.guides.depth)
      .sampleIf(!packed, "accumulatedHalf", inputs.accumulated, inputs.lighting)
      .sample("lighting", inputs.lighting)
      .sample("previousStatistics", statistics.previous)
      .sample("previousEdgeStatistics", edges.previous)
      .sample("previousAgreement", agreement.previous)
      .sample("previousInnovation", innovation.previous);
  static_cast<void>(apply.store("outInnovation", innovation.current));
  const fg::Texture sums = storeSums("outResidualSums", "residual sums");
  const fg::Texture edgeSums = storeSums("outEdgeSums", "residual sums at edges");
  const fg::Texture innovationSums = storeSums("outInnovationSums", "innovation sums");

  // Noise alone gives the slope -1 / (2 N) (residual_statistics.comp).
  const float bias = 0.5F * settings.innovationBias / history.maxHistory;
  fg::PassBuilder pass = graph->compute("residual statistics", shaders::residualStatistics);
  pass.uniform("frameConstants", inputs.frame)
      .sample("depth", inputs.guides.depth)
      .sample("sums", sums)
      .sample("edgeSums", edgeSums)
      .sample("innovationSums", innovationSums)
      .sample("previousStatistics", statistics.previous)
      .sample("previousEdgeStatistics", edges.previous)
      .sample("previousAgreement", agreement.previous)
      .sample("previousLeastAntilag", history.leastAntilag.previous)
      .constants(ResidualStatisticsConstants{static_cast<std::int32_t>(inputs.tileSize),
                                             static_cast<std::int32_t>(inputs.tileOffset),
                                             static_cast<std::int32_t>(settings.radius), 1.0F - 1.0F / settings.frames,
                                             history.maxHistory, settings.innovationGain, bias})
      // A tile of antilag is no smaller than one of the reconstruction, so that there are no more of them.
      .dispatch(inputs.tiles);
  static_cast<void>(pass.store("outStatistics", statistics.current));
  static_cast<void>(pass.store("outEdgeStatistics", edges.current));
  static_cast<void>(pass.store("outAgreement", agreement.current));
  static_cast<void>(pass.store("outLeastAntilag", history.leastAntilag.current));
}

}  // namespace walr
