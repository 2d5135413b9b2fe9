#include "passes/temporal_antialiasing.h"

#include "passes/reprojection.h"
#include "shaders/constants/temporal_antialiasing.h"
#include "shaders/shaders.h"

namespace walr {

fg::Texture addTemporalAntialiasing(fg::Graph& graph, const DenoiserInputs& inputs, const Guides& guides,
                                    fg::Texture filtered, fg::Texture output,
                                    const TemporalAntialiasingSettings& settings) {
  const fg::Extent extent = graph.textureDesc(filtered).extent;
  const fg::History resolved = graph.history("resolved", {VK_FORMAT_R16G16B16A16_SFLOAT, extent});

  fg::PassBuilder pass = graph.compute("temporal anti-aliasing", shaders::temporalAntialiasing);
  readReprojection(pass, inputs, guides, settings.dilateMotion);
  pass.sample("filtered", filtered)
      .sample("previousResolved", resolved.previous)
      .specialize("kClipRadius", settings.clipRadius)
      .constants(TemporalAntialiasingConstants{settings.maxSamples, settings.clipGamma, settings.planeTolerance,
                                               settings.normalThreshold})
      .dispatch(extent);
  (void)pass.store("outResolved", resolved.current);
  return pass.store("outImage", output);
}

}  // namespace walr
