#include "passes/temporal_accumulation.h"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "passes/reprojection.h"
#include "shaders/constants/temporal_accumulation.h"
#include "shaders/shaders.h"

namespace walr {

namespace {

/// What a pass is there for.
enum class Role : std::size_t { Mean, MeanAndTaps, View };

// WALR_BY_ROLE(x): shaders x..., xTaps..., xView... with and without response to light that changes, in both storages.
#define WALR_BY_STORAGE(shader)  \
  {                              \
    { &shader, &shader##Packed } \
  }
#define WALR_BY_CHANGE(shader)                                       \
  {                                                                  \
    { WALR_BY_STORAGE(shader), WALR_BY_STORAGE(shader##Responsive) } \
  }
#define WALR_BY_ROLE(shader)                                                               \
  {                                                                                        \
    { WALR_BY_CHANGE(shader), WALR_BY_CHANGE(shader##Taps), WALR_BY_CHANGE(shader##View) } \
  }
#define WALR_BY_REJECTION(shader)                                                      \
  {                                                                                    \
    { WALR_BY_ROLE(shader##Plane), WALR_BY_ROLE(shader##Depth), WALR_BY_ROLE(shader) } \
  }

using ByStorage = std::array<const fg::Shader*, 2>;
using ByChange = std::array<ByStorage, 2>;

const fg::Shader& shaderFor(MotionSource motion, HistoryRejection rejection, Role role, bool responsive,
                            LightStorage storage) {
  using namespace shaders;
  using ByRole = std::array<ByChange, 3>;
  using ByRejection = std::array<ByRole, 3>;
  static constexpr std::array<ByRejection, 2> kShaders{
      {WALR_BY_REJECTION(temporalAccumulation), WALR_BY_REJECTION(temporalAccumulationCamera)}};
  return *kShaders.at(static_cast<std::size_t>(motion))
              .at(static_cast<std::size_t>(rejection))
              .at(static_cast<std::size_t>(role))
              .at(responsive ? 1 : 0)
              .at(static_cast<std::size_t>(storage));
}

const fg::Shader& stillShaderFor(Role role, bool responsive, LightStorage storage) {
  using namespace shaders;
  static constexpr ByChange kMeans WALR_BY_CHANGE(temporalAccumulationStill);
  static constexpr ByChange kViews WALR_BY_CHANGE(temporalAccumulationStillView);
  return *(role == Role::View ? kViews : kMeans).at(responsive ? 1 : 0).at(static_cast<std::size_t>(storage));
}

#undef WALR_BY_REJECTION
#undef WALR_BY_ROLE
#undef WALR_BY_CHANGE
#undef WALR_BY_STORAGE

/// The stage in a graph.
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
  const SceneDescription& scene = stage.inputs.scene;
  const bool still = scene.still() && !stage.keepTaps;
  const MotionSource motion = motionSource(scene);
  const bool responsive = stage.antilag.has_value();
  const LightStorage storage = stage.settings.storage;
  fg::PassBuilder pass =
      stage.graph->compute(name, still ? stillShaderFor(role, responsive, storage)
                                       : shaderFor(motion, stage.settings.rejection, role, responsive, storage));
  if (still) {
    pass.sample("depth", stage.guides.depth);
    if (storage == LightStorage::Packed && role != Role::View) pass.uniform("frameConstants", stage.inputs.frame);
  } else {
    readReprojection(pass, stage.inputs, stage.guides, stage.settings.rejection, motion, stage.settings.dilateMotion);
    pass.specialize("kBicubicHistory", stage.settings.historyFilter == HistoryFilter::Bicubic);
    if (role == Role::View) pass.specialize("kKeepableMotion", stage.keepTaps);
  }
  if (responsive) pass.sample("previousAntilag", stage.antilag->factor.previous);
  pass.sample("lighting", stage.inputs.lighting)
      .sample("previousAccumulated", stage.accumulated.previous)
      .constants(TemporalAccumulationConstants{stage.settings.maxHistory, stage.settings.planeTolerance,
                                               stage.settings.normalThreshold})
      .dispatch(stage.graph->textureDesc(stage.inputs.lighting).extent);
  return pass;
}

void offerViews(const Stage& stage) {
  stage.graph.offer(accumulationViews(stage.antilag.has_value()),
                    stage.graph->textureDesc(stage.inputs.lighting).extent,
                    [&](const std::string& name) { return declarePass(stage, name, Role::View); });
}

/// The pass with its mean; antilag goes by what it leaves.
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
  pass.specialize("kKeepPassedLight", antialiasing == LightStorage::Packed);
  const fg::Extent extent = graph->textureDesc(inputs.lighting).extent;
  result.taps = pass.store("outTaps", graph->texture("history taps", {VK_FORMAT_R32_UINT, extent}));
  return result;
}

}  // namespace walr
