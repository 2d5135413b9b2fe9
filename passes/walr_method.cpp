#include "passes/walr_method.h"

#include <algorithm>
#include <optional>

#include "passes/temporal_stages.h"
#include "passes/window_fit.h"

namespace walr {
namespace {

BlockRegressionSettings fittedBlocks(const WalrSettings& settings, std::uint32_t height) {
  BlockRegressionSettings blocks = settings.blocks;
  if (!settings.fitWindow) return blocks;
  // Growth ends a window where the light differs, so that even small images can have wide windows.
  constexpr std::uint32_t kLeastIterations = 2;
  blocks.size = std::min(blocks.size, fittingBlockSize(height));
  const std::uint32_t fitting = std::max(fittingIterations(height, blocks.size), kLeastIterations);
  blocks.iterations = std::min(blocks.iterations, fitting);
  return blocks;
}

}  // namespace

fg::Texture addWalr(StageGraph graph, const DenoiserInputs& inputs, fg::Texture output, const WalrSettings& settings) {
  TemporalPlan plan = planTemporalStages(inputs, {.accumulation = settings.accumulation,
                                                  .antialiasing = settings.antialiasing,
                                                  .spatialOnly = settings.spatialOnly});
  const BlockRegressionSettings blocks = fittedBlocks(settings, graph->textureDesc(inputs.lighting).extent.height);
  std::optional<SteeredHistory> history;
  if (blocks.share.enabled && plan.accumulates && settings.accumulation.antilag.enabled) {
    history =
        declareSteeredHistory(graph, graph->textureDesc(inputs.lighting).extent, settings.accumulation.maxHistory);
    plan.leastAntilag = history->leastAntilag.previous;
  }
  GuideNeeds needs = plan.guides;
  needs.geometricNormal = true;
  needs.occlusion = settings.occlusion;
  const auto [guides, accumulated] = addGuidesWithAccumulation(graph, inputs, settings.guides, needs, plan);
  const BlockLight light{.accumulated = accumulated.lighting,
                         .alpha = accumulated.alpha,
                         .lighting = inputs.lighting,
                         .history = history,
                         .result = plan.filtered};
  const BlockFits fits = addBlockRegression(graph, inputs.frame, light, guides, blocks);
  const fg::Texture filtered = addBlockReconstruction(graph, inputs.frame, light, guides, fits, blocks);
  return addAntialiasing(graph, inputs, guides, plan, accumulated, filtered, output);
}

WalrSettings manySamplesWalr() {
  WalrSettings settings;
  settings.blocks.share.enabled = true;
  settings.antialiasing.maxHistory = 2.0F;
  return settings;
}

}  // namespace walr
