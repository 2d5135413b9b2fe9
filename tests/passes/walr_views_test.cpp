// Views of WALR's spatial filter agree with the double-precision reference and do not change the output.

#include <cmath>

#include "tests/passes/comparison.h"
#include "tests/passes/stage_checks.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/passes/walr_run.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::walr_views_test {
namespace {

using reference::HostFrame;
using reference::Image;
using reference::kFloatRoundoff;

constexpr glm::ivec2 kSize(48, 36);
/// The first, a middle and the last iteration.
constexpr std::uint32_t kIterations = 3;

WalrPaperSettings withIterations(WalrPaperSettings settings) {
  settings.regression.iterations = kIterations;
  return settings;
}

/// The views of all iterations.
std::vector<std::string> allViews() {
  std::vector<std::string> names;
  for (const std::string view : {"edges", "samples", "pivots", "feature-mean", "feature-covariance", "colour-mean",
                                 "covariance-u", "covariance-v", "slope-u", "slope-v", "clamped", "few-samples"})
    for (std::uint32_t t = 0; t < kIterations; ++t) names.push_back(view + "." + std::to_string(t));
  return names;
}

/// Stairs, where some pixels have no finite sample.
HostFrame someFrame() {
  HostFrame frame = renderStill(stairs(), kSize);
  for (std::size_t i = 5; i < frame.lighting.pixels().size(); i += 23) frame.lighting.pixels()[i].r = NAN;
  return frame;
}

/// The views of one iteration at one pixel.
struct PixelViews {
  const WalrStages* stages;
  std::string iteration;
  glm::ivec2 p;
  glm::dvec3 operator[](const char* name) const { return stages->views.at(name + ("." + iteration))[p]; }
};

/// Compare the views of the averages with the reference.
void expectAverages(Comparison& comparison, const PixelViews& view, const reference::AtrousPixel& expected) {
  const glm::dvec3 edges = view["edges"];
  comparison.value(view.p, "nearest edge", edges.x, expected.nearestEdge, 0.0);
  comparison.value(view.p, "replaced", edges.y, expected.replaced, 0.0);
  comparison.value(view.p, "lost", edges.z, expected.lost, 0.0);
  const glm::dvec3 few = view["few-samples"];
  const double w = view["samples"].x;
  comparison.value(view.p, "few samples", few.x, w < 3.0 ? 1.0 : 0.0, 0.0);
  comparison.value(view.p, "no samples", few.y, w == 0.0 ? 1.0 : 0.0, 0.0);
  const glm::dvec3 mean = view["feature-mean"];
  const glm::dvec3 colour = view["colour-mean"];
  const glm::dvec3 xx = view["feature-covariance"];
  const glm::dvec3 yu = view["covariance-u"];
  const glm::dvec3 yv = view["covariance-v"];
  const reference::Moments actual{
      .x = glm::dvec2(mean), .y = colour, .xx = xx, .yu = yu, .yv = yv, .samples = view["samples"].x};
  const reference::MomentValues a = toArray(actual);
  const reference::MomentValues e = toArray(expected.merged.moments);
  for (int k = 0; k < reference::kMomentCount; ++k) {
    if (k == 14) continue;  // The second moment of luminance is part of the view of the relative variance.
    comparison.value(view.p, reference::momentName(k), a[k], e[k], expected.merged.error[k] + 0x1p-126);
  }
}

/// Compare the views of the solve with a solve of the averages that the views show.
void expectSolve(Comparison& comparison, const PixelViews& view, const RegularisationSettings& settings) {
  const glm::dvec3 xx = view["feature-covariance"];
  const glm::dvec3 samples = view["samples"];
  const glm::dvec3 pivots = view["pivots"];
  const bool ridged = settings.method == Regularisation::Ridge;
  const double noise = ridged && samples.x > 0.0 ? double(settings.noiseRidge) * samples.y / samples.x : 0.0;
  const double regularisation = double(settings.ridge) + noise;
  comparison.value(view.p, "regularisation", pivots.y, regularisation, 8.0 * kFloatRoundoff * regularisation);
  const double first = ridged ? std::max(xx.x, 0.0) + regularisation : std::max(xx.x, regularisation);
  const double second = xx.z - xx.y * xx.y / first;
  // A square root, a division and a square of it, each of some units in the last place.
  const double tolerance = 16.0 * kFloatRoundoff * (std::abs(xx.x) + std::abs(xx.z) + xx.y * xx.y / first);
  comparison.value(view.p, "pivot", pivots.x, std::min(xx.x, second), tolerance + 0x1p-126);
  comparison.value(view.p, "outweighed", pivots.z, pivots.x < pivots.y ? 1.0 : 0.0, 0.0);
}

/// Coefficients times features must be the filter's output.
void expectFit(Comparison& comparison, const PixelViews& view, const WalrStages& stages) {
  const glm::dvec2 offset = stages.guides[view.p].features - glm::dvec2(view["feature-mean"]);
  const glm::dvec3 mean = view["colour-mean"];
  const glm::dvec3 u = view["slope-u"] * offset.x;
  const glm::dvec3 v = view["slope-v"] * offset.y;
  const glm::dvec3 fitted = mean + u + v;
  for (int c = 0; c < 3; ++c) {
    const double size = std::abs(mean[c]) + std::abs(u[c]) + std::abs(v[c]);
    // Features and their means, of order 1, are rounded before they are subtracted.
    const glm::dvec3 slopes = glm::abs(view["slope-u"]) + glm::abs(view["slope-v"]);
    const double rounding = 4.0 * kFloatRoundoff * (size + slopes[c]);
    const double expected = std::clamp(fitted[c], 0.0, reference::kLargestHalf);
    comparison.value(view.p, "filtered", stages.filtered[view.p][c], expected, halfTolerance(expected, rounding));
    if (std::abs(fitted[c]) > rounding) {
      comparison.value(view.p, "clamped", view["clamped"][c], fitted[c] == expected ? 0.0 : 1.0, 0.0);
    }
  }
}

class WalrViewsTest : public fg::test::GpuTest {};

TEST_F(WalrViewsTest, AgreeWithTheReferenceInEveryIteration) {
  for (const WalrPaperSettings& preset : {robustWalr(), paperWalr()}) {
    const WalrPaperSettings settings = withIterations(preset);
    SCOPED_TRACE(settings.regression.storage == MomentStorage::Centred16 ? "robust" : "paper");
    const HostFrame frame = someFrame();
    WalrRun run(device(), kSize, settings, {}, true, {}, allViews());
    const WalrStages stages = run.frame(frame);
    for (std::uint32_t t = 0; t < kIterations; ++t) {
      const reference::AtrousState before =
          t == 0 ? reference::sampleMoments(stages.guides, stages.accumulated) : stages.iterations[t - 1];
      Comparison comparison("views of iteration " + std::to_string(t));
      reference::forEachPixel(kSize, [&](glm::ivec2 p) {
        const PixelViews view{&stages, std::to_string(t), p};
        if (stages.guides[p].depth == 0.0) {
          for (const auto& [name, image] : stages.views) EXPECT_EQ(image[p], glm::dvec3(0.0)) << name;
          return;
        }
        EXPECT_EQ(view["samples"].z, std::isfinite(frame.lighting[p].r) ? 0.0 : 1.0);
        const reference::AtrousPixel expected =
            reference::atrousPixel(frame, stages.guides, before, p, t, settings.regression);
        if (comparison.skips(expected.undecided)) return;
        expectAverages(comparison, view, expected);
        expectSolve(comparison, view, settings.regression.regularisation);
        if (t + 1 == kIterations) expectFit(comparison, view, stages);
      });
      comparison.expect(kUndecidedShare);
    }
  }
}

TEST_F(WalrViewsTest, DoNotChangeTheOutput) {
  const HostFrame frame = someFrame();
  for (const WalrPaperSettings& settings : {robustWalr(), paperWalr()}) {
    WalrRun plain(device(), kSize, settings, {}, false);
    WalrRun viewed(device(), kSize, settings, {}, false, {}, {"edges", "slope-u.1"});
    EXPECT_EQ(plain.frame(frame).outputBits, viewed.frame(frame).outputBits);
  }
}

}  // namespace
}  // namespace walr::test::walr_views_test
