#include "passes/walr_method.h"

#include <algorithm>

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
  const TemporalPlan plan = planTemporalStages(inputs, {.accumulation = settings.accumulation,
                                                        .antialiasing = settings.antialiasing,
                                                        .spatialOnly = settings.spatialOnly});
  GuideNeeds needs = plan.guides;
  needs.geometricNormal = true;
  needs.occlusion = settings.occlusion;
  const auto [guides, accumulated] = addGuidesWithAccumulation(graph, inputs, settings.guides, needs, plan);
  const BlockLight light{.accumulated = accumulated.lighting,
                         .alpha = accumulated.alpha,
                         .lighting = inputs.lighting,
                         .result = plan.filtered};
  const BlockRegressionSettings blocks = fittedBlocks(settings, graph->textureDesc(inputs.lighting).extent.height);
  const BlockFits fits = addBlockRegression(graph, inputs.frame, light, guides, blocks);
  const fg::Texture filtered = addBlockReconstruction(graph, inputs.frame, light, guides, fits, blocks);
  return addAntialiasing(graph, inputs, guides, plan, accumulated, filtered, output);
}

}  // namespace walr
