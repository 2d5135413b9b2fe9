#pragma once

#include <cstdint>
#include <limits>

#include "framegraph/declare/graph.h"
#include "passes/guides/prepare_guides.h"
#include "passes/settings/settings.h"
#include "passes/stage/stage_graph.h"

namespace walr {

/// Settings of the joint bilateral filter (Wang 2024, 2). An infinite sigma switches its term off.
struct JointBilateralFilterSettings {
  static constexpr float kInfinity = std::numeric_limits<float>::infinity();

  std::uint32_t radius = 16;
  float sigmaPosition = 5.0F;
  float sigmaColour = kInfinity;
  float sigmaNormal = 0.2F;
  float sigmaPlane = 0.4F;

  void visit(SettingVisitor& v) {
    const auto infinity = static_cast<double>(kInfinity);
    v.visit({"bilateral.radius", "Radius of the window; 16 is a window of 33x33", "pixels", 1, 64, "Wang 2024, 2"},
            radius);
    v.visit({"bilateral.sigma-position", "Standard deviation of the Gaussian of the distance in the image", "pixels",
             0.1, infinity, "measured"},
            sigmaPosition);
    v.visit({"bilateral.sigma-colour", "Standard deviation of the Gaussian of the distance in colour",
             "mean luminance of the window", 1e-3, infinity, "measured; Wang 2024, 5: 10"},
            sigmaColour);
    v.visit({"bilateral.sigma-normal", "Standard deviation of the Gaussian of the angle between normals", "radians",
             1e-3, infinity, "measured"},
            sigmaNormal);
    v.visit({"bilateral.sigma-plane", "Standard deviation of the Gaussian of the sine of the angle to the plane", "",
             1e-3, infinity, "measured"},
            sigmaPlane);
  }
};

/// Joint bilateral filter of one noisy frame.
/// @param frame    upload of `FrameConstants`
/// @param lighting RGBA16F: noisy radiance; a pixel that is not finite is no sample
/// @param output   RGBA16F texture to write the result to
/// @returns the output's new version; sky and pixels without a diffuse lobe as they were
fg::Texture addJointBilateralFilter(StageGraph graph, fg::Buffer frame, fg::Texture lighting, const Guides& guides,
                                    fg::Texture output, const JointBilateralFilterSettings& settings = {});

}  // namespace walr
