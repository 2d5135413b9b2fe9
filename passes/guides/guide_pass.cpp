#include "passes/guides/guide_pass.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "shaders/shaders.h"

namespace walr {
namespace {

/// Whether pixels without a diffuse lobe are treated like sky.
bool isMasked(const PrepareGuidesSettings& settings) {
  return settings.albedoThreshold > 0.0F;
}

/// No more rings than the shader's arrays hold, also for settings whose range nobody has checked.
std::uint32_t ringsOf(const AmbientOcclusionSettings& occlusion) {
  return std::min(occlusion.rings, kMaxOcclusionRings);
}

/// A guide to write, and the previous frame's if it is kept.
struct GuideTexture {
  fg::Texture current;
  fg::Texture previous;
};

GuideTexture guideTexture(StageGraph graph, const std::string& name, const fg::TextureDesc& desc, bool keep) {
  if (!keep) return {graph.texture(name, desc), {}};
  const fg::History history = graph.history(name, desc);
  return {history.current, history.previous};
}

/// In the order of `view` of prepare_guides.comp.
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

}  // namespace

void offerGuideViews(StageGraph graph, const DenoiserInputs& inputs, const PrepareGuidesSettings& settings) {
  const fg::Extent extent = graph->textureDesc(inputs.depth).extent;
  graph.offer(guideViews(), extent, [&](const std::string& name) {
    fg::PassBuilder pass = graph->compute(name, shaders::prepareGuidesView);
    readGBuffer(pass, inputs, settings);
    pass.uniform("frameConstants", inputs.frame)
        .constants(guideConstants(graph, inputs, settings, {}))
        .texels(extent)
        .dispatch(extent);
    return pass;
  });
}

PrepareGuidesConstants guideConstants(const fg::Graph& graph, const DenoiserInputs& inputs,
                                      const PrepareGuidesSettings& settings, const GuideNeeds& needs) {
  const AmbientOcclusionSettings occlusion = needs.occlusion.value_or(AmbientOcclusionSettings{});
  const fg::Extent extent = graph.textureDesc(inputs.depth).extent;
  const float radius = std::max(occlusion.radius * static_cast<float>(extent.height), 1.0F);
  PrepareGuidesConstants constants{
      settings.albedoThreshold, settings.tangentTolerance, settings.normalAgreement, 1.0F / radius, {}, {}};
  // Distances grow by equal factors, from the next pixel, so that contacts are seen, to 2/3 of the radius: beyond,
  // little counts.
  const std::uint32_t rings = ringsOf(occlusion);
  const float longest = std::max(radius * 2.0F / 3.0F, 1.0F);
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    const float power = rings > 1 ? static_cast<float>(ring) / static_cast<float>(rings - 1) : 0.0F;
    const std::uint32_t nearest = ring / 2 + 1;
    const float distance = std::max(std::round(std::pow(longest, power)), static_cast<float>(nearest));
    constants.occlusionDistances[ring] = distance;
    constants.inverseOcclusionDistances[ring] = 1.0F / distance;
  }
  return constants;
}

void readGBuffer(fg::PassBuilder& pass, const DenoiserInputs& inputs, const PrepareGuidesSettings& settings) {
  pass.sample("hostDepth", inputs.depth)
      .sample("normal", inputs.normal)
      .specialize("kNormalsInWorldSpace", inputs.conventions.normal == InputConventions::Space::World)
      .specialize("kSky", inputs.scene.sky)
      .specialize("kDiffuseMask", isMasked(settings))
      .sampleIf(isMasked(settings), "albedo", inputs.lobeAlbedo(), inputs.normal);
}

bool geometricNormalIsApart(const GuideNeeds& needs) {
  return needs.geometricNormal && !needs.occlusion;
}

Guides writeGuides(StageGraph graph, fg::PassBuilder& pass, fg::Extent extent, const GuideNeeds& needs) {
  Guides guides;
  const fg::TextureDesc word{VK_FORMAT_R32_UINT, extent};
  const GuideTexture depth = guideTexture(graph, "guides.depth", word, needs.history);
  guides.depth = pass.store("outDepth", depth.current);
  guides.previousDepth = depth.previous;
  const bool occlusion = needs.occlusion.has_value();
  pass.specialize("kOcclusion", occlusion)
      .specialize("kOcclusionRings", ringsOf(needs.occlusion.value_or(AmbientOcclusionSettings{})));
  const char* const name = occlusion ? "guides.features" : "guides.shading normal";
  (occlusion ? guides.features : guides.shadingNormal) = pass.store("outFeatures", graph.texture(name, word));
  if (!geometricNormalIsApart(needs)) return guides;
  const GuideTexture geometricNormal =
      guideTexture(graph, "guides.geometric normal", word, needs.history && needs.normalHistory);
  guides.geometricNormal = pass.store("outGeometricNormal", geometricNormal.current);
  guides.previousGeometricNormal = geometricNormal.previous;
  return guides;
}

}  // namespace walr
