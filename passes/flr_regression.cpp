#include "passes/flr_regression.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "shaders/constants/flr.h"
#include "shaders/shaders.h"

namespace walr {
namespace {

constexpr std::uint64_t kMomentBytes = 128;      ///< `OuterProducts` of flr.glsl, std430.
constexpr std::uint64_t kCoefficientBytes = 64;  ///< `Coefficients` of flr.glsl, std430.

/// The least `maxStorageBufferRange` that Vulkan guarantees.
constexpr std::uint64_t kLargestBuffer = std::uint64_t{1} << 27;

/// Cells that cover `pixels` when each takes `factor` pixels per axis.
fg::Extent gridOf(fg::Extent pixels, std::uint32_t factor) {
  const fg::Extent cells{(pixels.width + factor - 1) / factor, (pixels.height + factor - 1) / factor};
  if (kMomentBytes * cells.width * cells.height > kLargestBuffer) {
    throw std::invalid_argument("setting regression.factor of " + std::to_string(factor) + " makes " +
                                std::to_string(cells.width) + " x " + std::to_string(cells.height) +
                                " cells, too many for one buffer; take a larger factor");
  }
  return cells;
}

}  // namespace

fg::Texture addFlrRegression(fg::Graph& graph, fg::Texture lighting, LightingAlpha alpha, const Guides& guides,
                             fg::Texture output, const FlrRegressionSettings& settings) {
  const fg::Extent extent = graph.textureDesc(lighting).extent;
  const fg::Extent cells = gridOf(extent, settings.factor);
  const std::uint64_t cellCount = std::uint64_t{cells.width} * cells.height;
  const float sigma = settings.sigma / static_cast<float>(settings.factor);
  FlrConstants constants{};
  constants.cells = {cells.width, cells.height};
  constants.factor = static_cast<std::int32_t>(settings.factor);
  constants.radius = static_cast<std::int32_t>(std::ceil(settings.reach * sigma));
  constants.sigma = sigma;
  constants.ridge = settings.ridge;

  fg::PassBuilder downsample = graph.compute("flr outer products", shaders::flrMoments);
  downsample.sample("lighting", lighting)
      .sample("depth", guides.depth)
      .sample("shadingNormal", guides.shadingNormal)
      .specialize("kAlphaIsSampleCount", alpha == LightingAlpha::SampleCount ? 1U : 0U)
      .constants(constants)
      .dispatch(cells);
  const fg::Buffer moments = downsample.store("outMoments", graph.buffer("outer products", {cellCount * kMomentBytes}));

  fg::PassBuilder blur = graph.compute("flr blur", shaders::flrBlur);
  blur.load("moments", moments).constants(constants).dispatch(cells);
  const fg::Buffer blurred = blur.store("outBlurred", graph.buffer("blurred products", {cellCount * kMomentBytes}));

  fg::PassBuilder solve = graph.compute("flr solve", shaders::flrSolve);
  solve.load("blurred", blurred).constants(constants).dispatch(cells);
  const fg::Buffer coefficients =
      solve.store("outCoefficients", graph.buffer("coefficients", {cellCount * kCoefficientBytes}));

  fg::PassBuilder apply = graph.compute("flr apply", shaders::flrApply);
  apply.sample("lighting", lighting)
      .sample("depth", guides.depth)
      .sample("shadingNormal", guides.shadingNormal)
      .load("coefficients", coefficients)
      .constants(constants)
      .dispatch(extent);
  return apply.store("outFiltered", output);
}

}  // namespace walr
