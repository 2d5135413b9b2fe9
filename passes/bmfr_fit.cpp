#include "passes/bmfr_fit.h"

#include "shaders/constants/bmfr.h"
#include "shaders/shaders.h"

namespace walr {
namespace {

constexpr std::uint32_t kBlockSize = 32;

/// With noise only a block with fewer samples than features is still short of rank, and what is left of a column then
/// is rounding: well above single precision's, well below the noise.
constexpr float kRoundingTolerance = 1e-4F;

}  // namespace

fg::Texture addBmfrFit(fg::Graph& graph, fg::Buffer frame, fg::Texture lighting, LightingAlpha alpha,
                       const Guides& guides, fg::Texture output, const BmfrFitSettings& settings) {
  const bool stochastic = settings.rankHandling == RankHandling::Stochastic;
  const BmfrFitConstants constants{stochastic ? settings.noiseAmplitude : 0.0F,
                                   stochastic ? kRoundingTolerance : settings.rankTolerance, settings.extentFloor};
  // One block more than fits an axis, so that the displaced grid still covers the image.
  const fg::Shader& shader = shaders::bmfrFit;
  const fg::Extent extent = graph.textureDesc(lighting).extent;
  const fg::Extent threads{(extent.width / kBlockSize + 2) * shader.localSize[0],
                           (extent.height / kBlockSize + 2) * shader.localSize[1]};
  fg::PassBuilder pass = graph.compute("bmfr fit", shader);
  pass.uniform("frameConstants", frame)
      .sample("lighting", lighting)
      .sample("depth", guides.depth)
      .sample("shadingNormal", guides.shadingNormal)
      .specialize("kAlphaIsSampleCount", alpha == LightingAlpha::SampleCount ? 1U : 0U)
      .constants(constants)
      .dispatch(threads);
  return pass.store("outFitted", output);
}

}  // namespace walr
