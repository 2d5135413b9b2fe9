#pragma once

#include <cstdint>

#include "framegraph/graph.h"
#include "passes/prepare_guides.h"
#include "passes/settings.h"
#include "passes/tile_lists.h"

namespace walr {

/// Settings of the ambient occlusion that serves as a feature.
struct AmbientOcclusionSettings {
  float radius = 0.075F;
  std::uint32_t steps = 5;

  void visit(SettingVisitor& v) {
    v.visit({"occlusion.radius", "Distance that the search for occluders reaches", "fraction of the image's height",
             0.002, 0.5, "measured"},
            radius);
    v.visit(
        {"occlusion.steps", "Pixels that the search looks at in each of its eight directions", "", 1, 16, "measured"},
        steps);
  }
};

/// Ambient occlusion of every pixel, from depth alone and without noise.
/// @param frame upload of `FrameConstants`
/// @param tiles where given, only their tiles with surfaces get a value
/// @returns R8_UNORM: mean sine of the horizon above the tangent plane, 0 (open) to 1; 0 where there is no surface
fg::Texture addAmbientOcclusion(fg::Graph& graph, fg::Buffer frame, const Guides& guides,
                                const AmbientOcclusionSettings& settings = {}, const TileLists* tiles = nullptr);

}  // namespace walr
