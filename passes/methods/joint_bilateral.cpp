#include "passes/methods/joint_bilateral.h"

namespace walr {

fg::Texture addJointBilateral(StageGraph graph, const DenoiserInputs& inputs, fg::Texture output,
                              const JointBilateralSettings& settings) {
  // The host's anti-aliasing does not replace this one, which is the method's only accumulation of light.
  const bool accumulate = settings.accumulation.enabled && !settings.spatialOnly;
  const Guides guides =
      addPrepareGuides(graph, inputs, settings.guides, {.history = accumulate && !inputs.scene.still()});
  const fg::TextureDesc colourDesc{VK_FORMAT_R16G16B16A16_SFLOAT, graph->textureDesc(inputs.lighting).extent};
  const fg::Texture target = !accumulate ? output : graph->texture("bilateral.filtered", colourDesc);
  const fg::Texture filtered =
      addJointBilateralFilter(graph, inputs.frame, inputs.lighting, guides, target, settings.filter);
  if (!accumulate) return filtered;
  return addTemporalAntialiasing(graph, inputs, guides, filtered, output, settings.accumulation);
}

}  // namespace walr
