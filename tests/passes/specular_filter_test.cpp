// The method `walr` on specular light: its filter against the double-precision reference, and what its parts promise.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "passes/filters/lobe_filter.h"
#include "passes/methods/denoiser.h"
#include "tests/error_text.h"
#include "tests/passes/comparison.h"
#include "tests/passes/denoiser_run.h"
#include "tests/passes/filter_run.h"
#include "tests/passes/reference/lobe_filter.h"
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

// Between its three iterations, light has 9 bits, which are rounded at random: that errs by up to a step of 2^-8, by
// half of one in the root of the mean square, and means over nine taps by a third of that. Two such errors add up to
// 2^.5 / 6 steps, or .94 x 2^-10, of light that is tone-mapped to at most 1. Weights amplify them where luminances
// differ by less than their deviation: the bound is twice as large.
TEST_F(SpecularFilter, AgreesWithDoublePrecision) {
  struct Lobes {
    double middle, amplitude;
  };
  for (const Lobes& lobes : {Lobes{0.58, 0.32}, Lobes{0.16, 0.04}, Lobes{0.07, 0.06}}) {
    for (const auto& [name, scene] : {NamedScene{"bumpy wall", bumpyWall(0.1)}, NamedScene{"sphere", sphere()},
                                      NamedScene{"grazing floor", grazingFloor()}}) {
      SCOPED_TRACE(name + std::string(", roughness ") + std::to_string(lobes.middle));
      const HostFrame frame = renderStill(scene, kSize);
      const Image<Guide> guides = reference::prepareGuides(frame, reference::Storage::Quantised);
      Image<Reflector> reflectors(kSize);
      Image<glm::dvec4> accumulated = withAlpha(frame.lighting), lighting = accumulated;
      reference::forEachPixel(kSize, [&](glm::ivec2 p) {
        reflectors[p].roughness = std::round(255.0 * (lobes.middle + lobes.amplitude * std::sin(0.2 * p.x))) / 255.0;
        reflectors[p].inverseDistance = reference::roundToHalf(p.y < 20 ? 0.3 + 0.01 * p.x : 0.0);
        accumulated[p].a = p.x % 5 == 4 ? 9.0 : p.x % 5;  // Also longer than in motion.
        lighting[p] *= 1.0 + 0.5 * std::sin(1.7 * p.x + 2.3 * p.y);
        lighting[p].a = p.y % 5;
        for (int c = 0; c < 3; ++c) lighting[p][c] = reference::roundToHalf(lighting[p][c]);
      });
      const auto add = [&](fg::Graph& graph, fg::Buffer constants, const Guides& inputs, const auto& textures) {
        const fg::TextureDesc result{VK_FORMAT_R16G16B16A16_SFLOAT, graph.textureDesc(inputs.depth).extent};
        return addLobeFilter(graph,
                             {.frame = constants,
                              .depth = inputs.depth,
                              .reflectors = inputs.features,
                              .accumulated = textures[0],
                              .lighting = textures[1],
                              .antilag = {},
                              .maxHistory = 3.0F},
                             graph.texture("filtered", result));
      };
      FilterRun run(device(), kSize, 2, add, false, reflectors);
      const Image<glm::dvec4> actual = run.run(frame, guides, {accumulated, lighting});
      const auto expected = reference::lobeFilter(frame, guides, reflectors, accumulated, lighting, 3.0);
      const double rms = surfaceRmse(guides, actual, expected);
      EXPECT_LE(rms, 2.0 * 0.94 * 0x1p-10);
      // The filter does something.
      EXPECT_GT(surfaceRmse(guides, accumulated, expected), 20.0 * reference::kHalfRoundoff);
    }
  }
}

// The first frame of a mirror whose left half reflects something near. Nothing is known of noise in a first frame, so
// that nothing but the distance tells the right half apart.
TEST_F(SpecularFilter, MirrorsDoNotMixWhatIsNearWithWhatIsFar) {
  const auto method = makeDenoiser("walr");
  method->set("accumulation.storage", "half");
  method->set("antialiasing.enabled", "off");
  DenoiserRun run(device(), *method, kSize, {.specular = true});
  const auto error = [&](double farDistance) {
    run.reset();
    HostFrame frame = asSpecular(renderStill(wallFacing({0.0, 0.0, 1.0}), kSize), 1.0, 0.0);
    reference::forEachPixel(kSize, [&](glm::ivec2 p) {
      const bool near = p.x < kSize.x / 2;
      frame.lighting[p] = glm::dvec3(near ? 4.0 : 8.0);
      frame.lightAlpha[p] = near ? 1.0 : farDistance;
    });
    return surfaceError(run.frame(frame), frame);
  };
  // Light up to 8 is rounded at random to a step of 16 / 512. The other half counts 2^-25 at most.
  EXPECT_LE(error(32.0), 16.0 / 512.0);
  EXPECT_GT(error(1.0), 2.0 * 16.0 / 512.0);
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
      if (name.find("lobe") != std::string::npos || name.find("reflection") != std::string::npos) found.push_back(name);
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
  refused("spatial-only", "on", "spatial-only");
}

}  // namespace
}  // namespace walr::test::specular_filter_test
