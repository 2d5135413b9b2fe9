#include "passes/walr.h"

#include <algorithm>

#include "passes/window_fit.h"

namespace walr {
namespace {

fg::Texture addPixelFilter(fg::Graph& graph, fg::Buffer frame, fg::Texture accumulated, const Guides& guides,
                           const WalrSettings& settings) {
  WeightedRegressionSettings regression = settings.regression;
  const std::uint32_t height = graph.textureDesc(accumulated).extent.height;
  if (settings.fitWindow) regression.iterations = std::min(regression.iterations, fittingIterations(height));
  return addWeightedRegression(graph, frame, accumulated, guides, regression);
}

fg::Texture addBlockFilter(fg::Graph& graph, fg::Buffer frame, fg::Texture accumulated, const Guides& guides,
                           const WalrSettings& settings) {
  BlockRegressionSettings blocks = settings.blocks;
  const std::uint32_t height = graph.textureDesc(accumulated).extent.height;
  if (settings.fitWindow) {
    if (height < 720) blocks.size = std::min(blocks.size, 2U);
    blocks.iterations = std::min(blocks.iterations, fittingIterations(height, blocks.size));
  }
  const fg::Texture occlusion = addAmbientOcclusion(graph, frame, guides, settings.occlusion);
  return addBlockRegression(graph, frame, accumulated, guides, occlusion, blocks);
}

}  // namespace

WalrSettings blocksWalr() {
  return {};
}

WalrSettings robustWalr() {
  WalrSettings settings;
  settings.filter = SpatialFilter::Pixels;
  return settings;
}

WalrSettings paperWalr() {
  WalrSettings settings = robustWalr();
  settings.accumulation.historyFilter = HistoryFilter::Bicubic;
  settings.accumulation.dilateMotion = true;
  settings.fitWindow = false;
  settings.regression.edgeStopping.planeNormal = PlaneNormal::Shading;
  settings.regression.edgeStopping.normalFactor = false;
  settings.regression.repeatCentre = true;
  settings.regression.edgeLeak = 0.0F;
  settings.regression.storage = MomentStorage::Raw16;
  settings.regression.keepSampleCount = false;
  settings.regression.regularisation.method = Regularisation::Floor;
  settings.regression.regularisation.ridge = 2e-3F;
  settings.antialiasing.dilateMotion = true;
  settings.antialiasing.planeTolerance = 1.0F;
  settings.antialiasing.normalThreshold = -1.0F;
  return settings;
}

fg::Texture addWalr(fg::Graph& graph, const DenoiserInputs& inputs, fg::Texture output, const WalrSettings& settings) {
  const Guides guides = addPrepareGuides(graph, inputs, settings.guides);
  const fg::Texture accumulated = addTemporalAccumulation(graph, inputs, guides, settings.accumulation);
  const fg::Texture filtered = settings.filter == SpatialFilter::Pixels
                                   ? addPixelFilter(graph, inputs.frame, accumulated, guides, settings)
                                   : addBlockFilter(graph, inputs.frame, accumulated, guides, settings);
  return addTemporalAntialiasing(graph, inputs, guides, filtered, output, settings.antialiasing);
}

}  // namespace walr
