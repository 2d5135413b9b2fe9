#include "passes/weighted_regression.h"

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "shaders/constants/atrous.h"
#include "shaders/shaders.h"

namespace walr {
namespace {

/// Shaders of one storage: [first][last].
using IterationShaders = std::array<std::array<const fg::Shader*, 2>, 2>;

/// The textures of one storage and the shaders that read and write them.
struct StorageLayout {
  std::vector<VkFormat> formats;
  IterationShaders shaders;
};

const StorageLayout& layoutOf(MomentStorage storage) {
  using namespace shaders;
  static const std::array kLayouts{
      StorageLayout{{VK_FORMAT_R32G32B32A32_UINT, VK_FORMAT_R32G32B32A32_UINT},
                    {{{&atrousCentred16, &atrousCentred16Last}, {&atrousCentred16First, &atrousFirstLast}}}},
      StorageLayout{{VK_FORMAT_R32G32B32A32_UINT, VK_FORMAT_R32G32_UINT, VK_FORMAT_R32_UINT},
                    {{{&atrousRaw16, &atrousRaw16Last}, {&atrousRaw16First, &atrousFirstLast}}}},
      StorageLayout{{VK_FORMAT_R32G32B32A32_UINT, VK_FORMAT_R32_UINT},
                    {{{&atrousRaw11, &atrousRaw11Last}, {&atrousRaw11First, &atrousFirstLast}}}},
      StorageLayout{{VK_FORMAT_R32G32B32A32_UINT, VK_FORMAT_R32G32B32A32_UINT, VK_FORMAT_R32G32B32A32_UINT,
                     VK_FORMAT_R32G32_UINT},
                    {{{&atrousRaw32, &atrousRaw32Last}, {&atrousRaw32First, &atrousFirstLast}}}},
  };
  return kLayouts.at(static_cast<std::size_t>(storage));
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

/// The part of an iteration that does not depend on its place.
void declareIteration(fg::PassBuilder& pass, fg::Buffer frame, const Guides& guides,
                      const WeightedRegressionSettings& settings) {
  pass.uniform("frameConstants", frame)
      .sample("planeNormal", settings.edgeStopping.normalOf(guides))
      .specialize("kTraceEdges", settings.traceEdges)
      .specialize("kReplacement", static_cast<std::uint32_t>(settings.replaceTaps))
      .specialize("kRepeatCentre", settings.repeatCentre)
      .specialize("kEdgeLeak", settings.edgeLeak)
      .specialize("kNormalFactor", settings.edgeStopping.normalFactor)
      .constants(AtrousConstants{settings.edgeStopping.planeNear, settings.edgeStopping.planeFar, settings.sdfFraction,
                                 settings.regularisation.ridge, settings.regularisation.noiseRidge});
}

/// Read the averages of the iteration before.
void readAverages(fg::PassBuilder& pass, const Averages& averages) {
  static constexpr std::array kBindings{"momentsA", "momentsB", "momentsC", "momentsD"};
  for (std::size_t i = 0; i < averages.moments.size(); ++i) pass.sample(kBindings.at(i), averages.moments[i]);
}

/// Write the averages of this iteration into textures of their own.
Averages writeAverages(fg::Graph& graph, fg::PassBuilder& pass, const StorageLayout& layout, fg::Extent extent,
                       const std::string& suffix) {
  static constexpr std::array kBindings{"outMomentsA", "outMomentsB", "outMomentsC", "outMomentsD"};
  static constexpr std::array kNames{"moments a", "moments b", "moments c", "moments d"};
  Averages averages;
  for (std::size_t i = 0; i < layout.formats.size(); ++i) {
    const fg::Texture texture = graph.texture(kNames.at(i) + suffix, {layout.formats[i], extent});
    averages.moments.push_back(pass.store(kBindings.at(i), texture));
  }
  averages.depth = pass.store("outDepth", graph.texture("depth and edges" + suffix, {VK_FORMAT_R32_UINT, extent}));
  return averages;
}

}  // namespace

fg::Texture addWeightedRegression(fg::Graph& graph, fg::Buffer frame, fg::Texture accumulated, const Guides& guides,
                                  fg::Texture output, const WeightedRegressionSettings& settings) {
  checkSettings(settings);
  const fg::Extent extent = graph.textureDesc(accumulated).extent;
  const StorageLayout& layout = layoutOf(settings.storage);
  Averages averages{.moments = {}, .depth = guides.depth};
  std::uint32_t spacing = 1;
  for (std::uint32_t t = 0;; ++t, spacing *= 3) {
    const bool first = t == 0;
    const bool last = t + 1 == settings.iterations;
    const std::string suffix = " " + std::to_string(t);

    fg::PassBuilder pass = graph.compute("a-trous" + suffix, *layout.shaders.at(first ? 1 : 0).at(last ? 1 : 0));
    declareIteration(pass, frame, guides, settings);
    pass.sample("depth", averages.depth).specialize("kIteration", t).specialize("kSpacing", spacing).dispatch(extent);
    if (first) pass.sample("accumulated", accumulated);
    if (first || last) pass.sample("shadingNormal", guides.shadingNormal);
    if (!first) readAverages(pass, averages);
    if (last) {
      pass.specialize("kPivotFloor", settings.regularisation.method == Regularisation::Floor);
      return pass.store("outFiltered", output);
    }
    pass.specialize("kKeepSampleCount", settings.keepSampleCount);
    averages = writeAverages(graph, pass, layout, extent, suffix);
  }
}

}  // namespace walr
