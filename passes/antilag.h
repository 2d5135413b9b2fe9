#pragma once

#include <cstdint>

#include "framegraph/declare/graph.h"
#include "passes/settings.h"

namespace walr {

/// Settings of antilag: temporal accumulation shortens its history where light changes and no motion vector tells: a
/// lamp goes out, a door opens, a light or a caster of shadows moves.
struct AntilagSettings {
  bool enabled = false;
  std::uint32_t radius = 2;
  float scoreLow = 2.0F;
  float scoreHigh = 4.0F;

  void visit(SettingVisitor& v) {
    v.visit({"accumulation.antilag",
             "Shorten history where the light of a window differs from it by more than noise explains", "", 0, 1,
             "measured"},
            enabled);
    v.visit({"accumulation.antilag-radius", "Reach of that window around a tile of 8 x 8 pixels", "tiles", 0, 8,
             "measured"},
            radius);
    v.visit({"accumulation.antilag-low", "Difference up to which history counts in full; below antilag-high",
             "standard errors", 0.0, 100.0, "measured"},
            scoreLow);
    v.visit({"accumulation.antilag-high", "Difference from which history counts as one sample", "standard errors", 0.0,
             100.0, "measured"},
            scoreHigh);
  }
};

/// What temporal accumulation and antilag hand each other: by tiles of 8 x 8 pixels.
struct Antilag {
  fg::History factor;  ///< R32_SFLOAT: 0 where history counts in full, 1 where it counts as one sample.
  /// R32G32_SFLOAT: over a tile, the sum of the luminance of this frame's samples less that of history, and the sum of
  /// its squares.
  fg::Texture tiles;
};

/// Declare the textures.
/// @param pixels the picture's extent
Antilag declareAntilag(fg::Graph& graph, fg::Extent pixels);

/// Find where the light has changed, for the next frame.
/// @param antilag as the accumulation of this frame left it
/// @throws std::invalid_argument where the settings contradict each other
void addAntilag(fg::Graph& graph, const Antilag& antilag, const AntilagSettings& settings);

}  // namespace walr
