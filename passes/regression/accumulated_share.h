#pragma once

#include <cstdint>
#include <optional>

#include "framegraph/declare/graph.h"
#include "passes/guides/prepare_guides.h"
#include "passes/settings/settings.h"
#include "passes/stage/stage_graph.h"

namespace walr {

/// Settings of the accumulated light's share in the reconstruction. Accumulated light supplies the detail that the fits
/// over blocks miss, as far as two halves of its samples agree on it (passes/WALR.md, 9).
struct AccumulatedShareSettings {
  bool enabled = true;
  float frames = 8.0F;
  std::uint32_t radius = 5;
  float gain = 8.0F;
  float edgeGain = 16.0F;
  float leastShare = 0.6F;
  float innovationGain = 2.0F;
  float innovationBias = 1.28F;
  float antialiasingShare = 0.3F;

  void visit(SettingVisitor& v) {
    v.visit({"blocks.residual",
             "Add accumulated light to the result where this frame and the history agree that the fits miss something, "
             "and shorten history where it blurs more than noise asks for; no effect on sparse light or with "
             "spatial-only",
             "", 0, 1, "measured"},
            enabled);
    v.visit({"blocks.residual-gain",
             "Factor of the agreement, which comes out too small where reprojection has blurred history", "", 0.0, 64.0,
             "measured"},
            gain);
    v.visit({"blocks.innovation-gain",
             "With antilag: how fast the history length follows the correlation of innovations, the differences of new "
             "samples from history; 0: not at all",
             "", 0.0, 4.0, "Mehra 1970"},
            innovationGain);
    v.visit({"blocks.residual-antialiasing",
             "With antilag, in frames without jitter: anti-aliasing shortens its history where the share of the "
             "accumulated light in a tile is above this. Where the share is 0.5 above, no history is left. 1: nowhere",
             "", 0.0, 1.0, "measured"},
            antialiasingShare);
  }
};

/// The history lengths that the temporal stages may use. The passes of the share measure them for the next frame.
struct SteeredHistory {
  /// R32G32_SFLOAT, a texel for each tile of antilag: the least antilag factor that the measured noise allows; how far
  /// anti-aliasing shortens its history, from 0 (not at all) to 1 (to none).
  fg::History limits;
  float maxHistory;  ///< Frames: `TemporalAccumulationSettings::maxHistory`.
};

/// Declare it before antilag, which reads `limits.previous`.
/// @param pixels the image's extent
SteeredHistory declareSteeredHistory(StageGraph graph, fg::Extent pixels, float maxHistory);

/// What the share is measured on.
struct AccumulatedShareInputs {
  fg::Buffer frame;         ///< Upload of `FrameConstants`.
  fg::Texture accumulated;  ///< Radiance; alpha: history length. RGBA16F or packed.
  fg::Texture lighting;     ///< This frame's noisy light.
  fg::Texture antilag;      ///< `AccumulatedLight::antilag`.
  Guides guides;
  fg::Texture blockDepth;                 ///< `BlockFits::depth`.
  std::uint32_t blockSize;                ///< Pixels per axis.
  std::uint32_t tileSize;                 ///< Pixels per axis of a workgroup of the reconstruction.
  std::uint32_t tileOffset;               ///< Pixels of the first one that lie before the image, per axis.
  fg::Extent tiles;                       ///< Number of these workgroups.
  std::optional<SteeredHistory> history;  ///< Without it, no pass reads the measured length.
};

/// Let the reconstruction `apply` (a variant RESIDUAL of block_apply.comp) mix its result with the accumulated light,
/// and add the pass that measures the share for the next frame.
void addAccumulatedShare(StageGraph graph, fg::PassBuilder& apply, const AccumulatedShareInputs& inputs,
                         const AccumulatedShareSettings& settings);

}  // namespace walr
