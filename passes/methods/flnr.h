#pragma once

#include <array>
#include <string_view>

#include "framegraph/declare/graph.h"
#include "passes/conventions/inputs.h"
#include "passes/methods/flr.h"
#include "passes/stage/stage_graph.h"

namespace walr {

/// Settings of FLNR: those of FLR, and which network makes the guides. Ambient occlusion is always computed, because
/// the networks see it.
struct FlnrSettings : FlrSettings {
  NetworkKind network = NetworkKind::Small;

  /// Learned guides show where the light changes, so that wider windows err least (samples/docs/training.md).
  FlnrSettings() {
    regression.sigma = 8.0F;
    singleFrameSigma = 16.0F;
  }

  void visit(SettingVisitor& v) {
    static constexpr std::array<std::string_view, 3> kNetworks{"small", "paper", "full"};
    v.visitEnum({"network",
                 "small: at half the picture's width and height, three guides beside the geometric ones; paper: at the "
                 "picture's size, five guides in their place; full: at the picture's size, three guides beside them",
                 "", 0, 1, "Salmi et al. 2024; small, full: measured"},
                kNetworks, network);
    visitBefore(v);
    regression.visitFit(v);
    visitAfter(v);
  }
};

/// FLNR as published but for the accumulated light that it filters, which `spatialOnly` changes to the light of one
/// frame. The poster gives neither widths nor weights.
FlnrSettings paperFlnr();

/// FLNR with the smallest error: the network works at the picture's size, beside the geometric guides, and windows are
/// wider still.
FlnrSettings fullFlnr();

/// Fast Local Neural Regression (Salmi et al. 2024): FLR with guides that a network makes of the geometric guides and
/// the noisy light. By default the network works at half the picture's width and height, and the geometric guides stay.
/// It sees accumulated light where FLR fits that. Trained by samples/training.
///
/// Experimental: samples/docs/training.md has figures. The picture may have up to 3840 x 2160 pixels, and 2560 x 1440
/// with a network at the picture's size.
/// @param output RGBA16F texture to write the result to
/// @returns the output's new version
fg::Texture addFlnr(StageGraph graph, const DenoiserInputs& inputs, fg::Texture output,
                    const FlnrSettings& settings = {});

}  // namespace walr
