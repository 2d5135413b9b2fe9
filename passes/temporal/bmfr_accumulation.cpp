#include "passes/temporal/bmfr_accumulation.h"

#include "shaders/shaders.h"
#include "shaders/temporal/bmfr_accumulation.h"

namespace walr {

fg::Texture addBmfrAccumulation(StageGraph graph, fg::Buffer frame, fg::Texture fitted, fg::Texture taps,
                                const BmfrAccumulationSettings& settings) {
  const fg::Extent extent = graph.textureDesc(fitted).extent;
  const fg::History accumulated = graph.history("accumulated fit", {VK_FORMAT_R16G16B16A16_SFLOAT, extent});

  fg::PassBuilder pass = graph.compute("bmfr accumulation", shaders::bmfrAccumulation);
  pass.uniform("frameConstants", frame)
      .sample("fitted", fitted)
      .sample("taps", taps)
      .sample("previousAccumulated", accumulated.previous)
      .constants(BmfrAccumulationConstants{settings.maxHistory})
      .dispatch(extent);
  return pass.store("outAccumulated", accumulated.current);
}

}  // namespace walr
