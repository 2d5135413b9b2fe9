#include "passes/filters/svgf_filter.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "passes/stage/grid_extent.h"
#include "shaders/filters/svgf_filter.h"
#include "shaders/shaders.h"

namespace walr {
namespace {

/// Declare what every pass of the filter reads.
/// @param lobes  in place of shading normals, or not valid
fg::PassBuilder filterPass(StageGraph graph, std::string name, const fg::Shader& shader, fg::Buffer frame,
                           fg::Texture colour, const Guides& guides, const SvgfFilterSettings& settings,
                           fg::Texture lobes = {}) {
  fg::PassBuilder pass = graph.compute(std::move(name), shader);
  pass.uniform("frameConstants", frame)
      .sample("depth", guides.depth)
      .sample(lobes.valid() ? "lobes" : "shadingNormal", lobes.valid() ? lobes : guides.shadingNormal)
      .sample("geometricNormal", guides.geometricNormal)
      .sample("colour", colour)
      .constants(SvgfFilterConstants{1.0F / settings.sigmaDepth, settings.sigmaNormal, settings.sigmaLuminance,
                                     settings.minHistory})
      .dispatch(graph.textureDesc(colour).extent);
  return pass;
}

/// Largest radius whose taps fit in 16 KiB of shared memory, which every device has (svgf_taps.glsl).
constexpr std::uint32_t kLargestTiledRadius = 2;

/// Threads that cover all pixels with the interleaved groups of svgf_taps.glsl: 8 quads of pixels per axis, as far
/// apart as taps.
fg::Extent tileThreads(fg::Extent pixels, std::uint32_t spacing) {
  const std::uint32_t area = 8 * std::max(spacing, 2U);
  return {gridExtent(pixels, area).width * area, gridExtent(pixels, area).height * area};
}

fg::Texture colourTexture(StageGraph graph, fg::Texture like, std::string name) {
  return graph.texture(std::move(name), {VK_FORMAT_R16G16B16A16_SFLOAT, graph.textureDesc(like).extent});
}

constexpr const char* kVariancePass = "svgf variance";

/// In the order of `view` of svgf_variance.comp.
const std::vector<ViewInfo>& varianceViews() {
  static const std::vector<ViewInfo> kViews{
      {"deviation",
       "Standard deviation of the luminance, 1 where its spread over the surface stands in for that over time, 1 where "
       "there is no sample",
       {{"deviations-from-surroundings", "Y"}, {"unsampled-pixels", "Z"}}},
  };
  return kViews;
}

/// Largest radius of the full window.
constexpr std::uint32_t kFullestRadius = 64;

/// One pass of the filter.
struct Kernel {
  std::uint32_t radius;   ///< Taps on each side of the centre.
  std::uint32_t spacing;  ///< Pixels between taps.
  float gaussianFalloff;  ///< exp(-falloff d^2) at a distance of d pixels; 0: binomial.
};

bool fitsTile(const Kernel& kernel) {
  return kernel.radius <= kLargestTiledRadius && kernel.gaussianFalloff == 0.0F;
}

std::vector<Kernel> kernelsOf(const SvgfFilterSettings& settings) {
  std::vector<Kernel> kernels;
  std::uint32_t reach = 0;
  float variance = 0.0F;
  for (std::uint32_t i = 0; i < settings.iterations; ++i) {
    const std::uint32_t spacing = 1U << i;
    kernels.push_back({settings.radius, spacing, 0.0F});
    reach += settings.radius * spacing;
    // A binomial row of order 2r has the variance r / 2.
    variance += 0.5F * static_cast<float>(settings.radius * spacing * spacing);
  }
  if (settings.window == SvgfWindow::Atrous) return kernels;
  if (reach > kFullestRadius) {
    throw std::invalid_argument("svgf.window=full over " + std::to_string(2 * reach + 1) +
                                " pixels, to which svgf.radius=" + std::to_string(settings.radius) +
                                " and svgf.iterations=" + std::to_string(settings.iterations) +
                                " reach, is too large; at most " + std::to_string(2 * kFullestRadius + 1) +
                                ": take fewer iterations");
  }
  return {{reach, 1, 0.5F / variance}};
}

}  // namespace

fg::Texture addSvgfVariance(StageGraph graph, fg::Buffer frame, const SvgfAccumulated& accumulated,
                            const Guides& guides, const SvgfFilterSettings& settings) {
  const auto declare = [&](const std::string& name, const fg::Shader& shader) {
    fg::PassBuilder pass = filterPass(graph, name, shader, frame, accumulated.colour, guides, settings);
    pass.sample("moments", accumulated.moments).specialize("kSingleFrame", false);
    return pass;
  };
  graph.offer(varianceViews(), graph->textureDesc(accumulated.colour).extent,
              [&](const std::string& name) { return declare(name, shaders::svgfVarianceView); });
  fg::PassBuilder pass = declare(kVariancePass, shaders::svgfVariance);
  return pass.store("outColour", colourTexture(graph, accumulated.colour, "svgf.variance"));
}

fg::Texture addSvgfSingleFrameVariance(StageGraph graph, fg::Buffer frame, fg::Texture lighting, const Guides& guides,
                                       const SvgfFilterSettings& settings) {
  const auto declare = [&](const std::string& name, const fg::Shader& shader) {
    fg::PassBuilder pass = filterPass(graph, name, shader, frame, lighting, guides, settings);
    pass.unread("moments", lighting).specialize("kSingleFrame", true);
    return pass;
  };
  graph.offer(varianceViews(), graph->textureDesc(lighting).extent,
              [&](const std::string& name) { return declare(name, shaders::svgfVarianceView); });
  fg::PassBuilder pass = declare(kVariancePass, shaders::svgfVariance);
  return pass.store("outColour", colourTexture(graph, lighting, "svgf.variance"));
}

fg::Texture addSvgfAtrous(StageGraph graph, fg::Buffer frame, fg::Texture colour, const Guides& guides,
                          fg::Texture lobes, fg::Texture feedback, const SvgfFilterSettings& settings) {
  const std::vector<Kernel> kernels = kernelsOf(settings);
  if (settings.feedback > kernels.size()) {
    throw std::invalid_argument("svgf.feedback (" + std::to_string(settings.feedback) +
                                ") must not exceed the number of iterations (" + std::to_string(kernels.size()) + ")" +
                                (settings.window == SvgfWindow::Full
                                     ? ": svgf.window=full is one; lower svgf.feedback or set svgf.window=atrous"
                                     : ""));
  }
  if (settings.lobeShare == 0.0F) lobes = {};
  for (std::size_t i = 0; i < kernels.size(); ++i) {
    const std::string number = std::to_string(i);
    const Kernel& kernel = kernels[i];
    const bool tiled = fitsTile(kernel);
    fg::PassBuilder pass =
        filterPass(graph, "svgf a-trous " + number, shaders::svgfAtrous({.window = !tiled, .specular = lobes.valid()}),
                   frame, colour, guides, settings, lobes);
    pass.specialize("kRadius", kernel.radius)
        .specialize("kSpacing", kernel.spacing)
        .specialize("kLuminanceWeight", settings.luminanceWeight);
    if (lobes.valid()) pass.specialize("kLobeShare", settings.lobeShare);
    if (tiled) {
      pass.dispatch(tileThreads(graph.textureDesc(colour).extent, kernel.spacing));
    } else {
      pass.specialize("kGaussianFalloff", kernel.gaussianFalloff);
    }
    const bool feedsBack = i + 1 == settings.feedback && feedback.valid();
    colour = pass.store("outColour", feedsBack ? feedback : colourTexture(graph, colour, "svgf.filtered " + number));
  }
  return colour;
}

}  // namespace walr
