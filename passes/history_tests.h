#pragma once

#include <string_view>

#include "passes/settings.h"

namespace walr {

/// Visit the two limits that every stage with a history tests its history pixels by (reprojection.glsl).
inline void visitHistoryTests(SettingVisitor& v, std::string_view planeToleranceName, float& planeTolerance,
                              std::string_view normalThresholdName, float& normalThreshold) {
  v.visit({planeToleranceName, "Largest distance of a history pixel from the surface's plane", "fraction of depth", 0.0,
           1.0, "measured"},
          planeTolerance);
  v.visit({normalThresholdName, "Smallest cosine between geometric normals of surface and history pixel", "", -1.0, 1.0,
           "measured"},
          normalThreshold);
}

}  // namespace walr
