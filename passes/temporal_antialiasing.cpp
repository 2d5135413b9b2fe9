#include "passes/temporal_antialiasing.h"

#include <array>

#include "passes/reprojection.h"
#include "shaders/constants/temporal_antialiasing.h"
#include "shaders/shaders.h"

namespace walr {
namespace {

const fg::Shader& shaderFor(MotionSource motion, HistoryRejection rejection) {
  using namespace shaders;
  static constexpr std::array<std::array<const fg::Shader*, 3>, 2> kShaders{
      {{&temporalAntialiasingPlane, &temporalAntialiasingDepth, &temporalAntialiasing},
       {&temporalAntialiasingCameraPlane, &temporalAntialiasingCameraDepth, &temporalAntialiasingCamera}}};
  return *kShaders.at(static_cast<std::size_t>(motion)).at(static_cast<std::size_t>(rejection));
}

/// What does not depend on where the reprojection comes from.
fg::Texture finishPass(fg::Graph& graph, fg::PassBuilder& pass, fg::Texture filtered, fg::Texture output,
                       const TemporalAntialiasingSettings& settings) {
  const fg::Extent extent = graph.textureDesc(filtered).extent;
  const fg::History resolved = graph.history("resolved", {VK_FORMAT_R16G16B16A16_SFLOAT, extent});
  pass.sample("filtered", filtered)
      .sample("previousResolved", resolved.previous)
      .specialize("kClipRadius", settings.clipRadius)
      .constants(TemporalAntialiasingConstants{settings.maxSamples, settings.clipGamma, settings.planeTolerance,
                                               settings.normalThreshold})
      .dispatch(extent);
  (void)pass.store("outResolved", resolved.current);
  return pass.store("outImage", output);
}

constexpr const char* kPassName = "temporal anti-aliasing";

}  // namespace

fg::Texture addTemporalAntialiasing(fg::Graph& graph, const DenoiserInputs& inputs, const Guides& guides,
                                    fg::Texture filtered, fg::Texture output,
                                    const TemporalAntialiasingSettings& settings) {
  if (inputs.scene.still()) {
    fg::PassBuilder pass = graph.compute(kPassName, shaders::temporalAntialiasingStill);
    pass.sample("depth", guides.depth);
    return finishPass(graph, pass, filtered, output, settings);
  }
  const MotionSource motion = motionSource(inputs.scene);
  fg::PassBuilder pass = graph.compute(kPassName, shaderFor(motion, settings.rejection));
  readReprojection(pass, inputs, guides, settings.rejection, motion, settings.dilateMotion);
  return finishPass(graph, pass, filtered, output, settings);
}

bool sharesReprojection(const TemporalAntialiasingSettings& antialiasing,
                        const TemporalAccumulationSettings& accumulation) {
  if (antialiasing.dilateMotion != accumulation.dilateMotion) return false;
  if (antialiasing.rejection == HistoryRejection::None) return true;
  return antialiasing.rejection == accumulation.rejection &&
         antialiasing.planeTolerance == accumulation.planeTolerance &&
         antialiasing.normalThreshold == accumulation.normalThreshold;
}

fg::Texture addTemporalAntialiasingWithTaps(fg::Graph& graph, fg::Texture taps, fg::Texture filtered,
                                            fg::Texture output, const TemporalAntialiasingSettings& settings) {
  fg::PassBuilder pass = graph.compute(kPassName, shaders::temporalAntialiasingKept);
  pass.sample("keptTaps", taps).specialize("kRejectHistory", settings.rejection != HistoryRejection::None);
  return finishPass(graph, pass, filtered, output, settings);
}

}  // namespace walr
