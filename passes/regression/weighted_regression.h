#pragma once

#include <cstdint>

#include "framegraph/declare/graph.h"
#include "passes/conventions/lighting_alpha.h"
#include "passes/guides/prepare_guides.h"
#include "passes/regression/edge_stopping.h"
#include "passes/regression/regularisation.h"
#include "passes/settings/settings.h"
#include "passes/stage/stage_graph.h"

namespace walr {

/// How moments are stored between two iterations (moments_storage.glsl).
enum class MomentStorage : std::uint32_t {
  Centred16,  ///< Means and covariances as halves, 32 bytes a pixel.
  Raw16,      ///< The paper's RGBA16F-class packing of raw averages, 28 bytes.
  Raw11,      ///< The paper's R11G11B10-class packing of raw averages, 20 bytes.
  Raw32,      ///< Raw averages in single precision, 56 bytes; for study.
};

/// What replaces a tap behind an edge (Meunier & Harada 2022, 3.3).
enum class TapReplacement : std::uint32_t {
  Off,      ///< Nothing.
  Uniform,  ///< Any pixel before the edge, picked at random.
  Near,     ///< One of the last third before the edge, picked at random.
};

/// Settings of the spatial filter (Meunier & Harada 2022, 3, 4.3, 5).
struct WeightedRegressionSettings {
  std::uint32_t iterations = 4;
  EdgeStoppingSettings edgeStopping{};
  bool traceEdges = true;
  float sdfFraction = 0.75F;
  TapReplacement replaceTaps = TapReplacement::Uniform;
  bool repeatCentre = false;
  float edgeLeak = 0.01F;
  MomentStorage storage = MomentStorage::Centred16;
  bool keepSampleCount = true;
  RegularisationSettings regularisation{};

  void visit(SettingVisitor& v) {
    static constexpr std::string_view kReplacements[] = {"off", "uniform", "near"};
    static constexpr std::string_view kStorages[] = {"centred16", "raw16", "raw11", "raw32"};
    v.visit({"regression.iterations", "A-trous iterations with taps 3^t pixels apart; n of them span 3^n x 3^n pixels",
             "", 1, 5, "Meunier & Harada 2022, 3.2"},
            iterations);
    edgeStopping.visit(v);
    v.visit({"regression.trace-edges", "Take the smallest weight along the segment to a tap, not the tap's own", "", 0,
             1, "Meunier & Harada 2022, 3.3"},
            traceEdges);
    v.visit({"regression.sdf-fraction",
             "Share of the distance to the nearest edge that edge tracing steps at once; 0 walks pixel by pixel", "",
             0.0, 1.0, "Meunier & Harada 2022, 5.2"},
            sdfFraction);
    v.visitEnum({"regression.replace-taps",
                 "Which pixel before an edge takes the place of a tap behind it: none, any, or one near the edge", "",
                 0, 1, "Meunier & Harada 2022, 3.3"},
                kReplacements, replaceTaps);
    v.visit({"regression.repeat-centre",
             "With replace-taps: count the centre again for each tap whose edge is the very next pixel", "", 0, 1,
             "Meunier & Harada 2022, 3.3"},
            repeatCentre);
    v.visit({"regression.edge-leak",
             "Weight of an adjacent pixel that is an edge, for pixels with few neighbours on their surface", "", 0.0,
             1.0, "measured"},
            edgeLeak);
    v.visitEnum({"regression.moments", "Storage of the averages between two iterations", "", 0, 1,
                 "Meunier & Harada 2022, 5.2"},
                kStorages, storage);
    v.visit({"regression.keep-sample-count", "Carry W, so that every sample weighs the same; centred16 only", "", 0, 1,
             "Meunier & Harada 2022, 3.2 and 5.2"},
            keepSampleCount);
    regularisation.visit(v);
  }
};

/// Weighted linear regression of the lighting on the normal over edge-aware a-trous averages.
/// @param frame       upload of `FrameConstants`
/// @param accumulated RGBA16F: radiance to filter; values that are not finite do not count
/// @param alpha       what the alpha channel of `accumulated` holds; pixels without samples do not count
/// @param output      RGBA16F texture to write the result to
/// @returns the output's new version: filtered radiance, alpha below 0 where the window has no sample; the
///          pass-through at sky and pixels without a diffuse lobe
/// @throws std::invalid_argument for settings that contradict each other; their ranges are the caller's to check
/// (`Configurable::checkSettings`)
fg::Texture addWeightedRegression(StageGraph graph, fg::Buffer frame, fg::Texture accumulated, LightingAlpha alpha,
                                  const Guides& guides, fg::Texture output,
                                  const WeightedRegressionSettings& settings = {});

}  // namespace walr
