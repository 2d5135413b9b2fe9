#pragma once

#include <cstdint>

#include "framegraph/declare/graph.h"
#include "passes/guides/prepare_guides.h"
#include "passes/regression/edge_stopping.h"
#include "passes/regression/regularisation.h"
#include "passes/settings/settings.h"
#include "passes/stage/stage_graph.h"

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

/// The largest number of edge-stopping weights that one dispatch computes. At about 40 operations each, a GPU of 1
/// TFLOP/s takes a third of a second; the shortest usual watchdog waits two seconds.
inline constexpr std::uint64_t kMostWeightsPerDispatch = std::uint64_t{1} << 33;

/// Side of the square tiles in pixels, a multiple of 8, the workgroup's. It is 8 or the largest side whose dispatch
/// stays within `kMostWeightsPerDispatch` even if no line meets an edge.
std::uint32_t fullWindowTile(std::uint32_t window);

/// REFWLR's filter, which WALR's approximates: weighted linear regression of the lighting on the normal over every
/// pixel of a window, with edges traced from the window's centre to each pixel. No a-trous averages and no replacement
/// of taps. One dispatch per tile.
/// @param frame       upload of `FrameConstants`
/// @param accumulated RGBA16F: radiance to filter; alpha: history length, 0: the pixel has no weight
/// @param output      RGBA16F texture to write the result to
/// @returns the output's new version: filtered radiance, alpha below 0 where the window has no sample; the pass-through
/// at sky and pixels without a diffuse lobe
/// @throws std::invalid_argument for settings that contradict each other; their ranges are the caller's to check
/// (`Configurable::checkSettings`)
fg::Texture addFullWindowRegression(StageGraph graph, fg::Buffer frame, fg::Texture accumulated, const Guides& guides,
                                    fg::Texture output, const FullWindowSettings& settings = {});

}  // namespace walr
