#include "passes/walr.h"

#include <algorithm>

#include "passes/temporal_stages.h"
#include "passes/window_fit.h"

namespace walr {
namespace {

fg::Texture addPixelFilter(fg::Graph& graph, fg::Buffer frame, const FilterInput& input, const Guides& guides,
                           const WalrSettings& settings, Inspection* inspection) {
  WeightedRegressionSettings regression = settings.regression;
  const std::uint32_t height = graph.textureDesc(input.lighting).extent.height;
  if (settings.fitWindow) regression.iterations = std::min(regression.iterations, fittingIterations(height));
  return addWeightedRegression(graph, frame, input.lighting, input.alpha, guides, input.target(graph, "filtered"),
                               regression, inspection);
}

fg::Texture addBlockFilter(fg::Graph& graph, const DenoiserInputs& inputs, const FilterInput& input,
                           const Guides& guides, const WalrSettings& settings, Inspection* inspection) {
  BlockRegressionSettings blocks = settings.blocks;
  const std::uint32_t height = graph.textureDesc(input.lighting).extent.height;
  // Growth stops at light that differs, so that no picture is too small for a window of enough samples.
  constexpr std::uint32_t kLeastIterations = 2;
  if (settings.fitWindow) {
    blocks.size = std::min(blocks.size, fittingBlockSize(height));
    const std::uint32_t fitting = std::max(fittingIterations(height, blocks.size), kLeastIterations);
    blocks.iterations = std::min(blocks.iterations, fitting);
  }
  const BlockLight light{
      .accumulated = input.lighting, .alpha = input.alpha, .lighting = inputs.lighting, .result = input.result};
  return addBlockRegression(graph, inputs.frame, light, guides, blocks, inspection);
}

}  // namespace

WalrSettings blocksWalr() {
  return {};
}

WalrSettings robustWalr() {
  WalrSettings settings;
  settings.filter = SpatialFilter::Pixels;
  settings.accumulation = {};
  settings.antialiasing = {};
  return settings;
}

WalrSettings paperWalr() {
  WalrSettings settings = robustWalr();
  settings.accumulation.historyFilter = HistoryFilter::Bicubic;
  settings.accumulation.dilateMotion = true;
  settings.accumulation.rejection = HistoryRejection::Depth;
  settings.guides.albedoThreshold = 0.0F;
  settings.fitWindow = false;
  settings.regression.edgeStopping.planeNormal = PlaneNormal::Shading;
  settings.regression.edgeStopping.normalFactor = false;
  settings.regression.repeatCentre = true;
  settings.regression.edgeLeak = 0.0F;
  settings.regression.storage = MomentStorage::Raw16;
  settings.regression.keepSampleCount = false;
  settings.regression.regularisation.method = Regularisation::Floor;
  settings.regression.regularisation.ridge = 2e-3F;
  settings.antialiasing.maxSamples = 8.0F;
  settings.antialiasing.dilateMotion = true;
  settings.antialiasing.rejection = HistoryRejection::None;
  return settings;
}

fg::Texture addWalr(fg::Graph& graph, const DenoiserInputs& inputs, fg::Texture output, const WalrSettings& settings,
                    Inspection* inspection) {
  TemporalStages stages{.accumulation = settings.accumulation,
                        .antialiasing = settings.antialiasing,
                        .spatialOnly = settings.spatialOnly};
  const bool pixels = settings.filter == SpatialFilter::Pixels;
  if (pixels) stages.accumulation.storage = stages.antialiasing.storage = LightStorage::Half;
  const bool geometricPlane = !pixels || settings.regression.edgeStopping.planeNormal == PlaneNormal::Geometric;
  GuideNeeds needs = guideNeeds(stages, inputs.scene, geometricPlane);
  if (!pixels) needs.occlusion = settings.occlusion;
  const Guides guides = addPrepareGuides(graph, inputs, settings.guides, needs, inspection);
  const auto filter = [&](const FilterInput& input) {
    return pixels ? addPixelFilter(graph, inputs.frame, input, guides, settings, inspection)
                  : addBlockFilter(graph, inputs, input, guides, settings, inspection);
  };
  return addTemporalStages(graph, inputs, guides, output, stages, filter, inspection);
}

}  // namespace walr
