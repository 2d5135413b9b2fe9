#include "passes/filters/joint_bilateral_filter.h"

#include <string>
#include <vector>

#include "shaders/filters/joint_bilateral.h"
#include "shaders/shaders.h"

namespace walr {
namespace {

float falloff(float sigma) {
  return 1.0F / (2.0F * sigma * sigma);
}

/// In the order of `view` of joint_bilateral.comp.
const std::vector<ViewInfo>& filterViews() {
  static const std::vector<ViewInfo> kViews{
      {"weights",
       "Sum of the weights, 1 where the pixel has no sample, 1 where nothing within the window has any",
       {{"unsampled-pixels", "Y"}, {"no-samples", "Z"}}},
  };
  return kViews;
}

}  // namespace

fg::Texture addJointBilateralFilter(StageGraph graph, fg::Buffer frame, fg::Texture lighting, const Guides& guides,
                                    fg::Texture output, const JointBilateralFilterSettings& settings) {
  const fg::Extent extent = graph->textureDesc(lighting).extent;
  const auto declare = [&](const std::string& name, const fg::Shader& shader) {
    fg::PassBuilder pass = graph->compute(name, shader);
    pass.uniform("frameConstants", frame)
        .sample("depth", guides.depth)
        .sample("shadingNormal", guides.shadingNormal)
        .sample("geometricNormal", guides.geometricNormal)
        .sample("lighting", lighting)
        .specialize("kRadius", settings.radius)
        .constants(JointBilateralConstants{falloff(settings.sigmaPosition), falloff(settings.sigmaColour),
                                           falloff(settings.sigmaNormal), falloff(settings.sigmaPlane)})
        .dispatch(extent);
    return pass;
  };
  graph.offer(filterViews(), extent,
              [&](const std::string& name) { return declare(name, shaders::jointBilateralView); });
  fg::PassBuilder pass = declare("joint bilateral filter", shaders::jointBilateral);
  return pass.store("outFiltered", output);
}

}  // namespace walr
