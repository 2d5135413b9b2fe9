#include "passes/temporal_accumulation.h"

#include <array>
#include <string>
#include <vector>

#include "passes/reprojection.h"
#include "shaders/constants/temporal_accumulation.h"
#include "shaders/shaders.h"

namespace walr {

namespace {

/// What a pass is there for.
enum class Role : std::size_t { Mean, MeanAndTaps, View };

const fg::Shader& shaderFor(MotionSource motion, HistoryRejection rejection, Role role) {
  using namespace shaders;
  using ByRejection = std::array<std::array<const fg::Shader*, 3>, 3>;
  static constexpr std::array<ByRejection, 2> kShaders{
      {{{{&temporalAccumulationPlane, &temporalAccumulationPlaneTaps, &temporalAccumulationPlaneView},
         {&temporalAccumulationDepth, &temporalAccumulationDepthTaps, &temporalAccumulationDepthView},
         {&temporalAccumulation, &temporalAccumulationTaps, &temporalAccumulationView}}},
       {{{&temporalAccumulationCameraPlane, &temporalAccumulationCameraPlaneTaps, &temporalAccumulationCameraPlaneView},
         {&temporalAccumulationCameraDepth, &temporalAccumulationCameraDepthTaps, &temporalAccumulationCameraDepthView},
         {&temporalAccumulationCamera, &temporalAccumulationCameraTaps, &temporalAccumulationCameraView}}}}};
  return *kShaders.at(static_cast<std::size_t>(motion))
              .at(static_cast<std::size_t>(rejection))
              .at(static_cast<std::size_t>(role));
}

/// The stage in a graph.
struct Stage {
  fg::Graph& graph;
  const DenoiserInputs& inputs;
  const Guides& guides;
  const TemporalAccumulationSettings& settings;
  bool keepTaps;
  fg::History accumulated;
};

Stage stageOf(fg::Graph& graph, const DenoiserInputs& inputs, const Guides& guides,
              const TemporalAccumulationSettings& settings, bool keepTaps) {
  const fg::TextureDesc desc{VK_FORMAT_R16G16B16A16_SFLOAT, graph.textureDesc(inputs.lighting).extent};
  return {graph, inputs, guides, settings, keepTaps, graph.history("accumulated", desc)};
}

/// A pass without its outputs; the first of them is the current texture of `accumulated`.
fg::PassBuilder declarePass(const Stage& stage, const std::string& name, Role role) {
  const SceneDescription& scene = stage.inputs.scene;
  const bool still = scene.still() && !stage.keepTaps;
  const MotionSource motion = motionSource(scene);
  const fg::Shader& stillShader =
      role == Role::View ? shaders::temporalAccumulationStillView : shaders::temporalAccumulationStill;
  fg::PassBuilder pass =
      stage.graph.compute(name, still ? stillShader : shaderFor(motion, stage.settings.rejection, role));
  if (still) {
    pass.sample("depth", stage.guides.depth);
  } else {
    readReprojection(pass, stage.inputs, stage.guides, stage.settings.rejection, motion, stage.settings.dilateMotion);
    pass.specialize("kBicubicHistory", stage.settings.historyFilter == HistoryFilter::Bicubic);
    if (role == Role::View) pass.specialize("kKeepableMotion", stage.keepTaps);
  }
  pass.sample("lighting", stage.inputs.lighting)
      .sample("previousAccumulated", stage.accumulated.previous)
      .constants(TemporalAccumulationConstants{stage.settings.maxSamples, stage.settings.planeTolerance,
                                               stage.settings.normalThreshold})
      .dispatch(stage.graph.textureDesc(stage.inputs.lighting).extent);
  return pass;
}

void offerViews(const Stage& stage, Inspection* inspection) {
  if (inspection == nullptr) return;
  inspection->offer(stage.graph, accumulationViews(), stage.graph.textureDesc(stage.inputs.lighting).extent,
                    [&](const std::string& name) { return declarePass(stage, name, Role::View); });
}

constexpr const char* kPassName = "temporal accumulation";

}  // namespace

const std::vector<ViewInfo>& accumulationViews() {
  static const std::vector<ViewInfo> kViews{
      {"history",
       "History length with this frame's sample, history pixels rejected (of four), 1 where none is left",
       {{"rejected-history-taps", "Y"}, {"no-history", "Z"}}},
      {"broken-lighting",
       "1 where the lighting is not finite, where it is clamped, where the motion is not finite",
       {{"non-finite-lighting", "X"}, {"clamped-lighting", "Y"}, {"non-finite-motion", "Z"}}},
  };
  return kViews;
}

fg::Texture addTemporalAccumulation(fg::Graph& graph, const DenoiserInputs& inputs, const Guides& guides,
                                    const TemporalAccumulationSettings& settings, Inspection* inspection) {
  const Stage stage = stageOf(graph, inputs, guides, settings, false);
  offerViews(stage, inspection);
  return declarePass(stage, kPassName, Role::Mean).store("outAccumulated", stage.accumulated.current);
}

AccumulationWithTaps addTemporalAccumulationWithTaps(fg::Graph& graph, const DenoiserInputs& inputs,
                                                     const Guides& guides, const TemporalAccumulationSettings& settings,
                                                     Inspection* inspection) {
  const Stage stage = stageOf(graph, inputs, guides, settings, true);
  offerViews(stage, inspection);
  fg::PassBuilder pass = declarePass(stage, kPassName, Role::MeanAndTaps);
  const fg::Extent extent = graph.textureDesc(inputs.lighting).extent;
  AccumulationWithTaps result;
  result.mean = pass.store("outAccumulated", stage.accumulated.current);
  result.taps = pass.store("outTaps", graph.texture("history taps", {VK_FORMAT_R32_UINT, extent}));
  return result;
}

}  // namespace walr
