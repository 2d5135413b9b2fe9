#include "passes/methods/bmfr.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "tests/passes/comparison.h"
#include "tests/passes/filter_run.h"
#include "tests/passes/reference/bmfr.h"
#include "tests/passes/reference/octahedral.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::bmfr_test {
namespace {

using reference::Guide;
using reference::HostFrame;
using reference::Image;
using reference::Storage;

constexpr glm::ivec2 kSize(70, 45);  // Not multiples of the block size.

/// The fit alone, with guides as input.
class FitRun {
 public:
  FitRun(const fg::test::TestDevice& device, const BmfrFitSettings& settings)
      : run_(device, kSize, 1, [&](fg::Graph& graph, fg::Buffer frame, const Guides& guides, const auto& inputs) {
          const fg::Texture fit = graph.texture("fit", graph.textureDesc(inputs[0]));
          return addBmfrFit(graph, frame, inputs[0], LightingAlpha::Unused, guides, fit, settings);
        }) {}

  Image<glm::dvec4> fit(const HostFrame& frame, const Image<Guide>& guides) {
    return run_.run(frame, guides, {withAlpha(frame.lighting)});
  }

 private:
  FilterRun run_;
};

BmfrFitSettings deterministic(float tolerance) {
  return {.rankHandling = RankHandling::Deterministic, .rankTolerance = tolerance};
}

/// Slabs that face the camera, at the given depths.
Scene facingSlabs(std::vector<double> depths) {
  return [depths](glm::dvec3 origin, glm::dvec3 direction) -> std::optional<SceneHit> {
    for (std::size_t i = 0; i < depths.size(); ++i) {
      const double t = (-depths[i] - origin.z) / direction.z;
      const glm::dvec3 p = origin + t * direction;
      const bool here = i + 1 == depths.size() || std::sin(2.1 * p.x + double(i)) * std::cos(1.7 * p.y) > 0.3;
      if (t > 0.0 && here) return SceneHit{t, {0.0, 0.0, 1.0}};
    }
    return std::nullopt;
  };
}

/// Scenes whose blocks have linearly dependent features: the position on a plane, the normal where it is constant, or
/// both.
std::vector<NamedScene> rankDeficientScenes() {
  return {{"one plane", flatWall()},
          {"one plane, facing the camera", facingSlabs({5.0})},
          {"constant normal", facingSlabs({4.0, 5.0, 6.0})},
          {"sky beside a plane", skyBesideSurface()}};
}

class Bmfr : public fg::test::GpuTest {
 protected:
  void expectAgreement(FitRun& run, const HostFrame& frame, const BmfrFitSettings& settings, const std::string& what) {
    const Image<Guide> guides = reference::prepareGuides(frame, Storage::Quantised);
    const auto expected = reference::bmfrFit(frame, guides, frame.lighting, settings);
    const Image<glm::dvec4> actual = run.fit(frame, guides);
    Comparison comparison(what);
    reference::forEachPixel(kSize, [&](glm::ivec2 p) {
      if (comparison.skips(expected[p].undecided)) return;
      comparison.colour(p, actual[p], expected[p].colour, halfTolerance(expected[p].colour, expected[p].error));
    });
    comparison.expect(0.0);
  }
};

TEST_F(Bmfr, StochasticFitAgreesWithTheReference) {
  const BmfrFitSettings settings;
  FitRun run(device(), settings);
  for (const NamedScene& scene : allScenes()) {
    for (const std::uint32_t frameIndex : {0U, 9U})
      expectAgreement(run, renderStill(scene.scene, kSize, frameIndex), settings, scene.name);
  }
}

TEST_F(Bmfr, DeterministicFitAgreesWithTheReference) {
  const BmfrFitSettings settings = deterministic(0.01F);
  FitRun run(device(), settings);
  for (const NamedScene& scene : allScenes())
    expectAgreement(run, renderStill(scene.scene, kSize, 3), settings, scene.name);
}

/// The constant is the first feature and gets no noise, so both fits reproduce a single colour, whatever the rank.
TEST_F(Bmfr, ConstantLightIsUnchanged) {
  const glm::dvec3 light(0.25, 3.0, 1000.0);
  std::vector<NamedScene> scenes = rankDeficientScenes();
  scenes.push_back({"sphere", sphere()});
  for (const BmfrFitSettings& settings : {BmfrFitSettings{}, deterministic(0.01F)}) {
    FitRun run(device(), settings);
    for (const NamedScene& scene : scenes) {
      HostFrame frame = renderStill(scene.scene, kSize);
      frame.lighting = Image<glm::dvec3>(kSize, light);
      const Image<Guide> guides = reference::prepareGuides(frame, Storage::Quantised);
      const auto bound = reference::bmfrFit(frame, guides, frame.lighting, settings);
      const Image<glm::dvec4> actual = run.fit(frame, guides);
      reference::forEachPixel(kSize, [&](glm::ivec2 p) {
        for (int c = 0; c < 3; ++c) {
          ASSERT_NEAR(actual[p][c], light[c], halfTolerance(light[c], bound[p].error[c]))
              << scene.name << ": " << p.x << " " << p.y;
        }
      });
    }
  }
}

/// Without noise, the fit of a signal in the span of the features is the signal. Only the signal's rounding to halves
/// remains. Its effect on a pixel is at most the root of the pixel's leverage times the root of the squared errors of
/// all pixels of the block.
TEST_F(Bmfr, ASignalLinearInTheFeaturesIsReproduced) {
  const BmfrFitSettings settings = deterministic(1e-3F);
  FitRun run(device(), settings);
  HostFrame frame = renderStill(sphere(), kSize);
  const Image<Guide> guides = reference::prepareGuides(frame, Storage::Quantised);
  const glm::dmat3 worldFromView = glm::transpose(glm::dmat3(frame.constants.viewFromWorld));
  Image<glm::dvec3> signal(kSize);
  double largest = 0.0;
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    const glm::dvec3 n = worldFromView * reference::octahedralDecode(guides[p].features);
    const glm::dvec3 w =
        worldFromView *
        (reference::rayThrough(frame.constants.rayFromPixel, reference::pixelCentre(p)) * guides[p].depth);
    signal[p] = {4.0 + glm::dot(n, glm::dvec3(0.5, -1.0, 0.7)), 9.0 + glm::dot(w, glm::dvec3(0.3, -0.6, 0.2)),
                 1.0 + glm::dot(w * w, glm::dvec3(0.1, 0.4, 0.05)) - 0.3 * n.x};
    largest = std::max({largest, signal[p].x, signal[p].y, signal[p].z});
    frame.lighting[p] = {reference::roundToHalf(signal[p].x), reference::roundToHalf(signal[p].y),
                         reference::roundToHalf(signal[p].z)};
  });
  const double rounding = reference::kHalfRoundoff * largest * 32.0;  // The root of the sum of 32 x 32 squares.
  const auto bound = reference::bmfrFit(frame, guides, frame.lighting, settings);
  const Image<glm::dvec4> actual = run.fit(frame, guides);
  Comparison comparison("linear signal");
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    comparison.compared();
    const glm::dvec3 error = bound[p].error + std::sqrt(bound[p].leverage) * rounding;
    comparison.colour(p, actual[p], signal[p], halfTolerance(signal[p], error));
  });
  comparison.expect(0.0);
}

/// One plane with one normal leaves four independent features of ten. The noise that replaces the missing rank moves
/// the fit from frame to frame. The average over many frames must be nearer to the rank-aware fit than a single fit is
/// to the average.
TEST_F(Bmfr, StochasticFitScattersAboutTheRankAwareOne) {
  constexpr int kSeeds = 24;
  FitRun stochasticRun(device(), {});
  FitRun rankAwareRun(device(), deterministic(0.01F));
  for (const NamedScene& scene : rankDeficientScenes()) {
    for (const Noise noise : {Noise::Exponential, Noise::None}) {
      const std::string name = std::string(scene.name) + (noise == Noise::None ? ", smooth" : ", noisy");
      HostFrame frame = renderStill(scene.scene, kSize, 0, noise);
      const Image<Guide> guides = reference::prepareGuides(frame, Storage::Quantised);
      const Image<glm::dvec4> rankAware = rankAwareRun.fit(frame, guides);
      Image<glm::dvec4> sum(kSize);
      Image<glm::dvec4> squares(kSize);
      for (int seed = 0; seed < kSeeds; ++seed) {
        frame.constants.frameIndex = std::uint32_t(16 * seed);  // Always the same displacement of the blocks.
        const Image<glm::dvec4> fit = stochasticRun.fit(frame, guides);
        for (std::size_t i = 0; i < fit.pixels().size(); ++i) {
          sum.pixels()[i] += fit.pixels()[i];
          squares.pixels()[i] += fit.pixels()[i] * fit.pixels()[i];
        }
      }
      double scatter = 0.0;
      double offset = 0.0;
      reference::forEachPixel(kSize, [&](glm::ivec2 p) {
        for (int k = 0; k < 3; ++k) {
          const double mean = sum[p][k] / kSeeds;
          ASSERT_TRUE(std::isfinite(mean) && std::isfinite(rankAware[p][k])) << name;
          scatter += std::max(squares[p][k] / kSeeds - mean * mean, 0.0);
          offset += (mean - rankAware[p][k]) * (mean - rankAware[p][k]);
        }
      });
      EXPECT_LT(offset, scatter) << name;
    }
  }
}

/// The second accumulation reads its history where the first one accepted taps: given the same signal and the same
/// history lengths, both compute the same mean. They differ by the 14 bits of a stored fraction, twice a frame, and by
/// the rounding of both histories to halves.
TEST_F(Bmfr, TheSecondAccumulationReadsTheHistoryThatTheFirstAccepted) {
  constexpr int kFrames = 6;
  constexpr float kMaxSamples = 4.0F;
  fg::Graph graph;
  const DenoiserInputs inputs = importInputs(graph, kSize);
  const Guides guides = addPrepareGuides(graph, inputs);
  const auto [light, taps] = addTemporalAccumulationWithTaps(graph, inputs, guides, {.maxHistory = kMaxSamples});
  const fg::Texture second =
      addBmfrAccumulation(graph, inputs.frame, inputs.lighting, taps, {.maxHistory = kMaxSamples});
  const fg::Texture firstOut = copyOut(graph, "first", light.mean);
  const fg::Texture secondOut = copyOut(graph, "second", second);
  fg::test::GraphRun run(device(), graph, {.shared = device().pipelines()});

  double tolerance = 0.0;
  for (int i = 0; i < kFrames; ++i) {
    const glm::dvec3 position(0.07 * i, -0.03 * i, 0.05 * i);
    const glm::dvec3 previous(0.07 * (i - 1), -0.03 * (i - 1), 0.05 * (i - 1));
    const FrameDescription camera = cameraAt(position, previous, kSize, std::uint32_t(i));
    const HostFrame frame = renderFrame(thinBars(), camera, kSize);
    upload(run, inputs, frame);
    run.frame();
    const Image<glm::dvec4> expected = readHalves(run, firstOut, kSize);
    const Image<glm::dvec4> actual = readHalves(run, secondOut, kSize);
    double largest = 0.0;
    for (const glm::dvec4& texel : expected.pixels()) largest = std::max({largest, texel.x, texel.y, texel.z, texel.w});
    tolerance += largest * (2.0 * 0x1p-14 + 4.0 * reference::kHalfRoundoff);
    reference::forEachPixel(kSize, [&](glm::ivec2 p) {
      for (int c = 0; c < 4; ++c)
        ASSERT_NEAR(actual[p][c], expected[p][c], tolerance) << i << ": " << p.x << " " << p.y;
    });
  }
}

}  // namespace
}  // namespace walr::test::bmfr_test
