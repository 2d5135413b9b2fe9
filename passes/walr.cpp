#include "passes/walr.h"

#include <algorithm>
#include <cmath>

namespace walr {
namespace {

/// Number of iterations whose window, 3^n samples of `size` pixels, comes nearest to a tenth of the image's height: the
/// paper's window at 1080 lines blurs contact shadows away at 216.
std::uint32_t iterationsFor(std::uint32_t height, std::uint32_t size) {
  const long wanted = std::lround(std::log(height / (10.0 * size)) / std::log(3.0));
  return static_cast<std::uint32_t>(std::max(wanted, 1L));
}

fg::Texture addPixelFilter(fg::Graph& graph, fg::Buffer frame, fg::Texture accumulated, const Guides& guides,
                           const WalrSettings& settings) {
  WeightedRegressionSettings regression = settings.regression;
  const std::uint32_t height = graph.textureDesc(accumulated).extent.height;
  if (settings.fitWindow) regression.iterations = std::min(regression.iterations, iterationsFor(height, 1));
  return addWeightedRegression(graph, frame, accumulated, guides, regression);
}

fg::Texture addBlockFilter(fg::Graph& graph, fg::Buffer frame, fg::Texture accumulated, const Guides& guides,
                           const WalrSettings& settings) {
  BlockRegressionSettings blocks = settings.blocks;
  const std::uint32_t height = graph.textureDesc(accumulated).extent.height;
  if (settings.fitWindow) {
    if (height < 720) blocks.size = std::min(blocks.size, 2U);
    blocks.iterations = std::min(blocks.iterations, iterationsFor(height, blocks.size));
  }
  const fg::Texture occlusion = addAmbientOcclusion(graph, frame, guides, settings.occlusion);
  return addBlockRegression(graph, frame, accumulated, guides, occlusion, blocks);
}

}  // namespace

WalrSettings robustWalr() {
  return {};
}

WalrSettings paperWalr() {
  WalrSettings settings;
  settings.accumulation.historyFilter = HistoryFilter::Bicubic;
  settings.accumulation.dilateMotion = true;
  settings.fitWindow = false;
  settings.regression.planeNormal = PlaneNormal::Shading;
  settings.regression.normalFactor = false;
  settings.regression.storage = MomentStorage::Raw16;
  settings.regression.keepSampleCount = false;
  settings.regression.regularisation = Regularisation::Floor;
  settings.regression.ridge = 2e-3F;
  settings.antialiasing.dilateMotion = true;
  settings.antialiasing.planeTolerance = 1.0F;
  settings.antialiasing.normalThreshold = -1.0F;
  return settings;
}

WalrSettings fastWalr() {
  WalrSettings settings;
  settings.filter = SpatialFilter::Blocks;
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
