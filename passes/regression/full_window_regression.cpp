#include "passes/regression/full_window_regression.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "passes/stage/pass_through.h"
#include "shaders/regression/full_window.h"
#include "shaders/shaders.h"

namespace walr {

std::uint32_t fullWindowTile(std::uint32_t window) {
  // The 8 d pixels of the square ring at distance d take d steps each.
  const std::uint64_t r = window / 2;
  const std::uint64_t weights = std::max<std::uint64_t>(8 * r * (r + 1) * (2 * r + 1) / 6, 1);
  const double side = std::sqrt(double(kMostWeightsPerDispatch) / double(weights));
  constexpr double kLargestTile = 4096.0;
  return std::max(static_cast<std::uint32_t>(std::min(side, kLargestTile)) / 8 * 8, 8U);
}

fg::Texture addFullWindowRegression(StageGraph graph, fg::Buffer frame, fg::Texture accumulated, const Guides& guides,
                                    fg::Texture output, const FullWindowSettings& settings) {
  settings.edgeStopping.check();
  if (settings.window % 2 == 0) {
    throw std::invalid_argument("setting regression.window must be odd, so that the window has a centre; it is " +
                                std::to_string(settings.window));
  }
  const fg::Extent extent = graph.textureDesc(accumulated).extent;
  const std::uint32_t tile = fullWindowTile(settings.window);
  // Tiles write in place over a copy of the input, so that pixels without a surface keep the pass-through.
  fg::Texture filtered = addPassThrough(graph, accumulated, output);
  for (std::uint32_t y = 0; y < extent.height; y += tile) {
    for (std::uint32_t x = 0; x < extent.width; x += tile) {
      const fg::Extent size{std::min(tile, extent.width - x), std::min(tile, extent.height - y)};
      FullWindowConstants constants{};
      constants.begin = {x, y};
      constants.end = {x + size.width, y + size.height};
      constants.planeNear = settings.edgeStopping.planeNear;
      constants.planeFar = settings.edgeStopping.planeFar;
      constants.ridge = settings.regularisation.ridge;
      constants.noiseRidge = settings.regularisation.noiseRidge;
      fg::PassBuilder pass =
          graph.compute("full window at " + std::to_string(x) + ", " + std::to_string(y), shaders::fullWindow);
      pass.uniform("frameConstants", frame)
          .sample("depth", guides.depth)
          .sample("planeNormal", settings.edgeStopping.normalOf(guides))
          .sample("shadingNormal", guides.shadingNormal)
          .sample("accumulated", accumulated)
          .specialize("kRadius", settings.window / 2)
          .specialize("kNormalFactor", settings.edgeStopping.normalFactor)
          .specialize("kPivotFloor", settings.regularisation.method == Regularisation::Floor)
          .constants(constants)
          .dispatch(size);
      filtered = pass.update("outFiltered", filtered);
    }
  }
  return filtered;
}

}  // namespace walr
