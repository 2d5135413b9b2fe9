#include "passes/methods/walr_paper.h"

#include <algorithm>

#include "passes/regression/window_fit.h"
#include "passes/temporal/temporal_stages.h"

namespace walr {
namespace {

WeightedRegressionSettings fittedRegression(const WalrPaperSettings& settings, std::uint32_t height) {
  WeightedRegressionSettings regression = settings.regression;
  if (settings.fitWindow) regression.iterations = std::min(regression.iterations, fittingIterations(height));
  return regression;
}

}  // namespace

WalrPaperSettings paperWalr() {
  return {};
}

WalrPaperSettings robustWalr() {
  return {.guides = {}, .accumulation = {}, .regression = {}, .fitWindow = true, .antialiasing = {}};
}

fg::Texture addWalrPaper(StageGraph graph, const DenoiserInputs& inputs, fg::Texture output,
                         const WalrPaperSettings& settings) {
  const TemporalPlan plan = planTemporalStages(inputs, {.accumulation = settings.accumulation,
                                                        .antialiasing = settings.antialiasing,
                                                        .spatialOnly = settings.spatialOnly});
  GuideNeeds needs = plan.guides;
  if (settings.regression.edgeStopping.planeNormal == PlaneNormal::Geometric) needs.geometricNormal = true;
  const Guides guides = addPrepareGuides(graph, inputs, settings.guides, needs);
  const Accumulated accumulated = addAccumulation(graph, inputs, guides, plan);
  const WeightedRegressionSettings regression = fittedRegression(settings, inputs.extent(graph).height);
  const fg::Texture filtered = addWeightedRegression(graph, inputs.frame, accumulated.lighting, accumulated.alpha,
                                                     guides, filterTarget(graph, plan, output), regression);
  return addAntialiasing(graph, inputs, guides, plan, accumulated, filtered, output);
}

}  // namespace walr
