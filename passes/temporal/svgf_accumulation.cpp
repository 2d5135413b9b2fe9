#include "passes/temporal/svgf_accumulation.h"

#include <string>

#include "passes/temporal/reprojection.h"
#include "passes/temporal/temporal_accumulation.h"
#include "shaders/shaders.h"
#include "shaders/temporal/svgf_accumulation.h"

namespace walr {

SvgfAccumulated addSvgfAccumulation(StageGraph graph, const DenoiserInputs& inputs, const Guides& guides,
                                    fg::Texture previousColour, fg::Texture colour,
                                    const SvgfAccumulationSettings& settings) {
  const fg::Extent extent = graph->textureDesc(inputs.lighting).extent;
  const fg::History moments = graph->history("svgf.moments", {VK_FORMAT_R16G16B16A16_SFLOAT, extent});

  const auto declare = [&](const std::string& name, const fg::Shader& shader) {
    fg::PassBuilder pass = graph->compute(name, shader);
    pass.uniform("frameConstants", inputs.frame).sample("depth", guides.depth);
    const StandIns standIns{.colour = inputs.lighting, .number = guides.depth};
    const ReprojectionSettings reprojection = reprojectionOf(inputs.scene, false, HistoryRejection::Plane, false);
    readReprojection(pass, inputs, guides, reprojection, standIns);
    readConfidence(pass, inputs.confidence, inputs, standIns);
    pass.sample("lighting", inputs.lighting)
        .sample("previousColour", previousColour)
        .sample("previousMoments", moments.previous)
        .constants(SvgfAccumulationConstants{settings.maxHistory, settings.maxMomentHistory,
                                             settings.thresholds.planeTolerance, settings.thresholds.normalThreshold})
        .dispatch(extent);
    return pass;
  };
  graph.offer(accumulationViews(false), extent, [&](const std::string& name) {
    fg::PassBuilder pass = declare(name, shaders::svgfAccumulationView);
    pass.specialize("kKeepableMotion", false);
    return pass;
  });
  fg::PassBuilder pass = declare("svgf accumulation", shaders::svgfAccumulation);
  SvgfAccumulated accumulated;
  accumulated.colour = pass.store("outColour", colour);
  accumulated.moments = pass.store("outMoments", moments.current);
  graph.offerHistoryLength(accumulated.moments, 2);
  return accumulated;
}

}  // namespace walr
