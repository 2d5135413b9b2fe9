#include "integration/stages.h"

#include <stdexcept>
#include <string>

#include "integration/host_inputs.h"
#include "passes/filters/joint_bilateral_filter.h"
#include "passes/methods/denoiser.h"
#include "passes/regression/block_regression.h"
#include "passes/regression/bmfr_fit.h"
#include "passes/regression/flr_regression.h"
#include "passes/regression/full_window_regression.h"
#include "passes/regression/weighted_regression.h"
#include "passes/stage/pass_through.h"
#include "passes/temporal/bmfr_accumulation.h"
#include "passes/temporal/temporal_accumulation.h"
#include "passes/temporal/temporal_antialiasing.h"
#include "shaders/temporal/antilag.h"

namespace walr {
namespace {

constexpr VkFormat kResultFormat = VK_FORMAT_R16G16B16A16_SFLOAT;

/// A stage made of a settings struct and the function that declares it.
template <typename Settings, auto kDeclare>
class StageOf final : public Stage {
 public:
  void visitSettings(SettingVisitor& visitor) override { settings_.visit(visitor); }
  void declare(StagePorts& ports) override {
    checkSettings();
    kDeclare(ports, settings_);
  }

 private:
  Settings settings_{};
};

template <typename Settings, auto kDeclare>
std::unique_ptr<Stage> make(std::string_view /*name*/) {
  return std::make_unique<StageOf<Settings, kDeclare>>();
}

struct NoSettings {
  void visit(SettingVisitor& /*visitor*/) {}
};

/// Settings of the G-buffer's conversion for filters with ambient occlusion as a feature.
struct OcclusionStageSettings {
  PrepareGuidesSettings guides;
  AmbientOcclusionSettings occlusion;

  void visit(SettingVisitor& v) {
    guides.visit(v);
    occlusion.visit(v);
  }
};

/// Single stages also have the settings of storage, so that accumulation and anti-aliasing fit any filter.
struct AccumulationStageSettings : TemporalAccumulationSettings {
  void visit(SettingVisitor& v) {
    TemporalAccumulationSettings::visit(v);
    visitStorage(v);
  }
};
/// The contents of the taps' texture depend on the storage of anti-aliasing, which reads it.
struct AccumulationWithTapsStageSettings : AccumulationStageSettings {
  TemporalAntialiasingSettings antialiasing;

  void visit(SettingVisitor& v) {
    AccumulationStageSettings::visit(v);
    antialiasing.visitStorage(v);
  }
};
struct AntialiasingStageSettings : TemporalAntialiasingSettings {
  void visit(SettingVisitor& v) {
    TemporalAntialiasingSettings::visit(v);
    visitStorage(v);
  }
};

/// A filter has those settings of the stages before and after it that decide what it reads and writes. A stage by
/// itself cannot steer the history of accumulation, so that it takes in accumulated light only if asked to.
struct BlockStageSettings {
  BlockRegressionSettings blocks{.share = {.enabled = false}};
  TemporalAccumulationSettings accumulation;
  TemporalAntialiasingSettings antialiasing;

  void visit(SettingVisitor& v) {
    blocks.visit(v);
    accumulation.visitMaxHistory(v);
    accumulation.antilag.visitEnabled(v);
    accumulation.visitStorage(v);
    antialiasing.visitStorage(v);
  }
};

/// Taps with and without pass-through light have different ports, because neither can replace the other.
std::string_view tapsPort(LightStorage antialiasing) {
  return antialiasing == LightStorage::Packed ? kHistoryTapsWithLight : kHistoryTaps;
}

/// The target of an output that has the size of an input.
fg::Texture targetLike(StagePorts& ports, std::string_view output, fg::Texture input) {
  return ports.target(output, kResultFormat, ports.graph().textureDesc(input).extent);
}

/// The texture between a filter and anti-aliasing, with the name that it has in the whole method.
fg::Texture filteredLike(StagePorts& ports, fg::Texture input, VkFormat format = kResultFormat) {
  return ports.graph().texture("filtered", {format, ports.graph().textureDesc(input).extent});
}

void prepareGuides(StagePorts& ports, const PrepareGuidesSettings& settings) {
  ports.setOutputs(addPrepareGuides(ports.graph(), ports.hostInputs(), settings));
}

void prepareGuidesWithOcclusion(StagePorts& ports, const OcclusionStageSettings& settings) {
  ports.setOutputs(
      addPrepareGuides(ports.graph(), ports.hostInputs(), settings.guides, {.occlusion = settings.occlusion}));
}

void setOutputs(StagePorts& ports, const AccumulatedLight& light) {
  ports.setOutput("accumulated", light.mean);
  if (light.antilag.factor.valid()) ports.setOutput(kAntilagFactor, light.antilag.factor);
}

void temporalAccumulation(StagePorts& ports, const AccumulationStageSettings& settings) {
  setOutputs(ports, addTemporalAccumulation(ports.graph(), ports.hostInputs(), ports.guides(true), settings));
}

void temporalAccumulationWithTaps(StagePorts& ports, const AccumulationWithTapsStageSettings& settings) {
  const AccumulationWithTaps result = addTemporalAccumulationWithTaps(
      ports.graph(), ports.hostInputs(), ports.guides(true), settings, settings.antialiasing.storage);
  setOutputs(ports, result.light);
  ports.setOutput(tapsPort(settings.antialiasing.storage), result.taps);
}

void weightedRegression(StagePorts& ports, const WeightedRegressionSettings& settings) {
  const fg::Texture accumulated = ports.texture("accumulated");
  const fg::Texture target = filteredLike(ports, accumulated);
  ports.setOutput("filtered", addWeightedRegression(ports.graph(), ports.buffer(kFrameName), accumulated,
                                                    LightingAlpha::SampleCount, ports.guides(), target, settings));
}

void fullWindowRegression(StagePorts& ports, const FullWindowSettings& settings) {
  const fg::Texture accumulated = ports.texture("accumulated");
  const fg::Texture target = filteredLike(ports, accumulated);
  ports.setOutput("filtered", addFullWindowRegression(ports.graph(), ports.buffer(kFrameName), accumulated,
                                                      ports.guides(), target, settings));
}

void blockRegression(StagePorts& ports, const BlockStageSettings& settings) {
  const fg::Buffer frame = ports.buffer(kFrameName);
  BlockLight light{.accumulated = ports.texture("accumulated", formatOf(settings.accumulation.storage)),
                   .alpha = LightingAlpha::SampleCount};
  const LightStorage result = settings.antialiasing.storage;
  const bool packed = settings.accumulation.storage == LightStorage::Packed;
  const bool antilag = settings.accumulation.antilag.enabled;
  if (packed || antilag || settings.blocks.share.enabled) light.lighting = ports.texture("lighting");
  if (antilag) light.antilag = CurrentAntilag{ports.texture(kAntilagFactor), settings.accumulation.maxHistory};
  const Guides guides = ports.guides();
  const BlockFits fits = addBlockRegression(ports.graph(), frame, light, guides, settings.blocks);
  const fg::Texture target = filteredLike(ports, guides.depth, formatOf(result));
  ports.setOutput("filtered",
                  addBlockReconstruction(ports.graph(), frame, light, guides, fits, target, settings.blocks));
}

void bmfrFit(StagePorts& ports, const BmfrFitSettings& settings) {
  const fg::Texture accumulated = ports.texture("accumulated");
  const fg::Texture target = targetLike(ports, "filtered", accumulated);
  ports.setOutput("filtered", addBmfrFit(ports.graph(), ports.buffer(kFrameName), accumulated,
                                         LightingAlpha::SampleCount, ports.guides(), target, settings));
}

void bmfrAccumulation(StagePorts& ports, const BmfrAccumulationSettings& settings) {
  ports.setOutput("steady", addBmfrAccumulation(ports.graph(), ports.buffer(kFrameName), ports.texture("filtered"),
                                                ports.texture(kHistoryTaps), settings));
}

void flrRegression(StagePorts& ports, const FlrRegressionSettings& settings) {
  const fg::Texture accumulated = ports.texture("accumulated");
  const fg::Texture target = targetLike(ports, "filtered", accumulated);
  ports.setOutput("filtered", addFlrRegression(ports.graph(), accumulated, LightingAlpha::SampleCount, ports.guides(),
                                               target, settings));
}

void jointBilateralFilter(StagePorts& ports, const JointBilateralFilterSettings& settings) {
  const fg::Texture lighting = ports.texture("lighting");
  const fg::Texture target = targetLike(ports, "filtered", lighting);
  ports.setOutput("filtered", addJointBilateralFilter(ports.graph(), ports.buffer(kFrameName), lighting, ports.guides(),
                                                      target, settings));
}

void temporalAntialiasing(StagePorts& ports, const AntialiasingStageSettings& settings) {
  const fg::Texture filtered = ports.texture("filtered", formatOf(settings.storage));
  const fg::Texture target = targetLike(ports, kOutputName, filtered);
  ports.setOutput(kOutputName, addTemporalAntialiasing(ports.graph(), ports.hostInputs(), ports.guides(true), filtered,
                                                       target, settings));
}

void temporalAntialiasingWithTaps(StagePorts& ports, const AntialiasingStageSettings& settings) {
  const fg::Texture filtered = ports.texture("filtered", formatOf(settings.storage));
  const fg::Texture target = targetLike(ports, kOutputName, filtered);
  const fg::Texture taps = ports.texture(tapsPort(settings.storage));
  const fg::Texture depth = settings.pixelArea ? ports.texture("guides.depth") : fg::Texture{};
  ports.setOutput(kOutputName, addTemporalAntialiasingWithTaps(ports.graph(), ports.buffer(kFrameName), taps, depth,
                                                               filtered, target, settings));
}

void passThrough(StagePorts& ports, const NoSettings& /*settings*/) {
  const fg::Texture filtered = ports.texture("filtered");
  ports.setOutput(kOutputName, addPassThrough(ports.graph(), filtered, targetLike(ports, kOutputName, filtered)));
}

/// A whole method as a stage.
class MethodStage final : public Stage {
 public:
  explicit MethodStage(std::string_view name) : method_(makeDenoiser(name)) {}
  void visitSettings(SettingVisitor& visitor) override { method_->visitSettings(visitor); }
  [[nodiscard]] std::vector<std::string> presets() const override { return method_->presets(); }
  void usePreset(std::string_view name) override { method_->usePreset(name); }
  void declare(StagePorts& ports) override {
    const DenoiserInputs inputs = ports.hostInputs();
    const fg::Texture target = ports.target(kOutputName, kResultFormat, inputs.extent(ports.graph()));
    ports.setOutput(kOutputName, method_->add(ports.graph(), inputs, target));
  }

 private:
  std::unique_ptr<Denoiser> method_;
};

std::unique_ptr<Stage> makeMethod(std::string_view name) {
  return std::make_unique<MethodStage>(name);
}

std::vector<StageType> stagesAndMethods() {
  std::vector<StageType> types{
      {"prepare_guides", "Convert the host's depth, normals and albedo once into the guides that all other stages read",
       false, make<PrepareGuidesSettings, prepareGuides>},
      {"prepare_guides_with_occlusion",
       "prepare_guides that adds ambient occlusion, for block_regression and flr_regression", false,
       make<OcclusionStageSettings, prepareGuidesWithOcclusion>},
      {"temporal_accumulation",
       "Average the noisy lighting over time along its motion",
       false,
       make<AccumulationStageSettings, temporalAccumulation>,
       {{kAntilagFactor, VK_FORMAT_R16G16_SFLOAT,
         "Output of temporal_accumulation and temporal_accumulation_with_taps if accumulation.antilag is on",
         kAntilagTile}}},
      {"temporal_accumulation_with_taps",
       "temporal_accumulation that also outputs its history taps and, for packed anti-aliasing, the pass-through light",
       false,
       make<AccumulationWithTapsStageSettings, temporalAccumulationWithTaps>,
       {{kHistoryTaps, VK_FORMAT_R32_UINT,
         "Output of temporal_accumulation_with_taps if its setting antialiasing.storage is half"},
        {kHistoryTapsWithLight, VK_FORMAT_R32_UINT,
         "Output of temporal_accumulation_with_taps if its setting antialiasing.storage is packed"}}},
      {"weighted_regression", "WALR's filter: weighted linear regression over edge-aware a-trous averages", false,
       make<WeightedRegressionSettings, weightedRegression>},
      {"full_window_regression", "REFWLR's filter: weighted linear regression over the full window", false,
       make<FullWindowSettings, fullWindowRegression>},
      {"block_regression", "WALR's filter over blocks of pixels, with depth and occlusion among its features", false,
       make<BlockStageSettings, blockRegression>},
      {"bmfr_fit", "BMFR's filter: fit blocks of 32x32 pixels by features of first and second order", false,
       make<BmfrFitSettings, bmfrFit>},
      {"bmfr_accumulation", "Average fitted frames along the taps of temporal_accumulation_with_taps", false,
       make<BmfrAccumulationSettings, bmfrAccumulation>},
      {"flr_regression", "FLR's filter: local regression on a coarse grid", false,
       make<FlrRegressionSettings, flrRegression>},
      {"joint_bilateral_filter", "Joint bilateral filter of one noisy frame", false,
       make<JointBilateralFilterSettings, jointBilateralFilter>},
      {"temporal_antialiasing", "Reduce flicker of the filtered frames: history, variance clipping, moving average",
       false, make<AntialiasingStageSettings, temporalAntialiasing>},
      {"temporal_antialiasing_with_taps",
       "temporal_antialiasing that reuses the history taps of temporal_accumulation_with_taps, with their tests", false,
       make<AntialiasingStageSettings, temporalAntialiasingWithTaps>},
      {"pass_through", "Copy the filtered frame to the output", false, make<NoSettings, passThrough>},
  };
  for (const std::string& name : denoiserNames()) {
    types.push_back({name, std::string(denoiserDescription(name)), true, makeMethod});
  }
  return types;
}

}  // namespace

void Stage::usePreset(std::string_view name) {
  throw std::invalid_argument("there is no preset \"" + std::string(name) + "\": a stage has none");
}

const std::vector<StageType>& stageTypes() {
  static const std::vector<StageType> kTypes = stagesAndMethods();
  return kTypes;
}

}  // namespace walr
