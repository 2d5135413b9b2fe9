#pragma once

#include <cstdint>
#include <optional>

#include "framegraph/declare/graph.h"
#include "passes/settings/settings.h"
#include "passes/stage/stage_graph.h"

namespace walr {

/// Settings of antilag: it shortens the history of temporal accumulation where the light changes although no surface
/// moves: a lamp goes out, a door opens, a light or an object that casts a shadow moves.
struct AntilagSettings {
  bool enabled = false;
  std::uint32_t radius = 3;
  float scoreLow = 2.0F;
  float scoreHigh = 4.3F;
  float fireflies = 14.0F;

  void visitEnabled(SettingVisitor& v) {
    v.visit({"accumulation.antilag", "Shorten history where the light has changed by more than noise explains", "", 0,
             1, "measured"},
            enabled);
  }
  void visit(SettingVisitor& v) {
    visitEnabled(v);
    v.visit({"accumulation.antilag-low",
             "With antilag: change of the light up to which history counts in full; below antilag-high",
             "standard errors", 0.0, 100.0, "measured"},
            scoreLow);
    v.visit({"accumulation.antilag-high", "With antilag: change of the light from which history does not count",
             "standard errors", 0.0, 100.0, "measured"},
            scoreHigh);
    v.visit({"accumulation.fireflies",
             "With antilag: samples of a window's history that must be about as bright as one that passes whole; "
             "brighter ones are held back; 0: off",
             "samples", 0.0, 1000.0, "measured"},
            fireflies);
  }
};

/// Textures that temporal accumulation and antilag exchange: a texel for each tile of 8 x 8 pixels.
struct Antilag {
  /// R16G16_SFLOAT: 0 where history counts in full, 1 where it does not count, below 0 where it may be longer at rest;
  /// the brightest sample that the next frame lets pass. With `innovations`, R16G16B16A16_SFLOAT: also sums over a
  /// window of the products of a tile's d in successive frames, and of the squares of the former, which fade.
  fg::History factor;
  /// R32G32B32A32_SFLOAT: sums over a tile of d and d^2, where d is the luminance of this frame's sample less that of
  /// history, of squares of samples, and the number of samples.
  fg::Texture tiles;
  /// `SteeredHistory::limits` of the previous frame, or invalid.
  fg::Texture steering;
  /// R32_SFLOAT: the sum of d, which tells how much longer history may be at rest.
  std::optional<fg::History> innovations;
};

/// The longest history of accumulation, frames, and how many times as long it may be at rest.
struct LongestHistory {
  float frames;
  float restFactor = 1.0F;
};

/// What antilag says of this frame.
struct AntilagResult {
  fg::Texture factor;  ///< `Antilag::factor` of this frame.
  /// With `Antilag::innovations`, R32_UINT, a texel for each tile: bits of a float, how far
  /// anti-aliasing shortens its history, from 0 (not at all) to 1 (to none), or below 0, how much longer at rest it may
  /// be: -3 is four times as long. An integer, so that other textures can stand in for it where it is not read.
  fg::Texture shortening;
};

/// Declare the textures.
/// @param pixels the image's extent
/// @param steering `Antilag::steering`
/// @param growsAtRest history may be longer at rest, as it may be with `steering`
Antilag declareAntilag(StageGraph graph, fg::Extent pixels, fg::Texture steering = {}, bool growsAtRest = false);

/// Tiles of an image.
fg::Extent antilagTiles(fg::Extent pixels);

/// Add the pass that computes the antilag factor of this frame. Accumulation reads it in the next frame.
/// @param antilag as the accumulation of this frame wrote it
/// @param frame   upload of `FrameConstants`. Read with `Antilag::innovations` only
/// @throws std::invalid_argument if antilag-low is not below antilag-high
AntilagResult addAntilag(StageGraph graph, const Antilag& antilag, const AntilagSettings& settings,
                         const LongestHistory& longest, fg::Buffer frame = {});

}  // namespace walr
