#include "passes/flr_regression.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "shaders/constants/flr.h"
#include "shaders/shaders.h"

namespace walr {
namespace {

/// The shaders for a set of guides, and the bytes of a cell in their buffers.
struct Variant {
  const fg::Shader& moments;
  const fg::Shader& blur;
  const fg::Shader& solve;
  const fg::Shader& apply;
  std::uint64_t productBytes;      ///< `OuterProducts` of flr.glsl, std430.
  std::uint64_t coefficientBytes;  ///< `Coefficients` of flr.glsl, std430.
};

Variant variantOf(bool occlusion) {
  if (occlusion) {
    return {shaders::flrMomentsOcclusion,
            shaders::flrBlurOcclusion,
            shaders::flrSolveOcclusion,
            shaders::flrApplyOcclusion,
            160,
            80};
  }
  return {shaders::flrMoments, shaders::flrBlur, shaders::flrSolve, shaders::flrApply, 128, 64};
}

/// The least `maxStorageBufferRange` that Vulkan guarantees.
constexpr std::uint64_t kLargestBuffer = std::uint64_t{1} << 27;

/// Cells that cover `pixels` when each takes `factor` pixels per axis.
fg::Extent gridOf(fg::Extent pixels, std::uint32_t factor, std::uint64_t cellBytes) {
  const fg::Extent cells{(pixels.width + factor - 1) / factor, (pixels.height + factor - 1) / factor};
  if (cellBytes * cells.width * cells.height > kLargestBuffer) {
    throw std::invalid_argument("setting regression.factor of " + std::to_string(factor) + " makes " +
                                std::to_string(cells.width) + " x " + std::to_string(cells.height) +
                                " cells, too many for one buffer; take a larger factor");
  }
  return cells;
}

}  // namespace

fg::Texture addFlrRegression(fg::Graph& graph, fg::Texture lighting, LightingAlpha alpha, const Guides& guides,
                             fg::Texture occlusion, fg::Texture output, const FlrRegressionSettings& settings) {
  const Variant variant = variantOf(settings.occlusionGuide);
  const fg::Extent extent = graph.textureDesc(lighting).extent;
  const fg::Extent cells = gridOf(extent, settings.factor, variant.productBytes);
  const std::uint64_t cellCount = std::uint64_t{cells.width} * cells.height;
  const float sigma = settings.sigma / static_cast<float>(settings.factor);
  FlrConstants constants{};
  constants.cells = {cells.width, cells.height};
  constants.factor = static_cast<std::int32_t>(settings.factor);
  constants.radius = static_cast<std::int32_t>(std::ceil(settings.reach * sigma));
  constants.sigma = sigma;
  constants.ridge = settings.ridge;

  // What sums the products and what applies the fit read the same pixels.
  const auto readPixels = [&](const char* name, const fg::Shader& shader) {
    fg::PassBuilder pass = graph.compute(name, shader);
    pass.sample("lighting", lighting).sample("depth", guides.depth).sample("shadingNormal", guides.shadingNormal);
    if (settings.occlusionGuide) pass.sample("occlusion", occlusion);
    pass.constants(constants);
    return pass;
  };
  const auto productBuffer = [&](const char* name) { return graph.buffer(name, {cellCount * variant.productBytes}); };

  fg::PassBuilder downsample = readPixels("flr outer products", variant.moments);
  downsample.specialize("kAlphaIsSampleCount", alpha == LightingAlpha::SampleCount ? 1U : 0U).dispatch(cells);
  const fg::Buffer moments = downsample.store("outMoments", productBuffer("outer products"));

  fg::PassBuilder blur = graph.compute("flr blur", variant.blur);
  blur.load("moments", moments).constants(constants).dispatch(cells);
  const fg::Buffer blurred = blur.store("outBlurred", productBuffer("blurred products"));

  fg::PassBuilder solve = graph.compute("flr solve", variant.solve);
  solve.load("blurred", blurred).constants(constants).dispatch(cells);
  const fg::Buffer coefficients =
      solve.store("outCoefficients", graph.buffer("coefficients", {cellCount * variant.coefficientBytes}));

  fg::PassBuilder apply = readPixels("flr apply", variant.apply);
  apply.load("coefficients", coefficients)
      .specialize("kUpsampling", static_cast<std::uint32_t>(settings.upsampling))
      .dispatch(extent);
  return apply.store("outFiltered", output);
}

}  // namespace walr
