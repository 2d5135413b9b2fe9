#pragma once

#include <cstdint>

#include "framegraph/graph.h"
#include "passes/edge_stopping.h"
#include "passes/prepare_guides.h"
#include "passes/regularisation.h"
#include "passes/settings.h"

namespace walr {

/// How moments are stored between two iterations (moments_storage.glsl).
enum class MomentStorage : std::uint32_t {
  Centred16,  ///< Means and covariances as halves, 32 bytes a pixel.
  Raw16,      ///< The paper's RGBA16F-class packing of raw averages, 28 bytes.
  Raw11,      ///< The paper's R11G11B10-class packing of raw averages, 20 bytes.
  Raw32,      ///< Raw averages in single precision, 56 bytes; for study.
};

/// Settings of the spatial filter (walr.txt 3, 4.3, 5).
struct WeightedRegressionSettings {
  std::uint32_t iterations = 4;
  EdgeStoppingSettings edgeStopping{};
  bool traceEdges = true;
  float sdfFraction = 0.75F;
  bool replaceTaps = true;
  MomentStorage storage = MomentStorage::Centred16;
  bool keepSampleCount = true;
  RegularisationSettings regularisation{};

  void visit(SettingVisitor& v) {
    static constexpr std::string_view kStorages[] = {"centred16", "raw16", "raw11", "raw32"};
    v.visit({"regression.iterations", "A-trous iterations with taps 3^t pixels apart; n of them span 3^n x 3^n pixels",
             "", 1, 5, "walr.txt 3.2"},
            iterations);
    edgeStopping.visit(v);
    v.visit({"regression.trace-edges", "Take the smallest weight along the segment to a tap, not the tap's own", "", 0,
             1, "walr.txt 3.3"},
            traceEdges);
    v.visit({"regression.sdf-fraction",
             "Share of the distance to the nearest edge that edge tracing steps at once; 0 walks pixel by pixel", "",
             0.0, 1.0, "walr.txt 5.2"},
            sdfFraction);
    v.visit({"regression.replace-taps", "Replace a tap behind an edge by a random pixel before it", "", 0, 1,
             "walr.txt 3.3"},
            replaceTaps);
    v.visitEnum({"regression.moments", "Storage of the averages between two iterations", "", 0, 1, "walr.txt 5.2"},
                kStorages, storage);
    v.visit({"regression.keep-sample-count", "Carry W, so that every sample weighs the same; centred16 only", "", 0, 1,
             "walr.txt 3.2, 5.2"},
            keepSampleCount);
    regularisation.visit(v);
  }
};

/// Weighted linear regression of the lighting on the normal over edge-aware a-trous averages.
/// @param frame       upload of `FrameConstants`
/// @param accumulated RGBA16F: radiance to filter
/// @returns RGBA16F: filtered radiance; sky and pixels without a diffuse lobe as they were
/// @throws std::invalid_argument for settings outside their range
fg::Texture addWeightedRegression(fg::Graph& graph, fg::Buffer frame, fg::Texture accumulated, const Guides& guides,
                                  const WeightedRegressionSettings& settings = {});

}  // namespace walr
