#pragma once

#include <cstdint>

#include "framegraph/graph.h"
#include "passes/prepare_guides.h"
#include "passes/settings.h"

namespace walr {

/// How moments are stored between two iterations (moments_storage.glsl).
enum class MomentStorage : std::uint32_t {
  Centred16,  ///< Means and covariances as halves, 32 bytes a pixel.
  Raw16,      ///< The paper's RGBA16F-class packing of raw averages, 28 bytes.
  Raw11,      ///< The paper's R11G11B10-class packing of raw averages, 20 bytes.
  Raw32,      ///< Raw averages in single precision, 56 bytes; for study.
};

/// How the normal equations are kept solvable.
enum class Regularisation : std::uint32_t {
  Ridge,  ///< A ridge on the diagonal that grows with the noise of the mean.
  Floor,  ///< Pivots are floored (walr.txt, algorithm 1).
};

/// Which normal spans the plane of the edge-stopping function.
enum class PlaneNormal : std::uint32_t { Geometric, Shading };

/// Settings of the spatial filter (walr.txt 3, 4.3, 5).
struct WeightedRegressionSettings {
  std::uint32_t iterations = 4;
  float planeNear = 0.0015F;
  float planeFar = 0.015F;
  PlaneNormal planeNormal = PlaneNormal::Geometric;
  bool normalFactor = true;
  bool traceEdges = true;
  float sdfFraction = 0.75F;
  bool replaceTaps = true;
  MomentStorage storage = MomentStorage::Centred16;
  bool keepSampleCount = true;
  Regularisation regularisation = Regularisation::Ridge;
  float ridge = 1e-3F;
  float noiseRidge = 3.0F;

  void visit(SettingVisitor& v) {
    static constexpr std::string_view kPlaneNormals[] = {"geometric", "shading"};
    static constexpr std::string_view kStorages[] = {"centred16", "raw16", "raw11", "raw32"};
    static constexpr std::string_view kRegularisations[] = {"ridge", "floor"};
    v.visit({"regression.iterations", "A-trous iterations with taps 3^t pixels apart; n of them span 3^n x 3^n pixels",
             "", 1, 5, "walr.txt 3.2"},
            iterations);
    v.visit({"regression.plane-near", "Distance from the plane up to which a pixel counts in full; below plane-far",
             "fraction of depth", 0.0, 1.0, "walr.txt 4.3"},
            planeNear);
    v.visit({"regression.plane-far", "Distance from the plane from which a pixel is an edge", "fraction of depth", 1e-6,
             1.0, "walr.txt 4.3"},
            planeFar);
    v.visitEnum({"regression.plane-normal", "Normal that spans the plane", "", 0, 1, "walr.txt 4.3"}, kPlaneNormals,
                planeNormal);
    v.visit({"regression.normal-factor", "Weigh taps by the cosine between the normals of the planes", "", 0, 1,
             "measured"},
            normalFactor);
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
    v.visitEnum({"regression.regularisation", "How the normal equations are kept solvable", "", 0, 1,
                 "walr.txt 3.1, algorithm 1"},
                kRegularisations, regularisation);
    v.visit({"regression.ridge",
             "Ridge on, or floor under, the diagonal of the covariance of the features, which lie in 0..1", "", 1e-9,
             1.0, "measured"},
            ridge);
    v.visit({"regression.noise-ridge", "Further ridge per unit of relative variance of a sample over the sample count",
             "", 0.0, 1e3, "measured"},
            noiseRidge);
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
