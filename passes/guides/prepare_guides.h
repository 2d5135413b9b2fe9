#pragma once

#include <cstdint>
#include <optional>

#include "framegraph/declare/graph.h"
#include "passes/conventions/inputs.h"
#include "passes/settings/settings.h"
#include "passes/stage/stage_graph.h"
#include "shaders/guides/prepare_guides.h"

namespace walr {

/// Settings of the conversion from the host's G-buffer.
struct PrepareGuidesSettings {
  float albedoThreshold = 0.01F;
  float tangentTolerance = 0.25F;
  float normalAgreement = 0.3F;

  friend bool operator==(const PrepareGuidesSettings&, const PrepareGuidesSettings&) = default;

  void visit(SettingVisitor& v) {
    v.visit({"guides.albedo-threshold",
             "A pixel is treated like sky if the albedo of the light's lobe is below this in every channel; 0 leaves "
             "the albedo unread",
             "", 0.0, 1.0, "measured"},
            albedoThreshold);
  }
};

/// Settings of the ambient occlusion that serves as a feature.
struct AmbientOcclusionSettings {
  float radius = 0.075F;
  std::uint32_t rings = 4;

  friend bool operator==(const AmbientOcclusionSettings&, const AmbientOcclusionSettings&) = default;

  void visit(SettingVisitor& v) {
    v.visit({"occlusion.radius", "Distance that the search for occluders reaches", "fraction of the image's height",
             0.002, 0.5, "measured"},
            radius);
    v.visit(
        {"occlusion.rings", "Rings of four pixels that the search looks at, on the axes and on the diagonals in turn",
         "", 1, kMaxOcclusionRings, "measured"},
        rings);
  }
};

/// The noise-free guides of this frame and the previous one. A guide that is not needed is not valid.
struct Guides {
  fg::Texture depth;            ///< R32_UINT: view depth, and in the bits below it the distance to an edge or, with
                                ///< `features`, the geometric normal (surface.glsl); 0: nothing to denoise.
  fg::Texture shadingNormal;    ///< R32_UINT: octahedral map of the shading normal; not valid if `features` is.
  fg::Texture features;         ///< R32_UINT: the shading normal, and ambient occlusion, 0 (open) to 1 (surface.glsl).
  fg::Texture geometricNormal;  ///< R32_UINT: octahedral map of the geometric normal, which spans planes. Not valid if
                                ///< nothing needs it, or if `features` is valid: then `depth` holds it.
  fg::Texture previousDepth;    ///< Depth one frame ago; zero while there is no history.
  fg::Texture previousGeometricNormal;  ///< Geometric normal one frame ago; zero while there is no history.
};

/// The guides that later stages read; others are not made.
struct GuideNeeds {
  bool geometricNormal = true;
  bool history = true;        ///< Last frame's depth, and geometric normal where there is one.
  bool normalHistory = true;  ///< If not, `history` leaves out a geometric normal that is apart.
  std::optional<AmbientOcclusionSettings> occlusion = {};  ///< If set, `Guides::features` is made.

  friend bool operator==(const GuideNeeds&, const GuideNeeds&) = default;
};

/// Convert the host's G-buffer once into the guides that all later stages read. Where lights share guides
/// (`SharedGuides`), only the first one's are made.
/// @throws std::invalid_argument if the guides of the first light were made with other settings
Guides addPrepareGuides(StageGraph graph, const DenoiserInputs& inputs, const PrepareGuidesSettings& settings = {},
                        const GuideNeeds& needs = {});

}  // namespace walr
