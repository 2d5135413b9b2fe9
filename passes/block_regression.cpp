#include "passes/block_regression.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "shaders/constants/block_regression.h"
#include "shaders/shaders.h"

namespace walr {
namespace {

/// What the passes share.
struct BlockGrid {
  fg::Graph& graph;
  fg::Buffer frame;
  fg::Extent pixels;
  fg::Extent blocks;
  std::uint32_t size;
  BlockRegressionConstants constants;
};

/// Moments of every block and the depth of the pixel that stands for it.
struct BlockAverages {
  std::array<fg::Texture, 5> moments;
  fg::Texture depth;
};

/// The fit of every block and the depth that its depth feature is relative to.
struct BlockFits {
  fg::Texture a, b, c;
  fg::Texture depth;
};

BlockGrid gridOf(fg::Graph& graph, fg::Buffer frame, fg::Extent pixels, const BlockRegressionSettings& s) {
  const fg::Extent blocks{(pixels.width + s.size - 1) / s.size, (pixels.height + s.size - 1) / s.size};
  const float sigma = s.coarseSigma * static_cast<float>(pixels.height) / static_cast<float>(s.size);
  BlockRegressionConstants constants{};
  constants.planeNear = s.planeNear;
  constants.planeFar = s.planeFar;
  constants.sdfFraction = s.sdfFraction;
  constants.ridge = s.ridge;
  constants.coarseSigma = std::max(sigma, 0.5F);
  constants.coarseRadius = static_cast<std::int32_t>(std::ceil(s.coarseReach * constants.coarseSigma));
  constants.coarseSamples = s.coarseSamples;
  return {graph, frame, pixels, blocks, s.size, constants};
}

void readAverages(fg::PassBuilder& pass, const BlockAverages& averages) {
  static constexpr std::array kBindings{"moments0", "moments1", "moments2", "moments3", "moments4"};
  for (std::size_t i = 0; i < kBindings.size(); ++i) pass.sample(kBindings.at(i), averages.moments.at(i));
  pass.sample("depth", averages.depth);
}

BlockAverages writeAverages(const BlockGrid& grid, fg::PassBuilder& pass, const std::string& suffix) {
  static constexpr std::array kBindings{"outMoments0", "outMoments1", "outMoments2", "outMoments3", "outMoments4"};
  BlockAverages averages;
  for (std::size_t i = 0; i < kBindings.size(); ++i) {
    const fg::Texture texture =
        grid.graph.texture("block moments " + std::to_string(i) + suffix, {VK_FORMAT_R32G32B32A32_UINT, grid.blocks});
    averages.moments.at(i) = pass.store(kBindings.at(i), texture);
  }
  averages.depth =
      pass.store("outDepth", grid.graph.texture("block depth" + suffix, {VK_FORMAT_R32_UINT, grid.blocks}));
  return averages;
}

BlockFits writeFits(const BlockGrid& grid, fg::PassBuilder& pass, const std::string& name) {
  const auto store = [&](const char* binding, const char* part, VkFormat format) {
    return pass.store(binding, grid.graph.texture(name + part, {format, grid.blocks}));
  };
  return {store("outFitA", " a", VK_FORMAT_R32G32B32A32_UINT), store("outFitB", " b", VK_FORMAT_R32G32B32A32_UINT),
          store("outFitC", " c", VK_FORMAT_R32G32B32A32_UINT), store("outDepth", " depth", VK_FORMAT_R32_UINT)};
}

/// The fit of a Gaussian window around every block, regardless of edges.
BlockFits addCoarseFit(const BlockGrid& grid, const BlockAverages& averages) {
  fg::PassBuilder across = grid.graph.compute("coarse fit, across", shaders::blockCoarse);
  readAverages(across, averages);
  across.constants(grid.constants).dispatch(grid.blocks);
  const BlockAverages blurred = writeAverages(grid, across, " blurred");

  fg::PassBuilder down = grid.graph.compute("coarse fit, down", shaders::blockCoarseLast);
  readAverages(down, blurred);
  down.constants(grid.constants).dispatch(grid.blocks);
  return writeFits(grid, down, "coarse fit");
}

/// The fit of an edge-aware window around every block (walr.txt 3.2).
BlockFits addFineFit(const BlockGrid& grid, BlockAverages averages, fg::Texture normal, std::uint32_t iterations) {
  std::uint32_t spacing = 1;
  for (std::uint32_t t = 0;; ++t, spacing *= 3) {
    const bool last = t + 1 == iterations;
    const std::string suffix = " " + std::to_string(t);
    fg::PassBuilder pass =
        grid.graph.compute("block a-trous" + suffix, last ? shaders::blockAtrousLast : shaders::blockAtrous);
    readAverages(pass, averages);
    pass.uniform("frameConstants", grid.frame)
        .sample("normal", normal)
        .specialize("kBlockSize", grid.size)
        .specialize("kSpacing", spacing)
        .constants(grid.constants)
        .dispatch(grid.blocks);
    if (last) return writeFits(grid, pass, "block fit");
    averages = writeAverages(grid, pass, suffix);
  }
}

}  // namespace

fg::Texture addBlockRegression(fg::Graph& graph, fg::Buffer frame, fg::Texture accumulated, LightingAlpha alpha,
                               const Guides& guides, fg::Texture occlusion, const BlockRegressionSettings& settings) {
  if (!(settings.planeNear < settings.planeFar)) {
    throw std::invalid_argument("setting blocks.plane-near must be below blocks.plane-far");
  }
  const BlockGrid grid = gridOf(graph, frame, graph.textureDesc(accumulated).extent, settings);

  // What gathers the blocks' samples and what fits them to the pixels again read the same pixels.
  const auto readPixels = [&](const char* name, const fg::Shader& shader) {
    fg::PassBuilder pass = graph.compute(name, shader);
    pass.uniform("frameConstants", frame)
        .sample("depth", guides.depth)
        .sample("shadingNormal", guides.shadingNormal)
        .sample("geometricNormal", guides.geometricNormal)
        .sample("occlusion", occlusion)
        .sample("accumulated", accumulated)
        .specialize("kAlphaIsSampleCount", alpha == LightingAlpha::SampleCount)
        .specialize("kBlockSize", grid.size)
        .constants(grid.constants);
    return pass;
  };

  fg::PassBuilder gather = readPixels("block moments", shaders::blockMoments);
  gather.dispatch(grid.blocks);
  const BlockAverages averages = writeAverages(grid, gather, "");
  const fg::Texture normal =
      gather.store("outNormal", graph.texture("block normal", {VK_FORMAT_R32_UINT, grid.blocks}));

  const BlockFits coarse = addCoarseFit(grid, averages);
  const BlockFits fine = addFineFit(grid, averages, normal, settings.iterations);

  fg::PassBuilder apply = readPixels("block apply", shaders::blockApply);
  apply.sample("fitA", fine.a)
      .sample("fitB", fine.b)
      .sample("fitC", fine.c)
      .sample("fitDepth", fine.depth)
      .sample("fitNormal", normal)
      .sample("coarseA", coarse.a)
      .sample("coarseB", coarse.b)
      .sample("coarseC", coarse.c)
      .sample("coarseDepth", coarse.depth)
      .dispatch(grid.pixels);
  return apply.store("outFiltered", graph.texture("filtered", {VK_FORMAT_R16G16B16A16_SFLOAT, grid.pixels}));
}

}  // namespace walr
