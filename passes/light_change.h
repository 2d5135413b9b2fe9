#pragma once

#include <cstdint>

#include "framegraph/declare/graph.h"
#include "passes/settings.h"

namespace walr {

/// Settings of how temporal accumulation responds to light that changes where no motion vector tells: a lamp that goes
/// out, a door that opens, a light or a caster of shadows that moves.
struct LightChangeSettings {
  bool respond = false;
  std::uint32_t radius = 2;
  float scoreLow = 2.0F;
  float scoreHigh = 4.0F;

  void visit(SettingVisitor& v) {
    v.visit({"accumulation.respond-to-change",
             "Shorten history where the light of a window differs from it by more than chance", "", 0, 1, "measured"},
            respond);
    v.visit(
        {"accumulation.change-radius", "Reach of that window around a tile of 8 x 8 pixels", "tiles", 0, 8, "measured"},
        radius);
    v.visit({"accumulation.change-low", "Difference up to which history counts in full; below change-high",
             "standard errors", 0.0, 100.0, "measured"},
            scoreLow);
    v.visit({"accumulation.change-high", "Difference from which history counts as one sample", "standard errors", 0.0,
             100.0, "measured"},
            scoreHigh);
  }
};

/// What temporal accumulation and the detection of change hand each other: by tiles of 8 x 8 pixels.
struct LightChange {
  fg::History doubt;  ///< R32_SFLOAT: 0 where history counts in full, 1 where as one sample.
  /// R32G32_SFLOAT: over a tile, the sum of the luminance of this frame's samples less that of history, and the sum of
  /// its squares.
  fg::Texture tiles;
};

/// Declare the textures.
/// @param pixels the picture's extent
LightChange declareLightChange(fg::Graph& graph, fg::Extent pixels);

/// Detect where the light has changed, for the next frame.
/// @param change as the accumulation of this frame left it
/// @throws std::invalid_argument where the settings contradict each other
void addLightChange(fg::Graph& graph, const LightChange& change, const LightChangeSettings& settings);

}  // namespace walr
