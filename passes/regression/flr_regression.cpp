#include "passes/regression/flr_regression.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "passes/stage/grid_extent.h"
#include "shaders/regression/flr.h"
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

constexpr std::uint64_t vectorsOf(std::uint64_t numbers) {
  return (numbers + 3) / 4;
}

/// `count` guides, and the bytes of a cell as flr.glsl lays it out: the products of guides, constant and colour
/// (`kProducts`), and the coefficients.
constexpr GuideChoice choiceOf(std::uint64_t count) {
  const std::uint64_t products = vectorsOf((count + 1) * (count + 2) / 2 + 3 * (count + 1));
  const std::uint64_t first = std::min<std::uint64_t>(products, kMostFirstVectors);
  return {static_cast<std::uint32_t>(count),
          {kVectorBytes * first, kVectorBytes * (1 + vectorsOf(3 * count)), kVectorBytes * (products - first)}};
}

GuideChoice chosenGuides(bool occlusion, const LearnedGuides& learned) {
  if (learned.valid() && !learned.alone()) return choiceOf(8);
  return choiceOf(occlusion ? 5 : 4);
}

/// In the order of `view` of flr_solve.comp. Names of what WALR's regression has, too, are the same.
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

/// In the order of `view` of flr_apply.comp.
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

FlrConstants constantsOf(const FlrRegressionSettings& settings, fg::Extent cells) {
  FlrConstants constants{};
  constants.cells = {cells.width, cells.height};
  constants.factor = static_cast<std::int32_t>(settings.factor);
  constants.sigma = settings.sigma / static_cast<float>(settings.factor);
  constants.radius = static_cast<std::int32_t>(std::ceil(settings.reach * constants.sigma));
  constants.ridge = settings.ridge;
  return constants;
}

/// One or two buffers of the outer products of all cells; the second one is not valid if all fit the first one.
using CellBuffers = std::array<fg::Buffer, 2>;

/// The passes of one regression.
class Regression {
 public:
  Regression(StageGraph graph, fg::Texture lighting, LightingAlpha alpha, const Guides& guides,
             const FlrRegressionSettings& settings, const LearnedGuides& learned)
      : graph_(graph),
        lighting_(lighting),
        alphaIsSampleCount_(alpha == LightingAlpha::SampleCount),
        guides_(guides),
        settings_(settings),
        learned_(learned),
        chosen_(chosenGuides(settings.occlusionGuide, learned)),
        extent_(graph->textureDesc(lighting).extent),
        cells_(gridOf(extent_, settings.factor, chosen_.bytes.products)),
        constants_(constantsOf(settings, cells_)) {}

  /// Downsample the outer products of guides and light.
  CellBuffers sumOuterProducts() {
    fg::PassBuilder pass = readPixels("flr outer products", shaders::flrMoments({.eight = twoBuffers()}), false);
    pass.specialize("kAlphaIsSampleCount", alphaIsSampleCount_).dispatch(cells_);
    return storeProducts(pass, {"outMoments", "outMoreMoments"}, {"outer products", "more outer products"});
  }

  /// The horizontal pass of the Gaussian.
  CellBuffers blur(const CellBuffers& products) {
    fg::PassBuilder pass = graph_->compute("flr blur", shaders::flrBlur({.eight = twoBuffers()}));
    chooseGuides(pass);
    const CellBytes& bytes = chosen_.bytes;
    pass.dispatch(cells_, static_cast<std::uint32_t>((bytes.products + bytes.moreProducts) / kVectorBytes));
    pass.load("moments", products[0]);
    if (twoBuffers()) pass.load("moreMoments", products[1]);
    return storeProducts(pass, {"outBlurred", "outMoreBlurred"}, {"blurred products", "more blurred products"});
  }

  /// The vertical pass of the Gaussian, and A* of every cell.
  fg::Buffer solve(const CellBuffers& blurred) {
    graph_.offer(solveViews(), extent_,
                 [&](const std::string& name) { return declareSolve(name, shaders::flrSolveView, blurred); });
    fg::PassBuilder pass = declareSolve("flr solve", shaders::flrSolve, blurred);
    return pass.store("outCoefficients", graph_->buffer("coefficients", {cellCount() * chosen_.bytes.coefficients}));
  }

  /// I_k = x_k A_k*, with the interpolated coefficients.
  fg::Texture apply(fg::Buffer coefficients, fg::Texture output) {
    graph_.offer(applyViews(), extent_, [&](const std::string& name) {
      fg::PassBuilder view = readPixels(name, shaders::flrApplyView, true);
      readCoefficients(view, coefficients);
      view.specialize("kAlphaIsSampleCount", alphaIsSampleCount_);
      return view;
    });
    fg::PassBuilder pass = readPixels("flr apply", shaders::flrApply, false);
    readCoefficients(pass, coefficients);
    return pass.store("outFiltered", output);
  }

 private:
  [[nodiscard]] bool twoBuffers() const { return chosen_.bytes.moreProducts > 0; }
  [[nodiscard]] std::uint64_t cellCount() const { return std::uint64_t{cells_.width} * cells_.height; }

  void chooseGuides(fg::PassBuilder& pass) {
    pass.specialize("kUsedFeatures", chosen_.count).specialize("kLearnedAlone", learned_.alone());
    pass.constants(constants_);
  }

  /// The pass that sums the products and the pass that applies the fit read the same pixels.
  /// @param view shows the geometric guides, too, where learned ones stand in their place
  fg::PassBuilder readPixels(const std::string& name, const fg::Shader& shader, bool view) {
    const fg::Texture normals = settings_.occlusionGuide ? guides_.features : guides_.shadingNormal;
    fg::PassBuilder pass = graph_->compute(name, shader);
    pass.sample("lighting", lighting_)
        .sample("depth", guides_.depth)
        .sampleIf(view || !learned_.alone(), "normals", normals, guides_.depth)
        .sampleIf(learned_.valid(), "learned", learned_.first, lighting_)
        .sampleIf(learned_.alone(), "moreLearned", learned_.more, lighting_);
    chooseGuides(pass);
    return pass;
  }

  CellBuffers storeProducts(fg::PassBuilder& pass, const std::array<const char*, 2>& shaderNames,
                            const std::array<const char*, 2>& bufferNames) {
    const std::array bytes{chosen_.bytes.products, chosen_.bytes.moreProducts};
    CellBuffers buffers;
    for (std::size_t i = 0; i < (twoBuffers() ? 2 : 1); ++i) {
      buffers[i] = pass.store(shaderNames[i], graph_->buffer(bufferNames[i], {cellCount() * bytes[i]}));
    }
    return buffers;
  }

  fg::PassBuilder declareSolve(const std::string& name, const fg::Shader& shader, const CellBuffers& blurred) {
    fg::PassBuilder pass = graph_->compute(name, shader);
    pass.load("blurred", blurred[0]);
    if (twoBuffers()) {
      pass.load("moreBlurred", blurred[1]);
    } else {
      pass.unread("moreBlurred", blurred[0]);
    }
    chooseGuides(pass);
    pass.dispatch(cells_);
    return pass;
  }

  void readCoefficients(fg::PassBuilder& pass, fg::Buffer coefficients) {
    pass.load("coefficients", coefficients)
        .specialize("kUpsampling", static_cast<std::uint32_t>(settings_.upsampling))
        .dispatch(extent_);
  }

  StageGraph graph_;
  fg::Texture lighting_;
  bool alphaIsSampleCount_;
  const Guides& guides_;
  const FlrRegressionSettings& settings_;
  const LearnedGuides& learned_;
  GuideChoice chosen_;
  fg::Extent extent_;
  fg::Extent cells_;
  FlrConstants constants_;
};

}  // namespace

fg::Texture addFlrRegression(StageGraph graph, fg::Texture lighting, LightingAlpha alpha, const Guides& guides,
                             fg::Texture output, const FlrRegressionSettings& settings, const LearnedGuides& learned) {
  if (learned.valid() && !settings.occlusionGuide) {
    throw std::invalid_argument("learned guides need ambient occlusion: set regression.occlusion-guide to on");
  }
  Regression regression(graph, lighting, alpha, guides, settings, learned);
  const CellBuffers products = regression.sumOuterProducts();
  const CellBuffers blurred = regression.blur(products);
  const fg::Buffer coefficients = regression.solve(blurred);
  return regression.apply(coefficients, output);
}

}  // namespace walr
