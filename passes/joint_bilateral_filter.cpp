#include "passes/joint_bilateral_filter.h"

#include "shaders/constants/joint_bilateral.h"
#include "shaders/shaders.h"

namespace walr {
namespace {

float falloff(float sigma) {
  return 1.0F / (2.0F * sigma * sigma);
}

}  // namespace

fg::Texture addJointBilateralFilter(fg::Graph& graph, fg::Buffer frame, fg::Texture lighting, const Guides& guides,
                                    fg::Texture output, const JointBilateralFilterSettings& settings) {
  fg::PassBuilder pass = graph.compute("joint bilateral filter", shaders::jointBilateral);
  pass.uniform("frameConstants", frame)
      .sample("depth", guides.depth)
      .sample("shadingNormal", guides.shadingNormal)
      .sample("geometricNormal", guides.geometricNormal)
      .sample("lighting", lighting)
      .specialize("kRadius", settings.radius)
      .constants(JointBilateralConstants{falloff(settings.sigmaPosition), falloff(settings.sigmaColour),
                                         falloff(settings.sigmaNormal), falloff(settings.sigmaPlane)})
      .dispatch(graph.textureDesc(lighting).extent);
  return pass.store("outFiltered", output);
}

}  // namespace walr
