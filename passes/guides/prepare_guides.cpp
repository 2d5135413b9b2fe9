#include "passes/guides/prepare_guides.h"

#include "passes/guides/guide_pass.h"
#include "passes/guides/shared_guides.h"
#include "shaders/shaders.h"

namespace walr {
namespace {

const fg::Shader& shaderFor(const GuideNeeds& needs) {
  if (!needs.geometricNormal) return shaders::prepareGuides;
  return geometricNormalIsApart(needs) ? shaders::prepareGuidesGeometryApart : shaders::prepareGuidesGeometry;
}

}  // namespace

Guides addPrepareGuides(StageGraph graph, const DenoiserInputs& inputs, const PrepareGuidesSettings& settings,
                        const GuideNeeds& needs) {
  if (graph.shared() != nullptr && graph.shared()->prepared())
    return graph.shared()->guidesFor({settings, needs, inputs.scene, inputs.conventions.specular});
  offerGuideViews(graph, inputs, settings);
  const fg::Extent extent = graph->textureDesc(inputs.depth).extent;
  fg::PassBuilder pass = graph->compute("prepare guides", shaderFor(needs));
  readGBuffer(pass, inputs, settings);
  pass.uniform("frameConstants", inputs.frame)
      .constants(guideConstants(graph, inputs, settings, needs))
      .texels(extent)
      .dispatch(extent);
  const Guides guides = writeGuides(graph, pass, extent, needs);
  if (graph.shared() != nullptr)
    graph.shared()->keep({settings, needs, inputs.scene, inputs.conventions.specular}, guides);
  return guides;
}

}  // namespace walr
