#include "passes/prepare_guides.h"

#include "shaders/constants/prepare_guides.h"
#include "shaders/shaders.h"

namespace walr {

Guides addPrepareGuides(fg::Graph& graph, const DenoiserInputs& inputs, const PrepareGuidesSettings& settings) {
  const fg::Extent extent = graph.textureDesc(inputs.depth).extent;
  const fg::History depth = graph.history("guides.depth", {VK_FORMAT_R32_UINT, extent});
  const fg::History geometricNormal = graph.history("guides.geometric normal", {VK_FORMAT_R32_UINT, extent});
  const fg::Texture shadingNormal = graph.texture("guides.shading normal", {VK_FORMAT_R32_UINT, extent});

  fg::PassBuilder pass = graph.compute("prepare guides", shaders::prepareGuides);
  pass.uniform("frameConstants", inputs.frame)
      .sample("depth", inputs.depth)
      .sample("normal", inputs.normal)
      .sample("albedo", inputs.albedo)
      .specialize("kNormalsInWorldSpace", inputs.conventions.normal == InputConventions::Space::World)
      .constants(PrepareGuidesConstants{settings.albedoThreshold, settings.normalAgreement})
      .texels(extent)
      .dispatch(extent);
  Guides guides;
  guides.depth = pass.store("outDepth", depth.current);
  guides.shadingNormal = pass.store("outShadingNormal", shadingNormal);
  guides.geometricNormal = pass.store("outGeometricNormal", geometricNormal.current);
  guides.previousDepth = depth.previous;
  guides.previousGeometricNormal = geometricNormal.previous;
  return guides;
}

}  // namespace walr
