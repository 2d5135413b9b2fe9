#include "passes/temporal/reflection_motion.h"

#include <stdexcept>
#include <string>
#include <vector>

#include "passes/temporal/reprojection.h"
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

}  // namespace

ReflectionMotion addReflectionMotion(StageGraph graph, const DenoiserInputs& inputs, const Guides& guides,
                                     const TemporalAccumulationSettings& settings,
                                     const ReflectionMotionSettings& reflection, bool distances) {
  if (settings.rejection != HistoryRejection::Plane) {
    throw std::invalid_argument("specular light tests its history by plane: leave accumulation.rejection at plane");
  }
  if (inputs.conventions.motionDepth == InputConventions::MotionDepth::Found && inputs.scene.objectMotion) {
    throw std::invalid_argument(
        "specular light needs the third channel of motion where objects move: motion depth cannot be found");
  }
  const fg::Extent extent = graph.textureDesc(guides.depth).extent;
  const fg::History reflectors = graph.history("reflectors", {VK_FORMAT_R32G32_UINT, extent});
  const StandIns standIns{.colour = inputs.lighting, .number = guides.depth};
  const auto declare = [&](const std::string& name, const fg::Shader& shader) {
    fg::PassBuilder pass = graph.compute(name, shader);
    pass.uniform("frameConstants", inputs.frame)
        .sample("lighting", inputs.lighting)
        .sample("roughness", inputs.roughness)
        .sample("depth", guides.depth)
        .sample("shadingNormal", guides.shadingNormal)
        .sample("previousReflector", reflectors.previous)
        .constants(ReflectionMotionConstants{settings.thresholds.planeTolerance, settings.thresholds.normalThreshold,
                                             settings.maxHistory, reflection.surfaceFrom, reflection.historyPerLobe})
        .dispatch(extent);
    ReprojectionSettings reprojection = reprojectionOf(inputs.scene, false, settings.rejection, settings.dilateMotion);
    reprojection.testsNormals = false;
    readReprojection(pass, inputs, guides, reprojection, standIns);
    readConfidence(pass, inputs.confidence, inputs, standIns);
    return pass;
  };
  graph.offer(reflectionViews(), extent,
              [&](const std::string& name) { return declare(name, shaders::reflectionMotionView); });
  fg::PassBuilder pass =
      declare("reflection motion", distances ? shaders::reflectionMotionDistances : shaders::reflectionMotion);
  ReflectionMotion result;
  result.taps = pass.store("outTaps", graph.texture("reflection taps", {VK_FORMAT_R32_UINT, extent}));
  result.confidence = pass.store("outConfidence", graph.texture("reflection confidence", {VK_FORMAT_R8_UNORM, extent}));
  result.reflectors = pass.store("outReflector", reflectors.current);
  return result;
}

}  // namespace walr
