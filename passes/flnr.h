#pragma once

#include "framegraph/declare/graph.h"
#include "passes/flr.h"
#include "passes/inputs.h"
#include "passes/stage_graph.h"

namespace walr {

/// Settings of FLNR: those of FLR. Ambient occlusion is always a guide, because the network was trained beside it.
struct FlnrSettings : FlrSettings {
  void visit(SettingVisitor& v) {
    visitBefore(v);
    regression.visitFit(v);
    visitAfter(v);
  }
};

/// Fast Local Neural Regression (Salmi et al. 2024): FLR with three more guides, which a network makes of the geometric
/// guides and the noisy light. Unlike the published one it works at half the picture's width and height, keeps the
/// geometric guides, and sees accumulated light where FLR fits that. Trained by samples/training.
///
/// Experimental: the weights were trained for less than an hour, and gain little; samples/docs/training.md has figures.
/// The picture may have up to 3840 x 2160 pixels.
/// @param output RGBA16F texture to write the result to
/// @returns the output's new version
fg::Texture addFlnr(StageGraph graph, const DenoiserInputs& inputs, fg::Texture output,
                    const FlnrSettings& settings = {});

}  // namespace walr
