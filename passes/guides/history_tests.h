#pragma once

#include <cstdint>
#include <string_view>

#include "passes/settings/settings.h"

namespace walr {

/// How a stage decides whether a history pixel shows the same surface (reprojection.glsl).
enum class HistoryRejection : std::uint32_t {
  Plane,  ///< By its distance from the surface's plane and by its geometric normal.
  Depth,  ///< By its depth, compared with the depth that motion predicts (Meunier & Harada 2022, 4.2).
  None,   ///< Not tested: every pixel with a history is accepted.
};

/// Where these tests end.
struct HistoryThresholds {
  float planeTolerance = 0.01F;  ///< Largest distance from the plane or, by depth, from the depth; fraction of depth.
  float normalThreshold = 0.5F;  ///< Smallest cosine between the geometric normals.

  friend bool operator==(const HistoryThresholds&, const HistoryThresholds&) = default;
};

/// Of methods that lose more by light of another surface in their history than by noise (passes/LEARNT.md, "History of
/// accumulation").
inline constexpr HistoryThresholds kStrictThresholds{.planeTolerance = 0.005F, .normalThreshold = 0.9F};

/// Visit the setting that chooses how a stage tests its history pixels.
inline void visitRejection(SettingVisitor& v, std::string_view name, HistoryRejection& rejection) {
  static constexpr std::string_view kRejections[] = {"plane", "depth", "none"};
  v.visitEnum(
      {name, "Test whether a history pixel shows the same surface", "", 0, 1, "Meunier & Harada 2022, 4.2 and 4.4"},
      kRejections, rejection);
}

/// Visit the thresholds under the names that a stage gives them.
inline void visitThresholds(SettingVisitor& v, std::string_view planeToleranceName,
                            std::string_view normalThresholdName, HistoryThresholds& thresholds,
                            LightKinds lights = {}) {
  v.visit({planeToleranceName,
           "Largest distance of a history pixel from the surface's plane or, with rejection depth, from its depth",
           "fraction of depth", 0.0, 1.0, "measured", lights},
          thresholds.planeTolerance);
  v.visit({normalThresholdName,
           "Smallest cosine between geometric normals of surface and history pixel, of specular light between shading "
           "normals",
           "", -1.0, 1.0, "measured", lights},
          thresholds.normalThreshold);
}

}  // namespace walr
