#pragma once

#include "framegraph/declare/graph.h"
#include "passes/conventions/inputs.h"
#include "passes/filters/joint_bilateral_filter.h"
#include "passes/guides/prepare_guides.h"
#include "passes/stage/stage_graph.h"
#include "passes/temporal/temporal_antialiasing.h"

namespace walr {

/// Settings of all stages of the joint bilateral denoiser.
struct JointBilateralSettings {
  bool spatialOnly = false;
  PrepareGuidesSettings guides;
  JointBilateralFilterSettings filter;
  /// Accumulation of the filtered frames (Wang 2024, 4): alpha 0.2, clamped to the 7x7 neighbourhood. The text leaves
  /// open to how many standard deviations. Filtered pixels vary little: a tight clamp would reject the previous frame
  /// for its noise alone.
  TemporalAntialiasingSettings accumulation{
      .maxHistory = 5.0F, .clipGamma = 8.0F, .clipRadius = 3, .objectIds = true, .accumulates = true};

  void visit(SettingVisitor& v) {
    v.visit({"spatial-only", "Filter each frame by itself, without temporal stages", "", 0, 1, "Wang 2024"},
            spatialOnly);
    guides.visit(v);
    filter.visit(v);
    accumulation.visit(v);
  }
};

/// Joint bilateral filter with temporal accumulation (Wang 2024, 1): denoise one frame, project the last
/// result into it, accumulate. Surfaces are told apart by the object's number, as in the text, where the host gives it,
/// and by plane and geometric normal, as in the other methods.
/// @param output RGBA16F texture to write the result to
/// @returns the output's new version
fg::Texture addJointBilateral(StageGraph graph, const DenoiserInputs& inputs, fg::Texture output,
                              const JointBilateralSettings& settings = {});

}  // namespace walr
