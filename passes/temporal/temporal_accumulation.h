#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "framegraph/declare/graph.h"
#include "passes/conventions/inputs.h"
#include "passes/conventions/light_storage.h"
#include "passes/guides/history_tests.h"
#include "passes/guides/prepare_guides.h"
#include "passes/settings/settings.h"
#include "passes/stage/stage_graph.h"
#include "passes/temporal/antilag.h"

namespace walr {

/// The filter that reads a history texture between pixels.
enum class HistoryFilter : std::uint32_t { Bilinear, Bicubic };

/// Settings of the preprocessing accumulation (Meunier & Harada 2022, 4.2).
struct TemporalAccumulationSettings {
  float maxHistory = 16.0F;
  /// With antilag, history at rest is at most so many times as long. A setting of `walr` only.
  float restFactor = 1.0F;
  HistoryRejection rejection = HistoryRejection::Plane;
  HistoryThresholds thresholds = {};
  HistoryFilter historyFilter = HistoryFilter::Bilinear;
  bool dilateMotion = false;
  AntilagSettings antilag = {};
  LightStorage storage = LightStorage::Half;

  /// @param lights that follow it; the other kind has a setting of its own
  void visitMaxHistory(SettingVisitor& v, LightKinds lights = {}) {
    v.visit({"accumulation.max-history", "Frames after which the cumulative mean turns exponential", "frames", 1.0,
             255.0, "Meunier & Harada 2022, 4.2", lights},
            maxHistory);
  }
  /// For methods that have one way to test and to read history.
  void visitAmounts(SettingVisitor& v, LightKinds followMaxHistory = {}) {
    visitMaxHistory(v, followMaxHistory);
    visitThresholds(v, "accumulation.plane-tolerance", "accumulation.normal-threshold", thresholds);
    antilag.visit(v);
  }
  void visit(SettingVisitor& v) {
    static constexpr std::string_view kFilters[] = {"bilinear", "bicubic"};
    visitAmounts(v);
    visitRejection(v, "accumulation.rejection", rejection);
    v.visitEnum(
        {"accumulation.history-filter", "How history is read between pixels", "", 0, 1, "Meunier & Harada 2022, 4.2"},
        kFilters, historyFilter);
    v.visit({"accumulation.dilate-motion", "Follow the nearest surface of the 3x3 neighbourhood", "", 0, 1,
             "Meunier & Harada 2022, 4.2"},
            dilateMotion);
  }
  /// For methods and stages whose filter can read both storages.
  void visitStorage(SettingVisitor& v) {
    v.visitEnum(
        {"accumulation.storage",
         "Storage of accumulated light: 64 bits a pixel, or 32 with unbiased rounding to 7 bits", "", 0, 1, "measured"},
        kLightStorages, storage);
  }
};

/// The longest history at rest, frames: no longer than packed light can count.
float maxHistoryAtRest(const TemporalAccumulationSettings& settings);

/// Views of every stage that accumulates lighting, in the order of `view` of its shader.
/// @param withAntilag whether the stage has antilag, which has a view of its own
std::span<const ViewInfo> accumulationViews(bool withAntilag);

/// Accumulated light.
struct AccumulatedLight {
  /// In the storage `TemporalAccumulationSettings::storage`: mean radiance; alpha: history length, 0 where there is
  /// nothing to denoise.
  fg::Texture mean;
  AntilagResult antilag = {};  ///< Of this frame, which `mean` does not follow yet; or invalid.
};

/// Average the noisy lighting over time along its motion.
AccumulatedLight addTemporalAccumulation(StageGraph graph, const DenoiserInputs& inputs, const Guides& guides,
                                         const TemporalAccumulationSettings& settings = {}, fg::Texture steering = {});

/// Accumulated light, and the kept history taps with which later stages read their own histories along the same motion.
struct AccumulationWithTaps {
  AccumulatedLight light;
  /// R32_UINT: motion of the surface and the history taps that show it. Where there is no surface: a mark or the
  /// pass-through, whichever `addTemporalAccumulationWithTaps` was asked for (history_taps.glsl). The pass-through is
  /// rounded to 9 bits, by 0.2 % of its brightest channel at most, and clamped to 0 to 65408; it is 0 where it is not
  /// finite.
  fg::Texture taps;
};

/// The same, and keep what reprojection and its tests found (Meunier & Harada 2022, 4.4; Koskela et al. 2019, 3.5).
/// @param antialiasing storage of the anti-aliasing that reads the taps. Packed: taps hold the pass-through where there
/// is no surface, because anti-aliasing learns that from the filter's result. Half, and for other readers: they hold a
/// mark.
/// @param givenTaps taps that another pass has found (`ReflectionMotion`); not valid: those of the surface
AccumulationWithTaps addTemporalAccumulationWithTaps(StageGraph graph, const DenoiserInputs& inputs,
                                                     const Guides& guides,
                                                     const TemporalAccumulationSettings& settings = {},
                                                     LightStorage antialiasing = LightStorage::Half,
                                                     fg::Texture steering = {}, fg::Texture givenTaps = {});

/// The light grid: if sparse light has one sample in each group of a grid (`LightPattern::grid`), accumulated light may
/// have a texel for each group. It is the mean for the pixel that has this frame's sample, from the means of the pixels
/// that had the previous frame's.
struct LightGrid {
  LightPattern groups;
  fg::Texture depth = {};     ///< `Guides::depth` of these pixels; 0 also where the pixel lies outside the image.
  fg::Texture features = {};  ///< `Guides::features` of these pixels.
};

/// Guides, and light accumulated with them.
struct GuidesAndAccumulation {
  Guides guides;
  AccumulationWithTaps accumulated;
  std::optional<LightGrid> lightGrid;  ///< If `accumulated.light.mean` lies on it.
};

/// Whether `addGuidesAndAccumulation` can stand in for two passes, or `addReflectionsAndAccumulation` for three. Their
/// shaders have antilag and packed storage, test history taps by plane, and follow no dilated motion; they have no
/// variants without these.
bool canJoinGuides(const TemporalAccumulationSettings& settings);

/// `addPrepareGuides` and `addTemporalAccumulationWithTaps` as one pass, which need not read the guides back.
/// Accumulates on the light grid if light is sparse on one.
/// @param needs must ask for all guides
/// @throws std::invalid_argument unless `canJoinGuides`
GuidesAndAccumulation addGuidesAndAccumulation(StageGraph graph, const DenoiserInputs& inputs,
                                               const PrepareGuidesSettings& guideSettings, const GuideNeeds& needs,
                                               const TemporalAccumulationSettings& settings, LightStorage antialiasing,
                                               fg::Texture steering = {});

/// Specular light accumulated along its own motion, with what later stages read of its surfaces.
struct ReflectionsAndAccumulation {
  Guides guides;           ///< Depth and its history.
  fg::Texture reflectors;  ///< `ReflectionMotion::reflectors` with mean distances.
  AccumulationWithTaps accumulated;
};

/// `addPrepareGuides`, `addReflectionMotion` with its default settings and `addTemporalAccumulationWithTaps` as one
/// pass, which writes neither normals nor the motion by itself.
/// @throws std::invalid_argument unless `canJoinGuides`, or as `addReflectionMotion`
ReflectionsAndAccumulation addReflectionsAndAccumulation(StageGraph graph, const DenoiserInputs& inputs,
                                                         const PrepareGuidesSettings& guideSettings,
                                                         const TemporalAccumulationSettings& settings,
                                                         LightStorage antialiasing);

}  // namespace walr
