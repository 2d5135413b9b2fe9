#include "passes/prepare_guides.h"

#include <algorithm>
#include <string>
#include <vector>

#include "shaders/constants/prepare_guides.h"
#include "shaders/shaders.h"

namespace walr {
namespace {

/// Whether pixels without a diffuse lobe are treated like sky.
bool isMasked(const PrepareGuidesSettings& settings) {
  return settings.albedoThreshold > 0.0F;
}

/// A guide to write, and the previous frame's if it is kept.
struct GuideTexture {
  fg::Texture current;
  fg::Texture previous;
};

GuideTexture guideTexture(fg::Graph& graph, const std::string& name, const fg::TextureDesc& desc, bool keep) {
  if (!keep) return {graph.texture(name, desc), {}};
  const fg::History history = graph.history(name, desc);
  return {history.current, history.previous};
}

/// In the order of `kView` of prepare_guides.comp.
const std::vector<ViewInfo>& guideViews() {
  static const std::vector<ViewInfo> kViews{
      {"no-surface",
       "1 where nothing is denoised: for its depth (sky), else for its normal, else for want of a diffuse lobe",
       {{"sky", "X"}, {"unusable-normals", "Y"}, {"no-diffuse-lobe", "Z"}}},
      {"broken-guides",
       "1 where depth, normal, albedo are not finite",
       {{"non-finite-depth", "X"}, {"non-finite-normals", "Y"}, {"non-finite-albedo", "Z"}}},
  };
  return kViews;
}

/// A pass without its outputs.
fg::PassBuilder declarePass(fg::Graph& graph, const std::string& name, const fg::Shader& shader,
                            const DenoiserInputs& inputs, const PrepareGuidesSettings& settings,
                            const AmbientOcclusionSettings& occlusion = {}) {
  const fg::Extent extent = graph.textureDesc(inputs.depth).extent;
  const float occlusionRadius = std::max(occlusion.radius * static_cast<float>(extent.height), 1.0F);
  fg::PassBuilder pass = graph.compute(name, shader);
  pass.uniform("frameConstants", inputs.frame)
      .sample("depth", inputs.depth)
      .sample("normal", inputs.normal)
      .specialize("kNormalsInWorldSpace", inputs.conventions.normal == InputConventions::Space::World)
      .specialize("kSky", inputs.scene.sky)
      .specialize("kDiffuseMask", isMasked(settings))
      .sampleIf(isMasked(settings), "albedo", inputs.albedo, inputs.normal)
      .constants(PrepareGuidesConstants{settings.albedoThreshold, settings.tangentTolerance, settings.normalAgreement,
                                        occlusionRadius})
      .texels(extent)
      .dispatch(extent);
  return pass;
}

}  // namespace

Guides addPrepareGuides(StageGraph graph, const DenoiserInputs& inputs, const PrepareGuidesSettings& settings,
                        const GuideNeeds& needs) {
  const fg::Extent extent = graph->textureDesc(inputs.depth).extent;
  graph.offer(guideViews(), extent, [&](const std::string& name) {
    return declarePass(graph, name, shaders::prepareGuidesView, inputs, settings);
  });
  const bool occludes = needs.occlusion.has_value();
  const fg::Shader& shader = shaders::prepareGuides({.geometry = needs.geometricNormal, .occlusion = occludes});
  fg::PassBuilder pass = declarePass(graph, "prepare guides", shader, inputs, settings,
                                     needs.occlusion.value_or(AmbientOcclusionSettings{}));
  Guides guides;
  const fg::TextureDesc word{VK_FORMAT_R32_UINT, extent};
  const GuideTexture depth = guideTexture(graph, "guides.depth", word, needs.history);
  guides.depth = pass.store("outDepth", depth.current);
  guides.previousDepth = depth.previous;
  if (occludes) {
    pass.specialize("kOcclusionSteps", needs.occlusion->steps);
    guides.features = pass.store("outFeatures", guideTexture(graph, "guides.features", word, false).current);
  } else {
    const GuideTexture shadingNormal = guideTexture(graph, "guides.shading normal", word, false);
    guides.shadingNormal = pass.store("outShadingNormal", shadingNormal.current);
  }
  if (!needs.geometricNormal) return guides;
  const fg::TextureDesc normalDesc{occludes ? VK_FORMAT_R16_UINT : VK_FORMAT_R32_UINT, extent};
  const GuideTexture geometricNormal = guideTexture(graph, "guides.geometric normal", normalDesc, needs.history);
  guides.geometricNormal = pass.store("outGeometricNormal", geometricNormal.current);
  guides.previousGeometricNormal = geometricNormal.previous;
  return guides;
}

}  // namespace walr
