#include "passes/temporal_accumulation.h"

#include "passes/reprojection.h"
#include "shaders/constants/temporal_accumulation.h"
#include "shaders/shaders.h"

namespace walr {

fg::Texture addTemporalAccumulation(fg::Graph& graph, const DenoiserInputs& inputs, const Guides& guides,
                                    const TemporalAccumulationSettings& settings) {
  const fg::Extent extent = graph.textureDesc(inputs.lighting).extent;
  const fg::History accumulated = graph.history("accumulated", {VK_FORMAT_R16G16B16A16_SFLOAT, extent});

  fg::PassBuilder pass = graph.compute("temporal accumulation", shaders::temporalAccumulation);
  readReprojection(pass, inputs, guides);
  pass.sample("lighting", inputs.lighting)
      .sample("previousAccumulated", accumulated.previous)
      .constants(TemporalAccumulationConstants{settings.maxSamples, settings.planeTolerance, settings.normalThreshold})
      .dispatch(extent);
  return pass.store("outAccumulated", accumulated.current);
}

}  // namespace walr
