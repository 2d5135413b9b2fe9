#include "passes/regression/bmfr_fit.h"

#include <string>
#include <vector>

#include "shaders/regression/bmfr_fit.h"
#include "shaders/shaders.h"

namespace walr {
namespace {

/// Rank tolerance with noise: only a block with fewer samples than features is short of rank, and its dependent columns
/// hold rounding errors. The tolerance is well above those of single precision and well below the noise.
constexpr float kRoundingTolerance = 1e-4F;

/// In the order of `view` of bmfr_fit.comp.
const std::vector<ViewInfo>& fitViews() {
  static const std::vector<ViewInfo> kViews{
      {"rank",
       "Of the pixel's block: features left out (of ten) because earlier ones explain them, samples, 1 where any is "
       "left out",
       {{"rank-deficient-fits", "Z"}}},
      {"clamped",
       "1 in each channel where the fit is below 0 or beyond the largest half",
       {{"clamped-channels", "XYZ"}}},
      {"unfitted",
       "1 where the pixel's block has no sample, where the pixel has none, where the fit is not finite",
       {{"unfitted-pixels", "X"}, {"unsampled-pixels", "Y"}, {"non-finite-fits", "Z"}}},
  };
  return kViews;
}

}  // namespace

fg::Texture addBmfrFit(StageGraph graph, fg::Buffer frame, fg::Texture lighting, LightingAlpha alpha,
                       const Guides& guides, fg::Texture output, const BmfrFitSettings& settings) {
  const bool stochastic = settings.rankHandling == RankHandling::Stochastic;
  const BmfrFitConstants constants{stochastic ? settings.noiseAmplitude : 0.0F,
                                   stochastic ? kRoundingTolerance : settings.rankTolerance, settings.extentFloor};
  // One block more than fits an axis, so that the displaced grid still covers the image.
  const fg::Extent extent = graph->textureDesc(lighting).extent;
  const auto declare = [&](const std::string& name, const fg::Shader& shader) {
    const fg::Extent threads{(extent.width / kBmfrBlockSize + 2) * shader.localSize[0],
                             (extent.height / kBmfrBlockSize + 2) * shader.localSize[1]};
    fg::PassBuilder pass = graph->compute(name, shader);
    pass.uniform("frameConstants", frame)
        .sample("lighting", lighting)
        .sample("depth", guides.depth)
        .sample("shadingNormal", guides.shadingNormal)
        .specialize("kAlphaIsSampleCount", alpha == LightingAlpha::SampleCount ? 1U : 0U)
        .constants(constants)
        .dispatch(threads);
    return pass;
  };
  graph.offer(fitViews(), extent, [&](const std::string& name) { return declare(name, shaders::bmfrFitView); });
  fg::PassBuilder pass = declare("bmfr fit", shaders::bmfrFit);
  return pass.store("outFitted", output);
}

}  // namespace walr
