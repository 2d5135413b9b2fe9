#include "passes/temporal_accumulation.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "passes/reprojection.h"
#include "shaders/constants/temporal_accumulation.h"
#include "shaders/shaders.h"

namespace walr {

namespace {

/// The variants of the pass.
enum class Role : std::uint8_t { Mean, MeanAndTaps, View };

const fg::Shader& shaderFor(Role role, bool antilag, LightStorage storage) {
  const bool packed = storage == LightStorage::Packed;
  if (role == Role::View) return shaders::temporalAccumulationView({.packed = packed});
  return shaders::temporalAccumulation({.taps = role == Role::MeanAndTaps, .antilag = antilag, .packed = packed});
}

/// The stage with what it works on.
struct Stage {
  StageGraph graph;
  const DenoiserInputs& inputs;
  const Guides& guides;
  const TemporalAccumulationSettings& settings;
  bool keepTaps;
  fg::History accumulated;
  std::optional<Antilag> antilag;  ///< Where the stage has it.
};

Stage stageOf(StageGraph graph, const DenoiserInputs& inputs, const Guides& guides,
              const TemporalAccumulationSettings& settings, bool keepTaps) {
  const fg::Extent extent = graph->textureDesc(inputs.lighting).extent;
  Stage stage{graph,       inputs,   guides,
              settings,    keepTaps, graph->history("accumulated", {formatOf(settings.storage), extent}),
              std::nullopt};
  if (settings.antilag.enabled) stage.antilag = declareAntilag(graph, extent);
  return stage;
}

/// A pass without its outputs; the first of them is the current texture of `accumulated`.
fg::PassBuilder declarePass(const Stage& stage, const std::string& name, Role role) {
  const TemporalAccumulationSettings& settings = stage.settings;
  const bool antilag = stage.antilag.has_value();
  const ReprojectionSettings reprojection =
      reprojectionOf(stage.inputs.scene, !stage.keepTaps, settings.rejection, settings.dilateMotion);
  fg::PassBuilder pass = stage.graph->compute(name, shaderFor(role, antilag, settings.storage));
  pass.uniform("frameConstants", stage.inputs.frame)
      .sample("depth", stage.guides.depth)
      .specialize("kBicubicHistory", settings.historyFilter == HistoryFilter::Bicubic);
  readReprojection(pass, stage.inputs, stage.guides, reprojection,
                   {.colour = stage.inputs.lighting, .number = stage.guides.depth});
  if (role != Role::MeanAndTaps) pass.specialize("kStill", reprojection.motion == MotionSource::None);
  if (role == Role::View) pass.specialize("kKeepableMotion", stage.keepTaps).specialize("kAntilag", antilag);
  if (antilag) {
    pass.sample("previousAntilag", stage.antilag->factor.previous);
  } else if (role == Role::View) {
    pass.unread("previousAntilag", stage.inputs.lighting);
  }
  pass.sample("lighting", stage.inputs.lighting)
      .sample("previousAccumulated", stage.accumulated.previous)
      .constants(TemporalAccumulationConstants{settings.maxHistory, settings.planeTolerance, settings.normalThreshold})
      .dispatch(stage.graph->textureDesc(stage.inputs.lighting).extent);
  return pass;
}

void offerViews(const Stage& stage) {
  stage.graph.offer(accumulationViews(stage.antilag.has_value()),
                    stage.graph->textureDesc(stage.inputs.lighting).extent,
                    [&](const std::string& name) { return declarePass(stage, name, Role::View); });
}

/// Add the pass, its output `mean`, and antilag if the stage has it.
fg::PassBuilder accumulate(const Stage& stage, Role role, fg::Texture& mean) {
  fg::PassBuilder pass = declarePass(stage, "temporal accumulation", role);
  mean = pass.store("outAccumulated", stage.accumulated.current);
  if (stage.antilag) {
    Antilag antilag = *stage.antilag;
    antilag.tiles = pass.store("outTiles", antilag.tiles);
    addAntilag(stage.graph, antilag, stage.settings.antilag);
  }
  return pass;
}

}  // namespace

std::span<const ViewInfo> accumulationViews(bool withAntilag) {
  static const std::vector<ViewInfo> kViews{
      {"history",
       "History length with this frame's sample, history pixels rejected (of four), 1 where none is left",
       {{"rejected-history-taps", "Y"}, {"no-history", "Z"}}},
      {"broken-lighting",
       "1 where the lighting is not finite, where it is clamped, where the motion is not finite",
       {{"non-finite-lighting", "X"}, {"clamped-lighting", "Y"}, {"non-finite-motion", "Z"}}},
      {"antilag",
       "Antilag factor: 0 where history counts in full, 1 where as one sample; longest history that counts; 1 where "
       "that cuts it "
       "short",
       {{"shortened-history", "Z"}}},
  };
  return std::span(kViews).first(withAntilag ? kViews.size() : kViews.size() - 1);
}

fg::Texture addTemporalAccumulation(StageGraph graph, const DenoiserInputs& inputs, const Guides& guides,
                                    const TemporalAccumulationSettings& settings) {
  const Stage stage = stageOf(graph, inputs, guides, settings, false);
  offerViews(stage);
  fg::Texture mean;
  accumulate(stage, Role::Mean, mean);
  return mean;
}

AccumulationWithTaps addTemporalAccumulationWithTaps(StageGraph graph, const DenoiserInputs& inputs,
                                                     const Guides& guides, const TemporalAccumulationSettings& settings,
                                                     LightStorage antialiasing) {
  const Stage stage = stageOf(graph, inputs, guides, settings, true);
  offerViews(stage);
  AccumulationWithTaps result;
  fg::PassBuilder pass = accumulate(stage, Role::MeanAndTaps, result.mean);
  pass.specialize("kKeepPassThrough", antialiasing == LightStorage::Packed);
  const fg::Extent extent = graph->textureDesc(inputs.lighting).extent;
  result.taps = pass.store("outTaps", graph->texture("history taps", {VK_FORMAT_R32_UINT, extent}));
  return result;
}

}  // namespace walr
