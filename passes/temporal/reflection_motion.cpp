#include "passes/temporal/reflection_motion.h"

#include <stdexcept>
#include <string>
#include <vector>

#include "passes/guides/guide_pass.h"
#include "passes/temporal/reflection_pass.h"
#include "shaders/shaders.h"
#include "shaders/temporal/reflection_motion.h"

namespace walr {
namespace {

/// In the order of `view` of the shader.
const std::vector<ViewInfo>& reflectionViews() {
  static const std::vector<ViewInfo> kViews{
      {"reflection-motion",
       "Motion of specular light to the previous frame, x and y in pixels; 1 where it is not that of the surface",
       {{"followed-reflections", "Z"}}},
      {"reflection-history",
       "Longest history of specular light, frames; by how much its ray of the previous frame misses what is reflected, "
       "over the lobe's half angle or half a pixel; 1 where that, or the host's confidence, shortens history",
       {{"shortened-reflections", "Z"}}},
  };
  return kViews;
}

/// A pass that finds the motion of reflections and does nothing else.
fg::PassBuilder declareSearch(const ReflectionSearch& search, const std::string& name, const fg::Shader& shader) {
  const DenoiserInputs& inputs = search.inputs;
  fg::PassBuilder pass = search.graph->compute(name, shader);
  readReflections(pass, search);
  pass.uniform("frameConstants", inputs.frame)
      .sample("lighting", inputs.lighting)
      .dispatch(search.graph->textureDesc(inputs.depth).extent);
  const StandIns standIns{.colour = inputs.lighting, .number = search.guides.previousDepth};
  readReprojection(pass, inputs, search.guides, reflectionReprojection(inputs, search.settings), standIns);
  readConfidence(pass, inputs.confidence, inputs, standIns);
  return pass;
}

}  // namespace

ReflectionSearch searchReflections(StageGraph graph, const DenoiserInputs& inputs, const Guides& guides,
                                   const TemporalAccumulationSettings& settings,
                                   const ReflectionMotionSettings& reflection,
                                   const std::optional<PrepareGuidesSettings>& host) {
  if (settings.rejection != HistoryRejection::Plane) {
    throw std::invalid_argument("specular light tests its history by plane: leave accumulation.rejection at plane");
  }
  const fg::Extent extent = graph->textureDesc(inputs.depth).extent;
  const fg::History reflectors = graph->history("reflectors", {VK_FORMAT_R32G32_UINT, extent});
  ReflectionSearch search{graph, inputs, guides, settings, reflection, reflectors, host};
  graph.offer(reflectionViews(), extent, [&](const std::string& name) {
    return declareSearch(search, name, host ? shaders::reflectionMotionViewHost : shaders::reflectionMotionView);
  });
  return search;
}

ReprojectionSettings reflectionReprojection(const DenoiserInputs& inputs,
                                            const TemporalAccumulationSettings& settings) {
  ReprojectionSettings reprojection = reprojectionOf(inputs.scene, false, settings.rejection, settings.dilateMotion);
  reprojection.testsNormals = false;
  return reprojection;
}

void readReflections(fg::PassBuilder& pass, const ReflectionSearch& search) {
  const HistoryThresholds& thresholds = search.settings.thresholds;
  const ReflectionMotionConstants constants{thresholds.planeTolerance,     thresholds.normalThreshold,
                                            search.settings.maxHistory,    maxHistoryAtRest(search.settings),
                                            search.reflection.surfaceFrom, search.reflection.historyPerLobe};
  const fg::Texture motion = search.inputs.specularMotion;
  pass.sample("roughness", search.inputs.roughness)
      .sample("previousReflector", search.reflectors.previous)
      .specialize("kSpecularMotion", motion.valid())
      .sampleIf(motion.valid(), "specularMotion", motion, search.inputs.lighting);
  if (search.host) {
    readGBuffer(pass, search.inputs, *search.host);
    pass.constants(HostReflectionConstants{guideConstants(search.graph, search.inputs, *search.host, {}), constants});
  } else {
    pass.sample("depth", search.guides.depth).sample("shadingNormal", search.guides.shadingNormal).constants(constants);
  }
}

ReflectionMotion addReflectionMotion(StageGraph graph, const DenoiserInputs& inputs, const Guides& guides,
                                     const TemporalAccumulationSettings& settings,
                                     const ReflectionMotionSettings& reflection, bool distances) {
  const ReflectionSearch search = searchReflections(graph, inputs, guides, settings, reflection);
  fg::PassBuilder pass = declareSearch(search, "reflection motion",
                                       distances ? shaders::reflectionMotionDistances : shaders::reflectionMotion);
  const fg::Extent extent = graph->textureDesc(guides.depth).extent;
  ReflectionMotion result;
  result.taps = pass.store("outTaps", graph->texture("reflection taps", {VK_FORMAT_R32_UINT, extent}));
  result.confidence =
      pass.store("outConfidence", graph->texture("reflection confidence", {VK_FORMAT_R8_UNORM, extent}));
  result.reflectors = pass.store("outReflector", search.reflectors.current);
  return result;
}

}  // namespace walr
