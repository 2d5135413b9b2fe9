#include "passes/svgf_filter.h"

#include <stdexcept>
#include <string>

#include "shaders/constants/svgf_filter.h"
#include "shaders/shaders.h"

namespace walr {
namespace {

/// Declare what every pass of the filter reads.
fg::PassBuilder filterPass(fg::Graph& graph, std::string name, const fg::Shader& shader, fg::Buffer frame,
                           fg::Texture colour, const Guides& guides, const SvgfFilterSettings& settings) {
  fg::PassBuilder pass = graph.compute(std::move(name), shader);
  pass.uniform("frameConstants", frame)
      .sample("depth", guides.depth)
      .sample("shadingNormal", guides.shadingNormal)
      .sample("geometricNormal", guides.geometricNormal)
      .sample("colour", colour)
      .constants(SvgfFilterConstants{1.0F / settings.sigmaDepth, settings.sigmaNormal, settings.sigmaLuminance,
                                     settings.minHistory})
      .dispatch(graph.textureDesc(colour).extent);
  return pass;
}

fg::Texture colourTexture(fg::Graph& graph, fg::Texture like, std::string name) {
  return graph.texture(std::move(name), {VK_FORMAT_R16G16B16A16_SFLOAT, graph.textureDesc(like).extent});
}

}  // namespace

fg::Texture addSvgfVariance(fg::Graph& graph, fg::Buffer frame, const SvgfAccumulated& accumulated,
                            const Guides& guides, const SvgfFilterSettings& settings) {
  fg::PassBuilder pass =
      filterPass(graph, "svgf variance", shaders::svgfVariance, frame, accumulated.colour, guides, settings);
  pass.sample("moments", accumulated.moments);
  return pass.store("outColour", colourTexture(graph, accumulated.colour, "svgf.variance"));
}

fg::Texture addSvgfSingleFrameVariance(fg::Graph& graph, fg::Buffer frame, fg::Texture lighting, const Guides& guides,
                                       const SvgfFilterSettings& settings) {
  fg::PassBuilder pass =
      filterPass(graph, "svgf variance", shaders::svgfVarianceSingleFrame, frame, lighting, guides, settings);
  return pass.store("outColour", colourTexture(graph, lighting, "svgf.variance"));
}

fg::Texture addSvgfAtrous(fg::Graph& graph, fg::Buffer frame, fg::Texture colour, const Guides& guides,
                          fg::Texture feedback, const SvgfFilterSettings& settings) {
  if (settings.feedback > settings.iterations) {
    throw std::invalid_argument("svgf.feedback (" + std::to_string(settings.feedback) +
                                ") must not exceed svgf.iterations (" + std::to_string(settings.iterations) + ")");
  }
  for (std::uint32_t i = 0; i < settings.iterations; ++i) {
    const std::string number = std::to_string(i);
    fg::PassBuilder pass =
        filterPass(graph, "svgf a-trous " + number, shaders::svgfAtrous, frame, colour, guides, settings);
    pass.specialize("kRadius", settings.radius)
        .specialize("kSpacing", 1U << i)
        .specialize("kLuminanceWeight", settings.luminanceWeight);
    const bool feedsBack = i + 1 == settings.feedback && feedback.valid();
    colour = pass.store("outColour", feedsBack ? feedback : colourTexture(graph, colour, "svgf.filtered " + number));
  }
  return colour;
}

}  // namespace walr
