#include "passes/joint_bilateral.h"

namespace walr {

fg::Texture addJointBilateral(fg::Graph& graph, const DenoiserInputs& inputs, fg::Texture output,
                              const JointBilateralSettings& settings) {
  const Guides guides = addPrepareGuides(graph, inputs, settings.guides);
  const fg::TextureDesc colourDesc{VK_FORMAT_R16G16B16A16_SFLOAT, graph.textureDesc(inputs.lighting).extent};
  const fg::Texture target = settings.spatialOnly ? output : graph.texture("bilateral.filtered", colourDesc);
  const fg::Texture filtered =
      addJointBilateralFilter(graph, inputs.frame, inputs.lighting, guides, target, settings.filter);
  if (settings.spatialOnly) return filtered;
  return addTemporalAntialiasing(graph, inputs, guides, filtered, output, settings.accumulation);
}

}  // namespace walr
