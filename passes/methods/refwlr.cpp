#include "passes/methods/refwlr.h"

#include <algorithm>

#include "passes/methods/walr_paper.h"
#include "passes/regression/window_fit.h"
#include "passes/temporal/temporal_stages.h"

namespace walr {
namespace {

/// REFWLR with the settings that it shares with walr_paper.
RefwlrSettings likeWalr(const WalrPaperSettings& walr) {
  RefwlrSettings settings;
  settings.guides = walr.guides;
  settings.accumulation = walr.accumulation;
  settings.regression.edgeStopping = walr.regression.edgeStopping;
  settings.regression.regularisation = walr.regression.regularisation;
  settings.antialiasing = walr.antialiasing;
  settings.fitWindow = walr.fitWindow;
  return settings;
}

}  // namespace

RefwlrSettings robustRefwlr() {
  return likeWalr(robustWalr());
}

RefwlrSettings paperRefwlr() {
  return likeWalr(paperWalr());
}

fg::Texture addRefwlr(StageGraph graph, const DenoiserInputs& inputs, fg::Texture output,
                      const RefwlrSettings& settings) {
  FullWindowSettings regression = settings.regression;
  const std::uint32_t height = graph->textureDesc(inputs.lighting).extent.height;
  if (settings.fitWindow) regression.window = std::min(regression.window, fittingWindow(height));

  const TemporalPlan plan =
      planTemporalStages(inputs, {.accumulation = settings.accumulation, .antialiasing = settings.antialiasing});
  const Guides guides = addPrepareGuides(graph, inputs, settings.guides, {});
  const Accumulated accumulated = addAccumulation(graph, inputs, guides, plan);
  const fg::Texture filtered = addFullWindowRegression(graph, inputs.frame, accumulated.lighting, guides,
                                                       filterTarget(graph, plan, output), regression);
  return addAntialiasing(graph, inputs, guides, plan, accumulated, filtered, output);
}

}  // namespace walr
