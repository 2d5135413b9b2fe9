#include "passes/walr.h"

namespace walr {

WalrSettings robustWalr() {
  return {};
}

WalrSettings paperWalr() {
  WalrSettings settings;
  settings.accumulation.historyFilter = HistoryFilter::Bicubic;
  settings.accumulation.dilateMotion = true;
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
  const Guides guides = addPrepareGuides(graph, inputs, settings.guides);
  const fg::Texture accumulated = addTemporalAccumulation(graph, inputs, guides, settings.accumulation);
  const fg::Texture filtered = addWeightedRegression(graph, inputs.frame, accumulated, guides, settings.regression);
  return addTemporalAntialiasing(graph, inputs, guides, filtered, output, settings.antialiasing);
}

}  // namespace walr
