#include "passes/prepare_guides.h"

#include "shaders/constants/prepare_guides.h"
#include "shaders/shaders.h"

namespace walr {

Guides addPrepareGuides(fg::Graph& graph, const DenoiserInputs& inputs, const PrepareGuidesSettings& settings) {
  const fg::Extent extent = graph.textureDesc(inputs.depth).extent;
  const fg::History depth = graph.history("guides.depth", {VK_FORMAT_R32_UINT, extent});
  const fg::History normals = graph.history("guides.normals", {VK_FORMAT_R32G32_UINT, extent});

  fg::PassBuilder pass = graph.compute("prepare guides", shaders::prepareGuides);
  pass.uniform("frameConstants", inputs.frame)
      .sample("depth", inputs.depth)
      .sample("normal", inputs.normal)
      .sample("albedo", inputs.albedo)
      .specialize("kNormalsInWorldSpace", inputs.conventions.normal == InputConventions::Space::World)
      .constants(PrepareGuidesConstants{settings.albedoThreshold, settings.normalAgreement})
      .dispatch(extent);
  Guides guides;
  guides.depth = pass.store("outDepth", depth.current);
  guides.normals = pass.store("outNormals", normals.current);
  guides.previousDepth = depth.previous;
  guides.previousNormals = normals.previous;
  return guides;
}

}  // namespace walr
