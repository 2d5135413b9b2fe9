#include "passes/methods/svgf.h"

#include "passes/stage/pass_through.h"
#include "passes/temporal/temporal_stages.h"

namespace walr {
namespace {

fg::Texture addSpatialSvgf(StageGraph graph, const DenoiserInputs& inputs, const Guides& guides, fg::Texture output,
                           const SvgfSettings& settings) {
  const fg::Texture noisy = addSvgfSingleFrameVariance(graph, inputs.frame, inputs.lighting, guides, settings.filter);
  const fg::Texture filtered = addSvgfAtrous(graph, inputs.frame, noisy, guides, {}, {}, settings.filter);
  return addPassThrough(graph, filtered, output);
}

}  // namespace

SvgfSettings tunedSvgf() {
  return {};
}

SvgfSettings paperSvgf() {
  SvgfSettings settings;
  settings.accumulation.maxHistory = 5.0F;
  settings.accumulation.maxSpecularHistory = 5.0F;
  settings.filter.iterations = 5;
  settings.filter.sigmaNormal = 128.0F;
  settings.filter.lobeShare = 0.0F;
  settings.filter.feedback = 1;
  settings.antialiasing.maxHistory = 8.0F;
  return settings;
}

fg::Texture addSvgf(StageGraph graph, const DenoiserInputs& inputs, fg::Texture output, const SvgfSettings& settings) {
  const bool specular = inputs.conventions.specular;
  if (settings.spatialOnly) requireSpatialLight(inputs);
  const Guides guides =
      addPrepareGuides(graph, inputs, settings.guides,
                       {.history = !settings.spatialOnly, .normalHistory = !inputs.conventions.specular});
  if (settings.spatialOnly) return addSpatialSvgf(graph, inputs, guides, output, settings);

  const fg::TextureDesc colourDesc{VK_FORMAT_R16G16B16A16_SFLOAT, graph->textureDesc(inputs.lighting).extent};
  const fg::History colour = graph->history("svgf.colour", colourDesc);
  const fg::Texture mean = settings.filter.feedback == 0 ? colour.current : graph->texture("svgf.mean", colourDesc);

  SvgfAccumulationSettings accumulation = settings.accumulation;
  ReflectionMotion reflection;
  if (specular) {
    accumulation.maxHistory = accumulation.maxSpecularHistory;
    reflection = addReflectionMotion(graph, inputs, guides,
                                     {.maxHistory = accumulation.maxHistory, .thresholds = accumulation.thresholds},
                                     settings.reflection);
  }
  const SvgfAccumulated accumulated =
      addSvgfAccumulation(graph, inputs, guides, colour.previous, mean, accumulation, reflection);
  const fg::Texture guided = addSvgfVariance(graph, inputs.frame, accumulated, guides, settings.filter);
  const fg::Texture filtered =
      addSvgfAtrous(graph, inputs.frame, guided, guides, accumulated.lobes, colour.current, settings.filter);
  if (!settings.antialiasing.enabled || inputs.scene.hostAntialiasing) return addPassThrough(graph, filtered, output);
  if (!specular) return addTemporalAntialiasing(graph, inputs, guides, filtered, output, settings.antialiasing);
  requireGivenTaps(settings.antialiasing);
  const fg::Texture depth = coversPixelArea(settings.antialiasing, inputs.scene) ? guides.depth : fg::Texture{};
  return addTemporalAntialiasingWithTaps(graph, inputs.frame, reflection.taps, depth, filtered, output,
                                         settings.antialiasing);
}

}  // namespace walr
