#include "passes/temporal/svgf_accumulation.h"

#include <string>

#include "passes/temporal/reprojection.h"
#include "passes/temporal/temporal_accumulation.h"
#include "shaders/shaders.h"
#include "shaders/temporal/svgf_accumulation.h"

namespace walr {

SvgfAccumulated addSvgfAccumulation(StageGraph graph, const DenoiserInputs& inputs, const Guides& guides,
                                    fg::Texture previousColour, fg::Texture colour,
                                    const SvgfAccumulationSettings& settings, const ReflectionMotion& reflection) {
  const bool specular = reflection.taps.valid();
  const fg::Extent extent = graph->textureDesc(inputs.lighting).extent;
  const fg::History moments = graph->history("svgf.moments", {VK_FORMAT_R16G16B16A16_SFLOAT, extent});

  const auto declare = [&](const std::string& name, const fg::Shader& shader, bool reprojects) {
    fg::PassBuilder pass = graph->compute(name, shader);
    pass.uniform("frameConstants", inputs.frame).sample("depth", guides.depth);
    const StandIns standIns{.colour = inputs.lighting, .number = guides.depth};
    if (reprojects) {
      readReprojection(pass, inputs, guides, reprojectionOf(inputs.scene, false, HistoryRejection::Plane, false),
                       standIns);
    }
    readConfidence(pass, specular ? reflection.confidence : inputs.confidence, inputs, standIns);
    pass.sample("lighting", inputs.lighting)
        .sample("previousColour", previousColour)
        .sample("previousMoments", moments.previous)
        .constants(SvgfAccumulationConstants{settings.maxHistory, settings.maxMomentHistory,
                                             settings.thresholds.planeTolerance, settings.thresholds.normalThreshold})
        .dispatch(extent);
    return pass;
  };
  graph.offer(accumulationViews(false), extent, [&](const std::string& name) {
    fg::PassBuilder pass = declare(name, shaders::svgfAccumulationView, true);
    pass.specialize("kKeepableMotion", false)
        .specialize("kTapsGiven", specular)
        .sampleIf(specular, "givenTaps", reflection.taps, guides.depth);
    return pass;
  });
  fg::PassBuilder pass = declare("svgf accumulation", shaders::svgfAccumulation({.specular = specular}), !specular);
  SvgfAccumulated accumulated;
  if (specular) {
    pass.sample("givenTaps", reflection.taps)
        .sample("shadingNormal", guides.shadingNormal)
        .sample("roughness", inputs.roughness);
    accumulated.lobes = pass.store("outLobes", graph->texture("svgf.lobes", {VK_FORMAT_R32G32_UINT, extent}));
  }
  accumulated.colour = pass.store("outColour", colour);
  accumulated.moments = pass.store("outMoments", moments.current);
  graph.offerHistoryLength(accumulated.moments, 2);
  return accumulated;
}

}  // namespace walr
