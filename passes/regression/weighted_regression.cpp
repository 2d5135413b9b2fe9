#include "passes/regression/weighted_regression.h"

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "shaders/regression/atrous.h"
#include "shaders/shaders.h"

namespace walr {
namespace {

/// The variants of the pass.
enum class Variant : std::uint8_t { Averages, Filter, View };

/// Formats of the textures that hold moments.
const std::vector<VkFormat>& momentFormats(MomentStorage storage) {
  static const std::array<std::vector<VkFormat>, 4> kFormats{{
      {VK_FORMAT_R32G32B32A32_UINT, VK_FORMAT_R32G32B32A32_UINT},
      {VK_FORMAT_R32G32B32A32_UINT, VK_FORMAT_R32G32_UINT, VK_FORMAT_R32_UINT},
      {VK_FORMAT_R32G32B32A32_UINT, VK_FORMAT_R32_UINT},
      {VK_FORMAT_R32G32B32A32_UINT, VK_FORMAT_R32G32B32A32_UINT, VK_FORMAT_R32G32B32A32_UINT, VK_FORMAT_R32G32_UINT},
  }};
  return kFormats.at(static_cast<std::size_t>(storage));
}

/// The shader of an iteration that another one follows; it writes the textures of `momentFormats`.
const fg::Shader& averagesShader(MomentStorage storage, bool first) {
  switch (storage) {
    case MomentStorage::Raw16:
      return shaders::atrousRaw16({.first = first});
    case MomentStorage::Raw11:
      return shaders::atrousRaw11({.first = first});
    case MomentStorage::Raw32:
      return shaders::atrousRaw32({.first = first});
    default:
      return shaders::atrousCentred16({.first = first});
  }
}

const fg::Shader& shaderFor(Variant variant, MomentStorage storage, bool first) {
  if (variant == Variant::Averages) return averagesShader(storage, first);
  if (variant == Variant::View) return first ? shaders::atrousFirstView : shaders::atrousView;
  return first ? shaders::atrousFirstLast : shaders::atrousLast;
}

/// In the order of `view` of atrous.comp.
const std::vector<ViewInfo>& pixelIterationViews() {
  static const std::vector<ViewInfo> kViews{
      {"edges",
       "Step of the nearest edge on the eight traces (one past the last: none), taps replaced, taps lost",
       {{"replaced-taps", "Y"}, {"lost-taps", "Z"}},
       true},
      {"samples",
       "Sample count W, relative variance of a sample, 1 where a pixel has no finite sample",
       {{"unsampled-pixels", "Z"}}},
      {"pivots",
       "Smaller pivot of the solve before regularisation, ridge or floor, 1 where that outweighs it",
       {{"regularised-fits", "Z"}}},
      {"feature-mean", "Mean of the two features, and 0"},
      {"feature-covariance", "Covariances uu, uv, vv of the features"},
      {"colour-mean", "Mean of the colour"},
      {"covariance-u", "Covariances of the colour with the first feature"},
      {"covariance-v", "Covariances of the colour with the second feature"},
      {"slope-u", "Coefficients of the first feature in the fit"},
      {"slope-v", "Coefficients of the second feature in the fit"},
      {"clamped",
       "1 in each channel where the fit is below 0 or beyond the largest half",
       {{"clamped-channels", "XYZ"}}},
      {"few-samples",
       "1 where W is below 3, the number of coefficients; 1 where it is 0; 0",
       {{"few-samples", "X"}, {"no-samples", "Y"}}},
  };
  return kViews;
}

/// The averages between two iterations. Depth carries the edge distances that the next iteration steps by.
struct Averages {
  std::vector<fg::Texture> moments;
  fg::Texture depth;
};

void checkSettings(const WeightedRegressionSettings& s) {
  s.edgeStopping.check();
  if (s.keepSampleCount && s.storage != MomentStorage::Centred16) {
    throw std::invalid_argument(
        "setting regression.keep-sample-count needs regression.moments=centred16: raw moments are stored without W");
  }
}

/// What the passes of an iteration read.
struct Iteration {
  std::uint32_t index = 0;
  std::uint32_t spacing = 1;  ///< 3^index pixels.
  Averages averages;          ///< Of the iteration before.
};

/// The noise ridge is over the sample count. Without sample counts each tap represents the pixels between taps.
float noiseRidge(const WeightedRegressionSettings& settings, std::uint32_t spacing) {
  const float samplesPerTap = settings.keepSampleCount ? 1.0F : static_cast<float>(spacing * spacing);
  return settings.regularisation.noiseRidge / samplesPerTap;
}

/// Declare the moments that a pass reads. A shader that writes none can read every storage: it has all bindings.
void readMoments(fg::PassBuilder& pass, Variant variant, const std::vector<fg::Texture>& moments) {
  static constexpr std::array kBindings{"momentsA", "momentsB", "momentsC", "momentsD"};
  for (std::size_t i = 0; i < moments.size(); ++i) pass.sample(kBindings.at(i), moments[i]);
  if (variant == Variant::Averages) return;
  for (std::size_t i = moments.size(); i < kBindings.size(); ++i) pass.unread(kBindings.at(i), moments.front());
}

/// The pass of an iteration, without its outputs.
fg::PassBuilder declareIteration(StageGraph graph, const std::string& name, Variant variant, const Iteration& iteration,
                                 fg::Buffer frame, fg::Texture accumulated, LightingAlpha alpha, const Guides& guides,
                                 const WeightedRegressionSettings& settings) {
  const bool first = iteration.index == 0;
  fg::PassBuilder pass = graph.compute(name, shaderFor(variant, settings.storage, first));
  pass.uniform("frameConstants", frame)
      .sample("depth", iteration.averages.depth)
      .sample("planeNormal", settings.edgeStopping.normalOf(guides))
      .specialize("kIteration", iteration.index)
      .specialize("kSpacing", iteration.spacing)
      .specialize("kTraceEdges", settings.traceEdges)
      .specialize("kReplacement", static_cast<std::uint32_t>(settings.replaceTaps))
      .specialize("kRepeatCentre", settings.repeatCentre)
      .specialize("kEdgeLeak", settings.edgeLeak)
      .specialize("kNormalFactor", settings.edgeStopping.normalFactor)
      .constants(AtrousConstants{settings.edgeStopping.planeNear, settings.edgeStopping.planeFar, settings.sdfFraction,
                                 settings.regularisation.ridge, noiseRidge(settings, iteration.spacing)})
      .dispatch(graph.textureDesc(accumulated).extent);
  if (first || variant == Variant::View) pass.sample("accumulated", accumulated);
  if (first || variant == Variant::View) pass.specialize("kAlphaIsSampleCount", alpha == LightingAlpha::SampleCount);
  if (first || variant != Variant::Averages) pass.sample("shadingNormal", guides.shadingNormal);
  if (!first) readMoments(pass, variant, iteration.averages.moments);
  if (variant == Variant::Averages) {
    pass.specialize("kKeepSampleCount", settings.keepSampleCount);
  } else {
    pass.specialize("kMomentStorage", static_cast<std::uint32_t>(settings.storage))
        .specialize("kPivotFloor", settings.regularisation.method == Regularisation::Floor);
  }
  return pass;
}

/// Write the averages of this iteration into textures of their own.
Averages writeAverages(StageGraph graph, fg::PassBuilder& pass, const std::vector<VkFormat>& formats, fg::Extent extent,
                       const std::string& suffix) {
  static constexpr std::array kBindings{"outMomentsA", "outMomentsB", "outMomentsC", "outMomentsD"};
  static constexpr std::array kNames{"moments a", "moments b", "moments c", "moments d"};
  Averages averages;
  for (std::size_t i = 0; i < formats.size(); ++i) {
    const fg::Texture texture = graph.texture(kNames.at(i) + suffix, {formats[i], extent});
    averages.moments.push_back(pass.store(kBindings.at(i), texture));
  }
  averages.depth = pass.store("outDepth", graph.texture("depth and edges" + suffix, {VK_FORMAT_R32_UINT, extent}));
  return averages;
}

}  // namespace

fg::Texture addWeightedRegression(StageGraph graph, fg::Buffer frame, fg::Texture accumulated, LightingAlpha alpha,
                                  const Guides& guides, fg::Texture output,
                                  const WeightedRegressionSettings& settings) {
  checkSettings(settings);
  const fg::Extent extent = graph->textureDesc(accumulated).extent;
  Iteration iteration{.averages = {.moments = {}, .depth = guides.depth}};
  const auto declare = [&](const std::string& name, Variant variant) {
    return declareIteration(graph, name, variant, iteration, frame, accumulated, alpha, guides, settings);
  };
  for (;; ++iteration.index, iteration.spacing *= 3) {
    graph.offer(pixelIterationViews(), extent, [&](const std::string& name) { return declare(name, Variant::View); },
                {.index = iteration.index, .count = settings.iterations});
    const std::string suffix = " " + std::to_string(iteration.index);
    if (iteration.index + 1 == settings.iterations) {
      return declare("a-trous" + suffix, Variant::Filter).store("outFiltered", output);
    }
    fg::PassBuilder pass = declare("a-trous" + suffix, Variant::Averages);
    iteration.averages = writeAverages(graph, pass, momentFormats(settings.storage), extent, suffix);
  }
}

}  // namespace walr
