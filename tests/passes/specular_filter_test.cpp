// The method `walr` on specular light: its regression against the double-precision reference, and what its parts
// promise.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "passes/methods/denoiser.h"
#include "tests/error_text.h"
#include "tests/passes/block_filter.h"
#include "tests/passes/comparison.h"
#include "tests/passes/denoiser_run.h"
#include "tests/passes/filter_run.h"
#include "tests/passes/reference/block_regression.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::specular_filter_test {
namespace {

using reference::Guide;
using reference::HostFrame;
using reference::Image;
using reference::Reflector;

constexpr glm::ivec2 kSize(45, 34);

class SpecularFilter : public fg::test::GpuTest {};

// Of a first frame, which has no statistics: of accumulated light, the least share is added. The bounds are 2.5 times
// the largest of the measured differences, .00029 to .00038 for wide lobes and .00011 to .00017 for narrow ones. Means
// of features are halves, which make most of these differences.
TEST_F(SpecularFilter, RegressionAgreesWithBruteForce) {
  const BlockRegressionSettings settings{.size = 2, .iterations = 2, .coarseSigma = 0.15F, .coarseSamples = 300.0F};
  struct Lobes {
    double middle, amplitude, bound;
  };
  for (const Lobes& lobes : {Lobes{0.58, 0.32, 9.5e-4}, Lobes{0.16, 0.04, 4e-4}}) {
    for (const auto& [name, scene] : {NamedScene{"bumpy wall", bumpyWall(0.1)}, NamedScene{"sphere", sphere()},
                                      NamedScene{"grazing floor", grazingFloor()}}) {
      SCOPED_TRACE(name + std::string(", roughness ") + std::to_string(lobes.middle));
      const HostFrame frame = renderStill(scene, kSize);
      const Image<Guide> guides = reflectingGuides(frame);
      Image<Reflector> reflectors(kSize);
      Image<glm::dvec4> accumulated = withAlpha(frame.lighting);
      reference::forEachPixel(kSize, [&](glm::ivec2 p) {
        reflectors[p].roughness = std::round(255.0 * (lobes.middle + lobes.amplitude * std::sin(0.2 * p.x))) / 255.0;
        reflectors[p].inverseDistance = reference::roundToHalf(p.y < 20 ? 0.3 + 0.01 * p.x : 0.0);
        accumulated[p].a = 1.0 + p.x % 3;
      });
      const auto add = [&](fg::Graph& graph, fg::Buffer constants, const Guides& inputs, const auto& textures) {
        const BlockLight light{
            .accumulated = textures[0], .alpha = LightingAlpha::SampleCount, .lighting = textures[0]};
        return addBlockFilter(graph, constants, light, inputs, settings);
      };
      FilterRun run(device(), kSize, 1, add, true, reflectors);
      const Image<glm::dvec4> actual = run.run(frame, guides, {accumulated});
      const auto expected = reference::blockRegression(frame, guides, accumulated, settings, false, &reflectors);
      const double rms = surfaceRmse(guides, actual, expected);
      EXPECT_LE(rms, lobes.bound);
      RecordProperty(name + std::to_string(lobes.middle), std::to_string(rms));
    }
  }
}

/// Frames of a still wall whose roughness is the same everywhere.
HostFrame specularFrame(double roughness, double distance, std::uint32_t index) {
  return asSpecular(renderStill(wallFacing({0.0, 0.0, 1.0}), kSize, index), distance, roughness);
}

// A mirror shows an image, which no fit knows: the light stays as it is. In a first frame it is that of the frame.
TEST_F(SpecularFilter, MirrorsKeepTheirLight) {
  const auto method = makeDenoiser("walr");
  method->set("accumulation.storage", "half");
  method->set("antialiasing.enabled", "off");
  DenoiserRun run(device(), *method, kSize, {.specular = true});
  const auto error = [&](double roughness) {
    run.reset();
    const HostFrame frame = specularFrame(roughness, 1.0, 0);
    return surfaceError(run.frame(frame), frame);
  };
  // The residual is a difference of halves in single precision; light is below 16.
  EXPECT_LE(error(0.0), 16.0 * reference::kHalfRoundoff);
  EXPECT_GT(error(1.0), 0.1);
}

class SpecularDistance : public SpecularFilter {
 protected:
  /// A view of the regression at the centre of the picture, in the last of these frames.
  [[nodiscard]] double viewAtCentre(const std::string& view, std::size_t component, std::span<const HostFrame> frames) {
    const auto method = makeDenoiser("walr");
    method->set("blocks.iterations", "1");
    fg::Graph graph;
    const DenoiserInputs inputs = importInputs(graph, kSize, {.specular = true});
    const fg::Texture output = importOutput(graph, kSize);
    Inspection inspection;
    inspection.want(view, graph.import("view", {kViewFormat, graph.textureDesc(output).extent}, fg::vk::kOverwritable));
    graph.exported(method->add({graph, inspection}, inputs, output), fg::vk::kReadable);
    graph.exported(inspection.views().front().texture, fg::vk::kReadable);
    fg::test::GraphRun run(device(), graph, fg::vk::ExecutorOptions{.shared = device().pipelines()});
    for (const HostFrame& frame : frames) {
      upload(run, inputs, frame);
      run.frame();
    }
    const std::vector<float> texels = run.texels<float>(inspection.views().front().texture);
    return texels[4 * static_cast<std::size_t>(kSize.y / 2 * kSize.x + kSize.x / 2) + component];
  }
};

// The mean distance is that of inverse distances: of 1 and 1/3 at a depth d, d / 2 + d / 6. A pixel without a sample
// keeps the mean.
TEST_F(SpecularDistance, IsAMeanOverTime) {
  const std::array frames{specularFrame(1.0, 1.0, 0), specularFrame(1.0, 3.0, 0), specularFrame(1.0, 0.0, 0)};
  const double depth = frames.back().depth[kSize / 2];
  const double inverse = (depth + depth / 3.0) / 2.0;
  // The window reaches some 6 pixels from the centre of the picture, where view rays are 1.6 % longer; the feature then
  // differs by .003.
  EXPECT_NEAR(viewAtCentre("feature-mean-2", 0, frames), 1.0 / (1.0 + 1.0 / inverse) - 1.0, 0.01);
}

// Where distances alternate like the squares of a checker, each pixel of a rough surface knows of both. Up to a
// roughness of .1, the own sample stands, and a block holds pixels like that which represents it.
TEST_F(SpecularDistance, OfRoughSurfacesIsAMeanOverPixels) {
  double depth = 0.0;
  const auto featureAt = [&](double roughness) {
    HostFrame frame = specularFrame(roughness, 1.0, 0);
    reference::forEachPixel(kSize, [&](glm::ivec2 p) { frame.lightAlpha[p] = (p.x + p.y) % 2 == 0 ? 1.0 : 3.0; });
    depth = frame.depth[kSize / 2];
    return viewAtCentre("feature-mean-2", 0, std::span(&frame, 1));
  };
  const auto featureOf = [&](double inverse) { return 1.0 / (1.0 + 1.0 / (depth * inverse)) - 1.0; };
  const double rough = featureAt(0.2);
  // Of nine pixels four or five show the nearer thing; .01 is as above.
  EXPECT_GT(rough, featureOf((4.0 + 5.0 / 3.0) / 9.0) - 0.01);
  EXPECT_LT(rough, featureOf((5.0 + 4.0 / 3.0) / 9.0) + 0.01);
  // Pixels of the other distance count by exp(-.5 (ln 3 / .4)^2) = .023.
  const double sharp = featureAt(0.05);
  EXPECT_LT(std::min(std::abs(sharp - featureOf(1.0)), std::abs(sharp - featureOf(1.0 / 3.0))), 0.02);
}

TEST(SpecularFilterPlan, DiffuseLightHasNoShaderOfSpecularLight) {
  for (const bool specular : {false, true}) {
    const auto method = makeDenoiser("walr");
    fg::Graph graph;
    const DenoiserInputs inputs = importInputs(graph, kSize, {.specular = specular});
    (void)method->add(graph, inputs, importOutput(graph, kSize));
    std::vector<std::string> found;
    for (const fg::PassDecl& pass : graph.desc().passes) {
      const auto* work = std::get_if<fg::ComputeDispatch>(&pass.work);
      const std::string name = work != nullptr ? std::string(work->shader->name) : "";
      if (name.find("specular") != std::string::npos || name.find("reflection") != std::string::npos)
        found.push_back(name);
    }
    EXPECT_EQ(!found.empty(), specular) << (found.empty() ? "" : found.front());
  }
}

TEST(SpecularFilterPlan, WhatItCannotDoIsRefusedByName) {
  const auto refused = [](const char* setting, const char* value, std::string_view why) {
    const auto method = makeDenoiser("walr");
    method->set(setting, value);
    fg::test::expectError<std::invalid_argument>([&] { (void)method->views({.specular = true}); }, {why});
  };
  refused("blocks.residual", "off", "blocks.residual");
  refused("spatial-only", "on", "spatial-only");
}

}  // namespace
}  // namespace walr::test::specular_filter_test
