#include "passes/methods/walr_method.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "passes/filters/lobe_filter.h"
#include "passes/regression/window_fit.h"
#include "passes/stage/expected_error.h"
#include "passes/temporal/temporal_stages.h"

namespace walr {
namespace {

/// How much wider windows are if a texel of light stands for several pixels. With n samples, a local linear regression
/// over a plane errs least if its windows' width is in proportion to n^(-1/6) (Ruppert and Wand 1994).
/// @param power of the number of pixels: 1/6 by this theory
float wideningOf(const LightPattern& light, float power) {
  return std::pow(static_cast<float>(light.columns * light.rows), power);
}

BlockRegressionSettings fittedBlocks(const WalrSettings& settings, std::uint32_t imageHeight,
                                     const LightPattern& light) {
  BlockRegressionSettings blocks = settings.blocks;
  // The share of accumulated light in a pixel is measured on this frame's sample and the history of the same pixel.
  blocks.share.enabled = blocks.share.enabled && light.everyPixel() && !settings.spatialOnly;
  if (!settings.fitWindow) return blocks;
  const float widening = wideningOf(light, 1.0F / 6.0F);
  const auto height = static_cast<std::uint32_t>(widening * static_cast<float>(imageHeight));
  // Growth ends a window where the light differs, so that even small images can have wide windows.
  constexpr std::uint32_t kLeastIterations = 2;
  blocks.size = std::min(blocks.size, fittingBlockSize(height));
  const std::uint32_t fitting = std::max(fittingIterations(height, blocks.size), kLeastIterations);
  blocks.iterations = std::min(blocks.iterations, fitting);
  return blocks;
}

std::optional<CurrentAntilag> antilagOf(const Accumulated& accumulated, const TemporalAccumulationSettings& settings) {
  if (!accumulated.antilag.factor.valid()) return std::nullopt;
  return CurrentAntilag{accumulated.antilag.factor, settings.maxHistory};
}

GuideNeeds needsOf(const WalrSettings& settings, const TemporalPlan& plan) {
  GuideNeeds needs = plan.guides;
  needs.geometricNormal = true;
  needs.occlusion = settings.occlusion;
  return needs;
}

/// At rest, both temporal stages may have a longer history where something tells when the light changes.
void lengthenAtRest(const WalrSettings& settings, TemporalAccumulationSettings& accumulation,
                    TemporalAntialiasingSettings& antialiasing) {
  if (!settings.accumulation.antilag.enabled) return;
  accumulation.restFactor = settings.restFactor;
  antialiasing.restFactor = settings.restFactor;
}

/// The method for specular light: means over lobes take the place of fits.
fg::Texture addSpecularWalr(StageGraph graph, const DenoiserInputs& inputs, fg::Texture output,
                            const WalrSettings& settings) {
  TemporalAccumulationSettings accumulation = settings.accumulation;
  accumulation.maxHistory = settings.maxSpecularHistory;
  TemporalAntialiasingSettings antialiasing = settings.antialiasing;
  antialiasing.clipGamma = settings.specularClipGamma;
  lengthenAtRest(settings, accumulation, antialiasing);
  const TemporalPlan plan = planTemporalStages(inputs, {.accumulation = accumulation,
                                                        .antialiasing = antialiasing,
                                                        .spatialOnly = settings.spatialOnly,
                                                        .keepTaps = true});
  const auto [guides, reflectors, accumulated] = addReflectionsWithAccumulation(graph, inputs, settings.guides, plan);
  const fg::Texture filtered = addLobeFilter(graph,
                                             {.frame = inputs.frame,
                                              .depth = guides.depth,
                                              .reflectors = reflectors,
                                              .accumulated = accumulated.lighting,
                                              .lighting = inputs.lighting,
                                              .antilag = accumulated.antilag.factor,
                                              .maxHistory = accumulation.maxHistory},
                                             filterTarget(graph, plan, output));
  return addAntialiasing(graph, inputs, guides, plan, accumulated, filtered, output);
}

}  // namespace

fg::Texture addWalr(StageGraph graph, const DenoiserInputs& inputs, fg::Texture output, const WalrSettings& settings) {
  if (inputs.conventions.specular) return addSpecularWalr(graph, inputs, output, settings);
  TemporalPlan plan = planTemporalStages(inputs, {.accumulation = settings.accumulation,
                                                  .antialiasing = settings.antialiasing,
                                                  .spatialOnly = settings.spatialOnly});
  BlockRegressionSettings blocks = fittedBlocks(settings, inputs.extent(graph).height, inputs.conventions.light);
  // Reconstruction with blocks.residual measures where history is too long. In the next frame, antilag then
  // shortens it, and that of anti-aliasing.
  std::optional<SteeredHistory> history;
  if (blocks.share.enabled) {
    history = declareSteeredHistory(graph, inputs.extent(graph), settings.accumulation.maxHistory);
    if (settings.accumulation.antilag.enabled) plan.steering = history->limits.previous;
    lengthenAtRest(settings, plan.accumulation, plan.antialiasing);
  }
  const auto [guides, accumulated] =
      addGuidesWithAccumulation(graph, inputs, settings.guides, needsOf(settings, plan), plan);
  // The coarse window's power is measured (passes/LEARNT.md, "Rays, sparse light and other normals"). Without a light
  // grid every pixel has a mean.
  if (settings.fitWindow && accumulated.lightGrid) {
    blocks.coarseSigma *= wideningOf(inputs.conventions.light, 1.0F / 3.0F);
  }
  const BlockLight light{.accumulated = accumulated.lighting,
                         .alpha = accumulated.alpha,
                         .lighting = inputs.lighting,
                         .pattern = inputs.conventions.light,
                         .lightGrid = accumulated.lightGrid,
                         .history = history,
                         .antilag = antilagOf(accumulated, settings.accumulation)};
  const BlockFits fits = addBlockRegression(graph, inputs.frame, light, guides, blocks);
  const fg::Texture filtered =
      addBlockReconstruction(graph, inputs.frame, light, guides, fits, filterTarget(graph, plan, output), blocks);
  const fg::Texture result = addAntialiasing(graph, inputs, guides, plan, accumulated, filtered, output);
  const bool packed = settings.accumulation.storage == LightStorage::Packed;
  if (plan.accumulates && packed && !accumulated.lightGrid) offerExpectedError(graph, accumulated.lighting, result);
  return result;
}

}  // namespace walr
