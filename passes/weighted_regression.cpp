#include "passes/weighted_regression.h"

#include <stdexcept>
#include <string>

#include "shaders/constants/atrous.h"
#include "shaders/shaders.h"

namespace walr {
namespace {

/// The averages between two iterations. Depth carries the edge distances that the next iteration steps by.
struct Averages {
  fg::Texture momentsA;
  fg::Texture momentsB;
  fg::Texture depth;
};

const fg::Shader& iterationShader(bool first, bool last) {
  if (first) return last ? shaders::atrousFirstLast : shaders::atrousFirst;
  return last ? shaders::atrousLast : shaders::atrous;
}

}  // namespace

fg::Texture addWeightedRegression(fg::Graph& graph, fg::Buffer frame, fg::Texture accumulated, const Guides& guides,
                                  const WeightedRegressionSettings& settings) {
  if (!(settings.planeNear < settings.planeFar)) {
    throw std::invalid_argument("setting regression.plane-near must be below regression.plane-far");
  }
  const fg::Extent extent = graph.textureDesc(accumulated).extent;
  const AtrousConstants constants{settings.planeNear, settings.planeFar, settings.sdfFraction, settings.ridge,
                                  settings.noiseRidge};
  Averages averages{.momentsA = {}, .momentsB = {}, .depth = guides.depth};
  std::int32_t spacing = 1;
  for (std::uint32_t t = 0; t < settings.iterations; ++t, spacing *= 3) {
    const bool first = t == 0;
    const bool last = t + 1 == settings.iterations;
    const std::string suffix = " " + std::to_string(t);

    fg::PassBuilder pass = graph.compute("a-trous" + suffix, iterationShader(first, last));
    pass.uniform("frameConstants", frame)
        .sample("depth", averages.depth)
        .sample("normals", guides.normals)
        .specialize("kIteration", t)
        .specialize("kSpacing", static_cast<std::uint32_t>(spacing))
        .specialize("kReplaceTaps", settings.replaceTaps ? 1U : 0U)
        .constants(constants)
        .dispatch(extent);
    if (first || last) pass.sample("accumulated", accumulated);
    if (!first) pass.sample("momentsA", averages.momentsA).sample("momentsB", averages.momentsB);
    if (last) {
      return pass.store("outFiltered", graph.texture("filtered", {VK_FORMAT_R16G16B16A16_SFLOAT, extent}));
    }
    averages.momentsA =
        pass.store("outMomentsA", graph.texture("moments a" + suffix, {VK_FORMAT_R32G32B32A32_UINT, extent}));
    averages.momentsB =
        pass.store("outMomentsB", graph.texture("moments b" + suffix, {VK_FORMAT_R32G32B32A32_UINT, extent}));
    averages.depth = pass.store("outDepth", graph.texture("depth and edges" + suffix, {VK_FORMAT_R32_UINT, extent}));
  }
  return {};
}

}  // namespace walr
