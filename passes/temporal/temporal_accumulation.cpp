#include "passes/temporal/temporal_accumulation.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "passes/guides/guide_pass.h"
#include "passes/guides/shared_guides.h"
#include "passes/temporal/reflection_pass.h"
#include "passes/temporal/reprojection.h"
#include "shaders/shaders.h"
#include "shaders/temporal/guides_and_accumulation.h"
#include "shaders/temporal/temporal_accumulation.h"

namespace walr {

namespace {

/// The variants of the pass.
enum class Role : std::uint8_t {
  Mean,
  MeanAndTaps,
  GuidesMeanAndTaps,
  GuidesMeanAndTapsOnGrid,
  ReflectionsMeanAndTaps,
  View,
  ReflectionsView,
};

const fg::Shader& shaderFor(Role role, bool antilag, LightStorage storage) {
  const bool packed = storage == LightStorage::Packed;
  if (role == Role::View) return shaders::temporalAccumulationView({.packed = packed});
  if (role == Role::ReflectionsView) return shaders::temporalAccumulationReflectionsView;
  if (role == Role::ReflectionsMeanAndTaps) return shaders::temporalAccumulationReflections;
  if (role == Role::GuidesMeanAndTaps) return shaders::temporalAccumulationGuides;
  if (role == Role::GuidesMeanAndTapsOnGrid) return shaders::temporalAccumulationGuidesGrid;
  return shaders::temporalAccumulation({.taps = role == Role::MeanAndTaps, .antilag = antilag, .packed = packed});
}

bool preparesGuides(Role role) {
  return role == Role::GuidesMeanAndTaps || role == Role::GuidesMeanAndTapsOnGrid;
}

bool isView(Role role) {
  return role == Role::View || role == Role::ReflectionsView;
}

/// The stage with what it works on.
struct Stage {
  StageGraph graph;
  const DenoiserInputs& inputs;
  Guides guides;
  const TemporalAccumulationSettings& settings;
  bool keepTaps;
  bool onGrid;        ///< Accumulated light lies on the light grid.
  fg::Extent extent;  ///< Of the image.
  fg::History accumulated;
  std::optional<Antilag> antilag;  ///< Where the stage has it.
  fg::Texture givenTaps = {};      ///< Taps that another pass has kept; not valid if the stage finds them itself.
  std::optional<ReflectionSearch> reflections = {};  ///< If the stage finds the motion of reflections.
};

Stage stageOf(StageGraph graph, fg::Extent extent, const DenoiserInputs& inputs, const Guides& guides,
              const TemporalAccumulationSettings& settings, bool keepTaps, fg::Texture steering, bool onGrid = false) {
  const fg::Extent accumulated = onGrid ? inputs.conventions.light.lightingExtent(extent) : extent;
  const char* const name = onGrid ? "accumulated on the light grid" : "accumulated";
  Stage stage{graph,       inputs, guides, settings,
              keepTaps,    onGrid, extent, graph->history(name, {formatOf(settings.storage), accumulated}),
              std::nullopt};
  if (settings.antilag.enabled) stage.antilag = declareAntilag(graph, extent, steering, settings.restFactor > 1.0F);
  return stage;
}

fg::PassBuilder newPass(const Stage& stage, const std::string& name, Role role) {
  return stage.graph->compute(name, shaderFor(role, stage.antilag.has_value(), stage.settings.storage));
}

TapTests tapTests(const TemporalAccumulationSettings& settings) {
  return {settings.rejection, settings.thresholds, settings.dilateMotion};
}

TemporalAccumulationConstants constantsOf(const TemporalAccumulationSettings& settings) {
  return {settings.maxHistory, maxHistoryAtRest(settings), settings.thresholds.planeTolerance,
          settings.thresholds.normalThreshold};
}

/// Extent of all groups of sparse light, which may end after the image.
fg::Extent wholeGroups(const Stage& stage) {
  const LightPattern& light = stage.inputs.conventions.light;
  const fg::Extent texels = light.lightingExtent(stage.extent);
  return {light.columns * texels.width, light.rows * texels.height};
}

/// Declare what a pass reads besides guides of its own frame, and specialize its shader.
void readInputs(const Stage& stage, fg::PassBuilder& pass, Role role) {
  const TemporalAccumulationSettings& settings = stage.settings;
  const bool antilag = stage.antilag.has_value();
  ReprojectionSettings reprojection = stage.reflections ? reflectionReprojection(stage.inputs, settings)
                                                        : reprojectionOf(stage.inputs.scene, !stage.keepTaps,
                                                                         settings.rejection, settings.dilateMotion);
  reprojection.preparesGuides = preparesGuides(role);
  pass.uniform("frameConstants", stage.inputs.frame)
      .specialize("kBicubicHistory", settings.historyFilter == HistoryFilter::Bicubic);
  const StandIns standIns{.colour = stage.inputs.lighting, .number = stage.guides.depth};
  if (role == Role::MeanAndTaps || role == Role::View) {
    const bool given = stage.givenTaps.valid();
    // Reads nothing; but a view tells of the host's motion.
    if (given && role != Role::View) reprojection = {MotionSource::Camera, HistoryRejection::None, false};
    pass.specialize("kTapsGiven", given).sampleIf(given, "givenTaps", stage.givenTaps, standIns.number);
  }
  readReprojection(pass, stage.inputs, stage.guides, reprojection, standIns);
  readConfidence(pass, stage.inputs.confidence, stage.inputs, standIns);
  if (!stage.keepTaps || isView(role)) pass.specialize("kStill", reprojection.motion == MotionSource::None);
  if (isView(role)) {
    pass.specialize("kKeepableMotion", stage.keepTaps)
        .specialize("kAntilag", antilag)
        .specialize("kLightGrid", stage.onGrid);
  }
  if (antilag) {
    pass.sample("previousAntilag", stage.antilag->factor.previous);
  } else if (isView(role)) {
    pass.unread("previousAntilag", stage.inputs.lighting);
  }
  specializeLight(pass, stage.inputs.conventions.light);
  pass.sample("lighting", stage.inputs.lighting)
      .sample("previousAccumulated", stage.accumulated.previous)
      .dispatch(role == Role::GuidesMeanAndTapsOnGrid ? wholeGroups(stage) : stage.extent);
}

/// A pass without its outputs; the first of them is the current texture of `accumulated`.
fg::PassBuilder declarePass(const Stage& stage, const std::string& name, Role role) {
  fg::PassBuilder pass = newPass(stage, name, role);
  if (stage.reflections) {
    readReflections(pass, *stage.reflections);
  } else {
    pass.sample("depth", stage.guides.depth).constants(constantsOf(stage.settings));
  }
  readInputs(stage, pass, role);
  return pass;
}

void offerViews(const Stage& stage) {
  stage.graph.offer(accumulationViews(stage.antilag.has_value()), stage.extent, [&](const std::string& name) {
    return declarePass(stage, name, stage.reflections ? Role::ReflectionsView : Role::View);
  });
}

/// Add a pass's output, and antilag if the stage has it.
AccumulatedLight storeMean(const Stage& stage, fg::PassBuilder& pass) {
  const fg::Texture mean = pass.store("outAccumulated", stage.accumulated.current);
  stage.graph.offerHistoryLength(mean, 3, stage.onGrid ? stage.inputs.conventions.light : LightPattern{});
  if (!stage.antilag) return {.mean = mean};
  Antilag antilag = *stage.antilag;
  antilag.tiles = pass.store("outTiles", antilag.tiles);
  return {.mean = mean,
          .antilag = addAntilag(stage.graph, antilag, stage.settings.antilag,
                                {stage.settings.maxHistory, stage.settings.restFactor}, stage.inputs.frame)};
}

/// The same for a pass that keeps taps.
/// @param antialiasing see `addTemporalAccumulationWithTaps`
AccumulationWithTaps storeMeanAndTaps(const Stage& stage, fg::PassBuilder& pass, LightStorage antialiasing) {
  AccumulationWithTaps result;
  result.light = storeMean(stage, pass);
  pass.specialize("kKeepPassThrough", antialiasing == LightStorage::Packed);
  result.taps = pass.store("outTaps", stage.graph->texture("history taps", {VK_FORMAT_R32_UINT, stage.extent}));
  if (stage.graph.shared() != nullptr && !stage.givenTaps.valid() && !stage.reflections) {
    stage.graph.shared()->keepTaps(tapTests(stage.settings), result.taps);
  }
  return result;
}

/// Add the outputs of a pass whose accumulated light lies on the light grid.
LightGrid storeLightGrid(const Stage& stage, fg::PassBuilder& pass) {
  const LightPattern& light = stage.inputs.conventions.light;
  const fg::TextureDesc word{VK_FORMAT_R32_UINT, light.lightingExtent(stage.extent)};
  LightGrid grid{.groups = light};
  grid.depth = pass.store("outLightDepth", stage.graph->texture("light grid.depth", word));
  grid.features = pass.store("outLightFeatures", stage.graph->texture("light grid.features", word));
  return grid;
}

}  // namespace

float maxHistoryAtRest(const TemporalAccumulationSettings& settings) {
  return std::min(settings.restFactor * settings.maxHistory, kMostAccumulatedSamples);
}

std::span<const ViewInfo> accumulationViews(bool withAntilag) {
  static const std::vector<ViewInfo> kViews{
      {"history",
       "History length with this frame's sample, history pixels rejected (of four), 1 where none is left",
       {{"rejected-history-taps", "Y"}, {"no-history", "Z"}}},
      {"broken-lighting",
       "1 where the lighting is not finite, where it is clamped, where the motion is not finite",
       {{"non-finite-lighting", "X"}, {"clamped-lighting", "Y"}, {"non-finite-motion", "Z"}}},
      {"antilag",
       "Antilag factor: 0 where history counts in full, 1 where it does not count; longest history that counts; 1 "
       "where that cuts it short",
       {{"shortened-history", "Z"}}},
      {"fireflies",
       "1 where this frame's sample is held back as a firefly; what that takes of it, in units of the brightest sample "
       "that passes; 1 where history is held back",
       {{"held-back-samples", "X"}, {"held-back-light", "Y"}, {"held-back-history", "Z"}}},
  };
  constexpr std::size_t kOfAntilag = 2;  // The last ones.
  return std::span(kViews).first(withAntilag ? kViews.size() : kViews.size() - kOfAntilag);
}

AccumulatedLight addTemporalAccumulation(StageGraph graph, const DenoiserInputs& inputs, const Guides& guides,
                                         const TemporalAccumulationSettings& settings, fg::Texture steering) {
  const Stage stage =
      stageOf(graph, graph->textureDesc(guides.depth).extent, inputs, guides, settings, false, steering);
  offerViews(stage);
  fg::PassBuilder pass = declarePass(stage, "temporal accumulation", Role::Mean);
  return storeMean(stage, pass);
}

AccumulationWithTaps addTemporalAccumulationWithTaps(StageGraph graph, const DenoiserInputs& inputs,
                                                     const Guides& guides, const TemporalAccumulationSettings& settings,
                                                     LightStorage antialiasing, fg::Texture steering,
                                                     fg::Texture givenTaps) {
  Stage stage = stageOf(graph, graph->textureDesc(guides.depth).extent, inputs, guides, settings, true, steering);
  stage.givenTaps = givenTaps;
  if (!givenTaps.valid() && graph.shared() != nullptr) stage.givenTaps = graph.shared()->tapsFor(tapTests(settings));
  offerViews(stage);
  fg::PassBuilder pass = declarePass(stage, "temporal accumulation", Role::MeanAndTaps);
  return storeMeanAndTaps(stage, pass, antialiasing);
}

bool canJoinGuides(const TemporalAccumulationSettings& settings) {
  return settings.rejection == HistoryRejection::Plane && !settings.dilateMotion && settings.antilag.enabled &&
         settings.storage == LightStorage::Packed;
}

GuidesAndAccumulation addGuidesAndAccumulation(StageGraph graph, const DenoiserInputs& inputs,
                                               const PrepareGuidesSettings& guideSettings, const GuideNeeds& needs,
                                               const TemporalAccumulationSettings& settings, LightStorage antialiasing,
                                               fg::Texture steering) {
  if (!canJoinGuides(settings) || !needs.geometricNormal || !needs.history || !needs.occlusion) {
    throw std::invalid_argument(
        "guides and accumulation share a pass only with antilag, packed storage, history taps "
        "tested by plane, no dilated motion, and if all guides are needed; add two passes");
  }
  offerGuideViews(graph, inputs, guideSettings);
  const fg::Extent extent = graph->textureDesc(inputs.depth).extent;
  const bool onGrid = inputs.conventions.light.grid();
  const Role role = onGrid ? Role::GuidesMeanAndTapsOnGrid : Role::GuidesMeanAndTaps;
  Stage stage = stageOf(graph, extent, inputs, {}, settings, true, steering, onGrid);
  fg::PassBuilder pass = newPass(stage, "guides and accumulation", role);
  readGBuffer(pass, inputs, guideSettings);
  pass.constants(
      GuidesAndAccumulationConstants{guideConstants(graph, inputs, guideSettings, needs), constantsOf(settings)});
  stage.guides = writeGuides(graph, pass, extent, needs);
  if (graph.shared() != nullptr) graph.shared()->keep({guideSettings, needs, inputs.scene}, stage.guides);
  readInputs(stage, pass, role);
  offerViews(stage);
  const AccumulationWithTaps accumulated = storeMeanAndTaps(stage, pass, antialiasing);
  return {.guides = stage.guides,
          .accumulated = accumulated,
          .lightGrid = onGrid ? std::optional(storeLightGrid(stage, pass)) : std::nullopt};
}

ReflectionsAndAccumulation addReflectionsAndAccumulation(StageGraph graph, const DenoiserInputs& inputs,
                                                         const PrepareGuidesSettings& guideSettings,
                                                         const TemporalAccumulationSettings& settings,
                                                         LightStorage antialiasing) {
  if (!canJoinGuides(settings)) {
    throw std::invalid_argument(
        "reflections and accumulation share a pass only with antilag, packed storage and no dilated motion; add three "
        "passes");
  }
  offerGuideViews(graph, inputs, guideSettings);
  const fg::Extent extent = graph->textureDesc(inputs.depth).extent;
  const fg::History depth = graph->history("guides.depth", {VK_FORMAT_R32_UINT, extent});
  Guides guides;
  guides.previousDepth = depth.previous;
  Stage stage = stageOf(graph, extent, inputs, guides, settings, true, {});
  stage.reflections.emplace(searchReflections(graph, inputs, guides, settings, {}, guideSettings));
  offerViews(stage);
  fg::PassBuilder pass = declarePass(stage, "reflections and accumulation", Role::ReflectionsMeanAndTaps);
  guides.depth = pass.store("outDepth", depth.current);
  const fg::Texture reflectors = pass.store("outReflector", stage.reflections->reflectors.current);
  return {.guides = guides, .reflectors = reflectors, .accumulated = storeMeanAndTaps(stage, pass, antialiasing)};
}

}  // namespace walr
