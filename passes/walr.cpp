#include "passes/walr.h"

#include <algorithm>
#include <cmath>

namespace walr {
namespace {

/// Number of iterations whose window, 3^n pixels, comes nearest to a tenth of the image's height: the paper's window at
/// 1080 lines blurs contact shadows away at 216.
std::uint32_t iterationsFor(std::uint32_t height) {
  const long wanted = std::lround(std::log(height / 10.0) / std::log(3.0));
  return static_cast<std::uint32_t>(std::max(wanted, 1L));
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

fg::Texture addWalr(fg::Graph& graph, const DenoiserInputs& inputs, fg::Texture output, const WalrSettings& settings) {
  WeightedRegressionSettings regression = settings.regression;
  const std::uint32_t height = graph.textureDesc(inputs.lighting).extent.height;
  if (settings.fitWindow) regression.iterations = std::min(regression.iterations, iterationsFor(height));

  const Guides guides = addPrepareGuides(graph, inputs, settings.guides);
  const fg::Texture accumulated = addTemporalAccumulation(graph, inputs, guides, settings.accumulation);
  const fg::Texture filtered = addWeightedRegression(graph, inputs.frame, accumulated, guides, regression);
  return addTemporalAntialiasing(graph, inputs, guides, filtered, output, settings.antialiasing);
}

}  // namespace walr
