#pragma once

#include <cstdint>

#include "framegraph/declare/graph.h"
#include "passes/edge_stopping.h"
#include "passes/prepare_guides.h"
#include "passes/regularisation.h"
#include "passes/settings.h"

namespace walr {

/// Settings of the regression over a full window.
struct FullWindowSettings {
  std::uint32_t window = 81;
  EdgeStoppingSettings edgeStopping{};
  RegularisationSettings regularisation{};

  void visit(SettingVisitor& v) {
    v.visit({"regression.window", "Side of the window; odd", "pixels", 1, 105, "Meunier & Harada 2022, 6"}, window);
    edgeStopping.visit(v);
    regularisation.visit(v);
  }
};

/// The most edge-stopping weights that one dispatch works out. At some 40 operations each, a GPU of 1 TFLOP/s takes a
/// third of a second for them; the shortest usual watchdog waits for two.
inline constexpr std::uint64_t kMostWeightsPerDispatch = std::uint64_t{1} << 33;

/// Side of the square tiles, pixels, a multiple of a work group's 8: at least 8, and otherwise so large that a dispatch
/// stays within `kMostWeightsPerDispatch` where no line meets an edge.
std::uint32_t fullWindowTile(std::uint32_t window);

/// Weighted linear regression of the lighting on the normal over every pixel of a window, edges traced from its centre
/// to each of them: REFWLR's filter, which WALR's approximates. No a-trous averages and no replacement. One dispatch a
/// tile.
/// @param frame       upload of `FrameConstants`
/// @param accumulated RGBA16F: radiance to filter; alpha: samples behind it, 0: the pixel weighs nothing
/// @param output      RGBA16F texture to write the result to
/// @returns the output's new version: filtered radiance; sky and pixels without a diffuse lobe as they were; black
/// where
///          the window holds no sample at all
/// @throws std::invalid_argument for settings outside their range
fg::Texture addFullWindowRegression(fg::Graph& graph, fg::Buffer frame, fg::Texture accumulated, const Guides& guides,
                                    fg::Texture output, const FullWindowSettings& settings = {});

}  // namespace walr
