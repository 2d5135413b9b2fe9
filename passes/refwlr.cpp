#include "passes/refwlr.h"

#include <algorithm>

#include "passes/temporal_stages.h"
#include "passes/walr.h"
#include "passes/window_fit.h"

namespace walr {
namespace {

/// With all that the two methods share.
RefwlrSettings likeWalr(const WalrSettings& walr) {
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

fg::Texture addRefwlr(fg::Graph& graph, const DenoiserInputs& inputs, fg::Texture output,
                      const RefwlrSettings& settings, Inspection* inspection) {
  FullWindowSettings regression = settings.regression;
  const std::uint32_t height = graph.textureDesc(inputs.lighting).extent.height;
  if (settings.fitWindow) regression.window = std::min(regression.window, fittingWindow(height));

  const TemporalStages stages{.accumulation = settings.accumulation, .antialiasing = settings.antialiasing};
  const Guides guides = addPrepareGuides(graph, inputs, settings.guides, {}, inspection);
  const auto filter = [&](const FilterInput& input) {
    return addFullWindowRegression(graph, inputs.frame, input.lighting, guides, input.target(graph, "filtered"),
                                   regression);
  };
  return addTemporalStages(graph, inputs, guides, output, stages, filter, inspection);
}

}  // namespace walr
