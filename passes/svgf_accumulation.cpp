#include "passes/svgf_accumulation.h"

#include "passes/reprojection.h"
#include "shaders/constants/svgf_accumulation.h"
#include "shaders/shaders.h"

namespace walr {

SvgfAccumulated addSvgfAccumulation(fg::Graph& graph, const DenoiserInputs& inputs, const Guides& guides,
                                    fg::Texture previousColour, fg::Texture colour,
                                    const SvgfAccumulationSettings& settings) {
  const fg::Extent extent = graph.textureDesc(inputs.lighting).extent;
  const fg::History moments = graph.history("svgf.moments", {VK_FORMAT_R16G16B16A16_SFLOAT, extent});

  fg::PassBuilder pass = graph.compute("svgf accumulation", shaders::svgfAccumulation);
  readReprojection(pass, inputs, guides, HistoryRejection::Plane, MotionSource::Texture);
  pass.sample("lighting", inputs.lighting)
      .sample("previousColour", previousColour)
      .sample("previousMoments", moments.previous)
      .constants(SvgfAccumulationConstants{settings.maxSamples, settings.maxMomentSamples, settings.planeTolerance,
                                           settings.normalThreshold})
      .dispatch(extent);
  SvgfAccumulated accumulated;
  accumulated.colour = pass.store("outColour", colour);
  accumulated.moments = pass.store("outMoments", moments.current);
  return accumulated;
}

}  // namespace walr
