#pragma once

#include <cstdint>
#include <stdexcept>

#include "framegraph/declare/graph.h"
#include "passes/guides/prepare_guides.h"
#include "passes/settings/settings.h"

namespace walr {

/// Which normal spans the plane of the edge-stopping function.
enum class PlaneNormal : std::uint32_t { Geometric, Shading };

/// Settings of the edge-stopping function: how far from the tangent plane of a window's centre a pixel may lie.
struct EdgeStoppingSettings {
  float planeNear = 0.0015F;
  float planeFar = 0.015F;
  PlaneNormal planeNormal = PlaneNormal::Geometric;
  bool normalFactor = true;

  void visit(SettingVisitor& v) {
    static constexpr std::string_view kPlaneNormals[] = {"geometric", "shading"};
    v.visit({"regression.plane-near", "Distance from the plane up to which a pixel counts in full; below plane-far",
             "fraction of depth", 0.0, 1.0, "Meunier & Harada 2022, 4.3"},
            planeNear);
    v.visit({"regression.plane-far", "Distance from the plane from which a pixel is an edge", "fraction of depth", 1e-6,
             1.0, "Meunier & Harada 2022, 4.3"},
            planeFar);
    v.visitEnum({"regression.plane-normal", "Normal that spans the plane", "", 0, 1, "Meunier & Harada 2022, 4.3"},
                kPlaneNormals, planeNormal);
    v.visit(
        {"regression.normal-factor", "Weigh pixels by the cosine between the planes' normals", "", 0, 1, "measured"},
        normalFactor);
  }

  /// The guide that spans the plane.
  [[nodiscard]] fg::Texture normalOf(const Guides& guides) const {
    return planeNormal == PlaneNormal::Shading ? guides.shadingNormal : guides.geometricNormal;
  }

  /// @throws std::invalid_argument if planeNear is not below planeFar
  void check() const {
    if (!(planeNear < planeFar)) {
      throw std::invalid_argument("setting regression.plane-near must be below regression.plane-far");
    }
  }
};

}  // namespace walr
