#include "passes/temporal_accumulation.h"

#include <array>

#include "passes/reprojection.h"
#include "shaders/constants/temporal_accumulation.h"
#include "shaders/shaders.h"

namespace walr {

namespace {

const fg::Shader& shaderFor(MotionSource motion, HistoryRejection rejection, bool keepTaps) {
  using namespace shaders;
  using ByRejection = std::array<std::array<const fg::Shader*, 2>, 3>;
  static constexpr std::array<ByRejection, 2> kShaders{
      {{{{&temporalAccumulationPlane, &temporalAccumulationPlaneTaps},
         {&temporalAccumulationDepth, &temporalAccumulationDepthTaps},
         {&temporalAccumulation, &temporalAccumulationTaps}}},
       {{{&temporalAccumulationCameraPlane, &temporalAccumulationCameraPlaneTaps},
         {&temporalAccumulationCameraDepth, &temporalAccumulationCameraDepthTaps},
         {&temporalAccumulationCamera, &temporalAccumulationCameraTaps}}}}};
  return *kShaders.at(static_cast<std::size_t>(motion)).at(static_cast<std::size_t>(rejection)).at(keepTaps ? 1 : 0);
}

/// The pass without its outputs; the first of them is the current texture of `accumulated`.
fg::PassBuilder addAccumulationPass(fg::Graph& graph, bool keepTaps, const DenoiserInputs& inputs, const Guides& guides,
                                    const fg::History& accumulated, const TemporalAccumulationSettings& settings) {
  const bool still = inputs.scene.still() && !keepTaps;
  const MotionSource motion = motionSource(inputs.scene);
  fg::PassBuilder pass =
      graph.compute("temporal accumulation",
                    still ? shaders::temporalAccumulationStill : shaderFor(motion, settings.rejection, keepTaps));
  if (still) {
    pass.sample("depth", guides.depth);
  } else {
    readReprojection(pass, inputs, guides, settings.rejection, motion, settings.dilateMotion);
    pass.specialize("kBicubicHistory", settings.historyFilter == HistoryFilter::Bicubic);
  }
  pass.sample("lighting", inputs.lighting)
      .sample("previousAccumulated", accumulated.previous)
      .constants(TemporalAccumulationConstants{settings.maxSamples, settings.planeTolerance, settings.normalThreshold})
      .dispatch(graph.textureDesc(inputs.lighting).extent);
  return pass;
}

fg::History accumulatedHistory(fg::Graph& graph, const DenoiserInputs& inputs) {
  return graph.history("accumulated", {VK_FORMAT_R16G16B16A16_SFLOAT, graph.textureDesc(inputs.lighting).extent});
}

}  // namespace

fg::Texture addTemporalAccumulation(fg::Graph& graph, const DenoiserInputs& inputs, const Guides& guides,
                                    const TemporalAccumulationSettings& settings) {
  const fg::History accumulated = accumulatedHistory(graph, inputs);
  return addAccumulationPass(graph, false, inputs, guides, accumulated, settings)
      .store("outAccumulated", accumulated.current);
}

AccumulationWithTaps addTemporalAccumulationWithTaps(fg::Graph& graph, const DenoiserInputs& inputs,
                                                     const Guides& guides,
                                                     const TemporalAccumulationSettings& settings) {
  const fg::History accumulated = accumulatedHistory(graph, inputs);
  const fg::Extent extent = graph.textureDesc(inputs.lighting).extent;
  fg::PassBuilder pass = addAccumulationPass(graph, true, inputs, guides, accumulated, settings);
  AccumulationWithTaps result;
  result.mean = pass.store("outAccumulated", accumulated.current);
  result.taps = pass.store("outTaps", graph.texture("history taps", {VK_FORMAT_R32_UINT, extent}));
  return result;
}

}  // namespace walr
