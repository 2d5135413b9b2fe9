#pragma once

#include <cstdint>

#include "framegraph/declare/graph.h"
#include "passes/conventions/inputs.h"
#include "passes/conventions/light_storage.h"
#include "passes/guides/history_tests.h"
#include "passes/guides/prepare_guides.h"
#include "passes/settings/settings.h"
#include "passes/stage/stage_graph.h"
#include "passes/temporal/temporal_accumulation.h"

namespace walr {

/// Settings of the postprocessing stage (Meunier & Harada 2022, 4.4).
struct TemporalAntialiasingSettings {
  bool enabled = true;
  float maxHistory = 3.0F;
  float clipGamma = 1.0F;
  float edgeClipGamma = 1.5F;
  std::uint32_t clipRadius = 1;
  HistoryRejection rejection = HistoryRejection::Plane;
  HistoryThresholds thresholds = {};
  bool objectIds = false;
  bool dilateMotion = false;
  bool pixelArea = true;
  float filterRadius = 0.75F;
  float historySharpness = 0.75F;
  LightStorage storage = LightStorage::Half;
  float restFactor = 1.0F;  ///< With `shortening`, history at rest is at most so many times as long. Not a setting.
  /// Whether this is the method's only accumulation of light. Its history length is then that of the method, the host's
  /// confidence limits it, and it is never a mean over the pixel's area. Not a setting; needs the storage
  /// `LightStorage::Half`.
  bool accumulates = false;

  /// For methods that have one way to test and to clip history.
  /// @param followClipGamma lights that do; the other kind has a setting of its own
  void visitAmounts(SettingVisitor& v, LightKinds followClipGamma = {}) {
    v.visit({"antialiasing.enabled", "Off leaves temporal anti-aliasing to the host", "", 0, 1,
             "Meunier & Harada 2022, 4.4"},
            enabled);
    v.visit({"antialiasing.max-history", "Frames after which the cumulative mean turns exponential", "frames", 1.0,
             255.0, "Meunier & Harada 2022, 4.4"},
            maxHistory);
    v.visit({"antialiasing.clip-gamma", "Half size of the variance-clipping box", "standard deviations", 0.0, 1e6,
             "Meunier & Harada 2022, 4.4", followClipGamma},
            clipGamma);
    // The history of specular light is that which accumulation accepted.
    visitThresholds(v, "antialiasing.plane-tolerance", "antialiasing.normal-threshold", thresholds, kDiffuseLight);
    v.visit({"antialiasing.object-ids", "Tell surfaces apart by the host's object numbers, too, where it gives them",
             "", 0, 1, "Wang 2024, 3"},
            objectIds);
    if (!accumulates) {
      v.visit({"antialiasing.pixel-area",
               "In jittered frames, average light over the pixel's area: history is not tested, whatever surface it "
               "shows, and follows the nearest surface of the 3x3 neighbourhood",
               "", 0, 1, "measured"},
              pixelArea);
    }
  }
  void visit(SettingVisitor& v) {
    visitAmounts(v);
    v.visit({"antialiasing.clip-radius", "Radius of the neighbourhood for variance clipping; 1 is 3x3", "pixels", 1, 8,
             "Meunier & Harada 2022, 4.4"},
            clipRadius);
    visitRejection(v, "antialiasing.rejection", rejection);
    v.visit({"antialiasing.dilate-motion", "Follow the nearest surface of the 3x3 neighbourhood", "", 0, 1,
             "Meunier & Harada 2022, 4.2"},
            dilateMotion);
  }
  /// For methods and stages whose filter can write both storages.
  void visitStorage(SettingVisitor& v) {
    v.visitEnum(
        {"antialiasing.storage",
         "Storage of filtered light and of the history of anti-aliasing: 64 bits a pixel, or 32 with unbiased rounding "
         "to 9 and 8 bits. If both temporal stages look for history alike and things may move, packed also rounds the "
         "light of pixels without a surface to 9 bits and clamps it to 65408",
         "", 0, 1, "measured"},
        kLightStorages, storage);
  }
};

/// Remove the flicker and aliasing that the spatial filter leaves: bicubic history, variance clipping, moving average.
/// @param filtered the current frame in the storage `settings.storage`; RGBA16F: alpha below 0 where there is no sample
/// @param output   RGBA16F texture to write the result to
/// @param shortening `AntilagResult::shortening`, or invalid
/// @returns the output's new version
fg::Texture addTemporalAntialiasing(StageGraph graph, const DenoiserInputs& inputs, const Guides& guides,
                                    fg::Texture filtered, fg::Texture output,
                                    const TemporalAntialiasingSettings& settings = {}, fg::Texture shortening = {});

/// Whether anti-aliasing averages light over the area of pixels in jittered frames (`pixelArea`).
bool coversPixelArea(const TemporalAntialiasingSettings& settings, const SceneDescription& scene);

/// Whether anti-aliasing with these settings would find the same history taps as accumulation, but for those that it
/// does not test, because it covers pixels' areas.
bool sharesReprojection(const TemporalAntialiasingSettings& antialiasing,
                        const TemporalAccumulationSettings& accumulation);

/// Check settings of anti-aliasing that reads the taps of specular light (`ReflectionMotion`).
/// @throws std::invalid_argument naming a setting that would search for other taps
void requireGivenTaps(const TemporalAntialiasingSettings& settings);

/// The same with the history taps that accumulation kept; `sharesReprojection` must hold, but for specular light, whose
/// taps are given (`ReflectionMotion`).
/// @param frame upload of `FrameConstants`
/// @param taps  R32_UINT: `AccumulationWithTaps::taps` for `settings.storage`
/// @param depth `Guides::depth` if `coversPixelArea` holds, else not valid
fg::Texture addTemporalAntialiasingWithTaps(StageGraph graph, fg::Buffer frame, fg::Texture taps, fg::Texture depth,
                                            fg::Texture filtered, fg::Texture output,
                                            const TemporalAntialiasingSettings& settings = {},
                                            fg::Texture shortening = {});

}  // namespace walr
