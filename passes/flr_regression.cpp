#include "passes/flr_regression.h"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "passes/grid_extent.h"
#include "shaders/constants/flr.h"
#include "shaders/shaders.h"

namespace walr {
namespace {

/// Bytes of a cell in the buffers; they depend on the number of guides.
struct CellBytes {
  std::uint64_t products;      ///< `OuterProducts` of flr.glsl, but for `moreProducts`.
  std::uint64_t coefficients;  ///< `Coefficients` of flr.glsl.
  std::uint64_t moreProducts;  ///< Those in a second buffer; 0: there is none.
};

/// Bytes of one of the vectors that a cell consists of, `vec4` in flr.glsl.
constexpr std::uint64_t kVectorBytes = 16;

/// The guides of the regression besides the constant.
struct GuideChoice {
  std::uint32_t count;  ///< `kUsedFeatures` of flr.glsl.
  CellBytes bytes;
};

GuideChoice chosenGuides(bool occlusion, bool learned) {
  if (learned) return {8, {224, 112, 64}};
  return occlusion ? GuideChoice{5, {160, 80, 0}} : GuideChoice{4, {128, 64, 0}};
}

/// In the order of `kView` of flr_solve.comp. Names of what WALR's regression has, too, are the same.
const std::vector<ViewInfo>& solveViews() {
  static const std::vector<ViewInfo> kViews{
      {"pivots",
       "Of the pixel's cell: smallest pivot of the solve without its ridge, in units of that, pivots that the ridge "
       "outweighs, 1 where there is one",
       {{"regularised-fits", "Z"}}},
      {"samples",
       "Of the pixel's cell: weighted samples, 1 where they are fewer than the coefficients, 1 where there are none",
       {{"few-samples", "Y"}, {"no-samples", "Z"}}},
  };
  return kViews;
}

/// In the order of `kView` of flr_apply.comp.
const std::vector<ViewInfo>& applyViews() {
  static const std::vector<ViewInfo> kViews{
      {"clamped",
       "1 in each channel where the fit is below 0 or beyond the largest half",
       {{"clamped-channels", "XYZ"}}},
      {"unfitted",
       "1 where no cell around has a fit, where the pixel has no sample, where the fit is not finite",
       {{"unfitted-pixels", "X"}, {"unsampled-pixels", "Y"}, {"non-finite-fits", "Z"}}},
      {"light", "Light that is fitted; 0 where the pixel has no sample"},
      {"guide-normal", "Shading normal in view space, as it is a guide"},
      {"guide-depth", "Guides inverse depth and ambient occlusion, samples in the light; 0 where there are none"},
  };
  return kViews;
}

/// Cells that cover `pixels` when each takes `factor` pixels per axis.
fg::Extent gridOf(fg::Extent pixels, std::uint32_t factor, std::uint64_t cellBytes) {
  const fg::Extent cells = gridExtent(pixels, factor);
  if (cellBytes * cells.width * cells.height > kLargestBuffer) {
    throw std::invalid_argument("setting regression.factor of " + std::to_string(factor) + " makes " +
                                std::to_string(cells.width) + " x " + std::to_string(cells.height) +
                                " cells, too many for one buffer; take a larger factor");
  }
  return cells;
}

}  // namespace

fg::Texture addFlrRegression(StageGraph graph, fg::Texture lighting, LightingAlpha alpha, const Guides& guides,
                             fg::Texture output, const FlrRegressionSettings& settings, fg::Texture learned) {
  const bool occlusion = settings.occlusionGuide;
  if (learned.valid() && !occlusion) {
    throw std::invalid_argument(
        "learned guides need ambient occlusion beside them: set regression.occlusion-guide to on");
  }
  const GuideChoice chosen = chosenGuides(occlusion, learned.valid());
  const CellBytes bytes = chosen.bytes;
  const fg::Extent extent = graph->textureDesc(lighting).extent;
  const fg::Extent cells = gridOf(extent, settings.factor, bytes.products);
  const std::uint64_t cellCount = std::uint64_t{cells.width} * cells.height;
  const float sigma = settings.sigma / static_cast<float>(settings.factor);
  FlrConstants constants{};
  constants.cells = {cells.width, cells.height};
  constants.factor = static_cast<std::int32_t>(settings.factor);
  constants.radius = static_cast<std::int32_t>(std::ceil(settings.reach * sigma));
  constants.sigma = sigma;
  constants.ridge = settings.ridge;

  // The pass that sums the products and the pass that applies the fit read the same pixels.
  const auto readPixels = [&](const std::string& name, const fg::Shader& shader) {
    fg::PassBuilder pass = graph->compute(name, shader);
    pass.sample("lighting", lighting)
        .sample("depth", guides.depth)
        .sample("normals", occlusion ? guides.features : guides.shadingNormal)
        .sampleIf(learned.valid(), "learned", learned, lighting)
        .specialize("kUsedFeatures", chosen.count)
        .constants(constants);
    return pass;
  };
  const std::array productBytes{bytes.products, bytes.moreProducts};
  const std::size_t buffers = bytes.moreProducts > 0 ? 2 : 1;

  fg::PassBuilder downsample = readPixels("flr outer products", shaders::flrMoments({.learned = learned.valid()}));
  downsample.specialize("kAlphaIsSampleCount", alpha == LightingAlpha::SampleCount ? 1U : 0U).dispatch(cells);
  constexpr std::array kMoments{"outMoments", "outMoreMoments"};
  constexpr std::array kToBlur{"moments", "moreMoments"};
  constexpr std::array kOutBlurred{"outBlurred", "outMoreBlurred"};
  constexpr std::array kBlurred{"blurred", "moreBlurred"};
  constexpr std::array kMomentNames{"outer products", "more outer products"};
  constexpr std::array kBlurredNames{"blurred products", "more blurred products"};
  std::array<fg::Buffer, 2> moments;
  for (std::size_t i = 0; i < buffers; ++i) {
    moments[i] = downsample.store(kMoments[i], graph->buffer(kMomentNames[i], {cellCount * productBytes[i]}));
  }
  fg::PassBuilder blur = graph->compute("flr blur", shaders::flrBlur({.learned = learned.valid()}));
  blur.specialize("kUsedFeatures", chosen.count).constants(constants);
  blur.dispatch(cells, static_cast<std::uint32_t>((bytes.products + bytes.moreProducts) / kVectorBytes));
  std::array<fg::Buffer, 2> blurred;
  for (std::size_t i = 0; i < buffers; ++i) {
    blur.load(kToBlur[i], moments[i]);
    blurred[i] = blur.store(kOutBlurred[i], graph->buffer(kBlurredNames[i], {cellCount * productBytes[i]}));
  }

  const auto declareSolve = [&](const std::string& name, const fg::Shader& shader) {
    fg::PassBuilder pass = graph->compute(name, shader);
    for (std::size_t i = 0; i < buffers; ++i) pass.load(kBlurred[i], blurred[i]);
    for (std::size_t i = buffers; i < kBlurred.size(); ++i) pass.unread(kBlurred[i], blurred.front());
    pass.specialize("kUsedFeatures", chosen.count).constants(constants).dispatch(cells);
    return pass;
  };
  fg::PassBuilder solve = declareSolve("flr solve", shaders::flrSolve);
  const fg::Buffer coefficients =
      solve.store("outCoefficients", graph->buffer("coefficients", {cellCount * bytes.coefficients}));

  const auto declareApply = [&](const std::string& name, const fg::Shader& shader) {
    fg::PassBuilder pass = readPixels(name, shader);
    pass.load("coefficients", coefficients)
        .specialize("kUpsampling", static_cast<std::uint32_t>(settings.upsampling))
        .dispatch(extent);
    return pass;
  };
  graph.offer(solveViews(), extent, [&](const std::string& name) { return declareSolve(name, shaders::flrSolveView); });
  graph.offer(applyViews(), extent, [&](const std::string& name) {
    fg::PassBuilder pass = declareApply(name, shaders::flrApplyView);
    pass.specialize("kAlphaIsSampleCount", alpha == LightingAlpha::SampleCount);
    return pass;
  });
  fg::PassBuilder apply = declareApply("flr apply", shaders::flrApply);
  return apply.store("outFiltered", output);
}

}  // namespace walr
