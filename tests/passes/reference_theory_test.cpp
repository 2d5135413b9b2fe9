// Promises of linear regression, averaging and the edge-stopping function, tested on the double-precision reference
// itself, on which the tests of a device rely.

#include <array>
#include <cmath>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "passes/methods/walr_method.h"
#include "tests/passes/frame_symmetry.h"
#include "tests/passes/reference/full_window.h"
#include "tests/passes/reference/history.h"
#include "tests/passes/reference/octahedral.h"
#include "tests/passes/reference/walr.h"
#include "tests/passes/synthetic_scene.h"

namespace walr::test::reference_theory_test {
namespace {

using reference::AtrousState;
using reference::Guide;
using reference::HostFrame;
using reference::Image;
using reference::Moments;
using reference::Storage;

constexpr glm::ivec2 kSize(48, 36);

/// Bound of the rounding of some thousand double-precision operations on values of this size.
double roundingOf(double size) {
  return 1e-12 * size;
}

double largestDifference(const Image<glm::dvec3>& a, const Image<glm::dvec3>& b) {
  double largest = 0.0;
  reference::forEachPixel(a.size(), [&](glm::ivec2 p) {
    const glm::dvec3 d = glm::abs(a[p] - b[p]);
    largest = std::max({largest, d.x, d.y, d.z});
  });
  return largest;
}

/// A wall parallel to the image and its guides: every weight is exactly 1.
struct Parallel {
  HostFrame frame;
  Image<Guide> guides;
};
Parallel parallelWall(glm::ivec2 size) {
  Parallel p;
  p.frame.depth = Image<double>(size, 4.0);
  p.frame.constants = renderStill(flatWall(), size).constants;
  p.guides = Image<Guide>(size, Guide{4.0, {0.5, 0.5}, {0.0, 0.0, 1.0}});
  return p;
}

Image<glm::dvec4> withLength(const Image<glm::dvec3>& colours) {
  Image<glm::dvec4> result(colours.size());
  reference::forEachPixel(colours.size(), [&](glm::ivec2 p) { result[p] = glm::dvec4(colours[p], 1.0); });
  return result;
}

WeightedRegressionSettings withoutReplacement() {
  WeightedRegressionSettings settings;
  settings.replaceTaps = TapReplacement::Off;
  return settings;
}

// Every kernel of Keys 1981, equation 4, interpolates, is symmetric and keeps constants. Catmull-Rom alone keeps
// parabolas.
TEST(Theory, CubicWeightsInterpolate) {
  for (const double sharpness : {0.0, 0.5, 0.75, 1.0}) {
    EXPECT_EQ(reference::cubicWeights(0.0, sharpness), (std::array<double, 4>{0.0, 1.0, 0.0, 0.0}));
    for (const double f : {0.1, 0.25, 0.5, 0.8}) {
      const std::array<double, 4> w = reference::cubicWeights(f, sharpness);
      const std::array<double, 4> mirrored = reference::cubicWeights(1.0 - f, sharpness);
      for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(w[i], mirrored[3 - i], roundingOf(1.0));
      EXPECT_NEAR(w[0] + w[1] + w[2] + w[3], 1.0, roundingOf(1.0));
      const double parabola = w[0] + w[2] + 4.0 * w[3];  // x^2 at -1, 0, 1 and 2.
      const double missed = 2.0 * (1.0 - 2.0 * sharpness) * f * f * (1.0 - f);
      EXPECT_NEAR(parabola - f * f, missed, roundingOf(1.0)) << sharpness << ", " << f;
    }
  }
}

TEST(Theory, ConstantLightIsUnchanged) {
  const glm::dvec3 constant(0.75, 0.5, 1.25);
  for (const NamedScene& named : allScenes()) {
    SCOPED_TRACE(named.name);
    reference::Walr denoiser(Storage::Exact);
    for (std::uint32_t i = 0; i < 4; ++i) {
      const FrameDescription camera = cameraAt({0.05 * i, 0.0, 0.0}, {0.05 * (i - 1.0), 0.0, 0.0}, kSize, i);
      const HostFrame frame = renderFrame(
          named.scene, camera, kSize, [&](glm::dvec3, glm::dvec3) { return constant; }, Noise::None);
      const Image<glm::dvec3> out = denoiser.denoise(frame);
      EXPECT_LE(largestDifference(out, frame.lighting), roundingOf(1.0));
    }
  }
}

// With the pivots' floor far below the features' variance, which is above 1e-4 in every window of this scene, the fit
// of a linear signal is exact up to rounding over the smallest pivot.
TEST(Theory, SignalsLinearInTheFeaturesAreReproduced) {
  const HostFrame frame = renderStill(bumpyWall(0.3), kSize);
  const Image<Guide> guides = reference::prepareGuides(frame, Storage::Exact);
  Image<glm::dvec3> signal(kSize);
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    const glm::dvec2 x = guides[p].features;
    signal[p] = glm::dvec3(2.0, 1.5, 1.0) + x.x * glm::dvec3(1.0, -0.5, 0.0) + x.y * glm::dvec3(-1.0, 0.25, 2.0);
  });
  WeightedRegressionSettings settings;
  settings.regularisation.method = Regularisation::Floor;
  settings.regularisation.ridge = 1e-9F;
  const Image<glm::dvec3> out =
      reference::weightedRegression(frame, guides, withLength(signal), Storage::Exact, settings);
  EXPECT_LE(largestDifference(out, signal), roundingOf(4.0) / 1e-4);
}

// A ridge r reduces the slope b of a signal s + b . x by at most its share r / (r + e), where e is the covariance's
// smallest eigenvalue.
TEST(Theory, RidgeOnlyShrinksTheSlope) {
  Moments m;
  m.x = {0.4, 0.6};
  m.xx = {0.02, 0.005, 0.03};
  const glm::dvec2 slope(1.5, -0.5);
  m.y = glm::dvec3(2.0);
  m.yu = glm::dvec3(m.xx.x * slope.x + m.xx.y * slope.y);
  m.yv = glm::dvec3(m.xx.y * slope.x + m.xx.z * slope.y);
  m.luma2 = 4.5;
  m.samples = 100.0;
  const glm::dvec2 offset(0.1, -0.2);
  const double exact = 2.0 + glm::dot(slope, offset);
  const double smallest = 0.5 * (0.05 - std::sqrt(0.01 * 0.01 + 4.0 * 0.005 * 0.005));
  double last = 0.0;
  for (const float ridge : {1e-6F, 1e-4F, 1e-2F}) {
    const RegularisationSettings settings{.ridge = ridge, .noiseRidge = 0.0F};
    const double error = std::abs(reconstruct(m, m.x + offset, settings).colour.g - exact);
    EXPECT_LE(error, ridge / (ridge + smallest) * glm::length(slope) * glm::length(offset));
    EXPECT_GT(error, last);
    last = error;
  }
  // At the mean of the features the fit is the mean of the colour, for any ridge.
  EXPECT_NEAR(reconstruct(m, m.x, {}).colour.g, 2.0, roundingOf(2.0));
}

TEST(Theory, FourIterationsCountEachSampleOfTheWindowOnce) {
  constexpr glm::ivec2 kImpulseSize(163, 163);
  constexpr glm::ivec2 kCentre(81, 81);
  const Parallel wall = parallelWall(kImpulseSize);
  Image<glm::dvec3> impulse(kImpulseSize);
  impulse[kCentre] = glm::dvec3(1.0, 2.0, 0.0);
  const Image<glm::dvec3> out =
      reference::weightedRegression(wall.frame, wall.guides, withLength(impulse), Storage::Exact, withoutReplacement());
  double sum = 0.0;
  reference::forEachPixel(kImpulseSize, [&](glm::ivec2 p) {
    const glm::ivec2 d = glm::abs(p - kCentre);
    const double expected = d.x <= 40 && d.y <= 40 ? 1.0 / (81.0 * 81.0) : 0.0;
    EXPECT_NEAR(out[p].r, expected, roundingOf(expected)) << p.x << ", " << p.y;
    EXPECT_NEAR(out[p].g, 2.0 * expected, roundingOf(expected));
    sum += out[p].r;
  });
  EXPECT_NEAR(sum, 1.0, roundingOf(1.0));  // The mean of the image is preserved.
}

TEST(Theory, EachIterationIsTheBoxMeanWhereAllWeightsAreOne) {
  constexpr glm::ivec2 kWallSize(91, 87);
  Parallel wall = parallelWall(kWallSize);
  Image<glm::dvec3> colours = renderStill(flatWall(), kWallSize).lighting;
  // The features vary, but the plane does not.
  reference::forEachPixel(kWallSize, [&](glm::ivec2 p) {
    wall.guides[p].features = {0.5 + 0.2 * std::sin(0.9 * p.x), 0.5 + 0.3 * std::cos(0.7 * p.y + 0.2 * p.x)};
  });
  const Image<glm::dvec4> accumulated = withLength(colours);
  AtrousState state = reference::sampleMoments(wall.guides, accumulated);
  int window = 1;
  for (std::uint32_t t = 0; t < 4; ++t) {
    state = reference::atrousIteration(wall.frame, wall.guides, state, t, Storage::Exact, withoutReplacement());
    window *= 3;
    for (const glm::ivec2 centre : {glm::ivec2(40, 40), glm::ivec2(45, 43), glm::ivec2(50, 46)}) {
      const auto expected = toArray(reference::boxMoments(wall.guides, accumulated, centre, window));
      const auto got = toArray(state.moments[centre]);
      for (int k = 0; k < reference::kMomentCount; ++k)
        EXPECT_NEAR(got[k], expected[k], roundingOf(std::max(1.0, expected[k])))
            << reference::momentName(k) << ", window " << window;
    }
  }
}

// Without sample counts only the weights of the parts change. Away from the border all counts are equal, so nothing
// changes.
TEST(Theory, SampleCountsDoNotMatterWhereTheyAreEqual) {
  constexpr glm::ivec2 kWallSize(83, 83);
  const Parallel wall = parallelWall(kWallSize);
  const Image<glm::dvec4> accumulated = withLength(renderStill(flatWall(), kWallSize).lighting);
  WeightedRegressionSettings kept = withoutReplacement();
  kept.regularisation.noiseRidge = 0.0F;
  WeightedRegressionSettings dropped = kept;
  dropped.keepSampleCount = false;
  const glm::ivec2 centre(41, 41);
  const glm::dvec3 a = weightedRegression(wall.frame, wall.guides, accumulated, Storage::Exact, kept)[centre];
  const glm::dvec3 b = weightedRegression(wall.frame, wall.guides, accumulated, Storage::Exact, dropped)[centre];
  EXPECT_LE(glm::length(a - b), roundingOf(1.0));
}

TEST(Theory, FullWindowEqualsIterationsWhereNoEdgeIsInReach) {
  constexpr glm::ivec2 kWallSize(41, 39);
  const HostFrame frame = renderStill(bumpyWall(0.2), kWallSize);
  const Image<Guide> guides = reference::prepareGuides(frame, Storage::Exact);
  const Image<glm::dvec4> accumulated = withLength(frame.lighting);
  WeightedRegressionSettings settings = withoutReplacement();
  settings.iterations = 3;
  // Geometric normals come from depths in single precision, so the factor between two of them is 1 up to that rounding.
  settings.edgeStopping.normalFactor = false;
  const Image<glm::dvec3> atrous = reference::weightedRegression(frame, guides, accumulated, Storage::Exact, settings);
  const Image<reference::WindowPixel> full = reference::fullWindowRegression(
      frame, guides, accumulated, {.window = 27, .edgeStopping = settings.edgeStopping});
  for (int y = 13; y < kWallSize.y - 13; ++y)
    for (int x = 13; x < kWallSize.x - 13; ++x)
      EXPECT_LE(glm::length(atrous[{x, y}] - full[{x, y}].fitted.colour), roundingOf(10.0));
}

TEST(Theory, OutputFollowsFlipsAndTransposition) {
  WalrPaperSettings settings = robustWalr();
  settings.accumulation = WalrSettings{}.accumulation;  // With antilag.
  settings.antialiasing = WalrSettings{}.antialiasing;
  settings.regression.replaceTaps = TapReplacement::Off;  // Random replacement does not follow the symmetry.
  for (const Symmetry& symmetry : {Symmetry{"flip x", true, false, false}, Symmetry{"flip y", false, true, false},
                                   Symmetry{"transpose", false, false, true}}) {
    for (const NamedScene& named : allScenes()) {
      SCOPED_TRACE(std::string(symmetry.name) + ", " + named.name);
      reference::Walr straight(Storage::Exact, settings);
      reference::Walr mirrored(Storage::Exact, settings);
      for (std::uint32_t i = 0; i < 3; ++i) {
        const FrameDescription camera =
            cameraAt({0.06 * i, 0.02 * i, 0.0}, {0.06 * (i - 1.0), 0.02 * (i - 1.0), 0.0}, kSize, i);
        const HostFrame frame = renderFrame(named.scene, camera, kSize);
        const Image<glm::dvec3> expected = mapImage(symmetry, straight.denoise(frame));
        // Rays of the mirrored image are rounded anew, which tilts planes by a few float roundoffs.
        EXPECT_LE(largestDifference(mirrored.denoise(mapFrame(symmetry, frame)), expected), 1e-6);
      }
    }
  }
}

TEST(Theory, ScalingRadianceByAPowerOfTwoScalesTheOutputExactly) {
  for (const double scale : {0x1p-20, 0x1p+8}) {
    reference::Walr plain(Storage::Exact);
    reference::Walr scaled(Storage::Exact);
    for (std::uint32_t i = 0; i < 3; ++i) {
      HostFrame frame = renderStill(sphere(), kSize, i);
      const Image<glm::dvec3> expected = plain.denoise(frame);
      for (glm::dvec3& l : frame.lighting.pixels()) l *= scale;
      const Image<glm::dvec3> out = scaled.denoise(frame);
      reference::forEachPixel(kSize, [&](glm::ivec2 p) { EXPECT_EQ(out[p], scale * expected[p]); });
    }
  }
}

TEST(Theory, AStillViewIsTheMeanOfItsSamplesUpToTheCap) {
  constexpr std::uint32_t kFrames = 20;
  TemporalAccumulationSettings settings;
  settings.maxHistory = 8.0F;
  reference::AccumulationHistory history;
  Image<glm::dvec3> sum(kSize);
  for (std::uint32_t i = 0; i < kFrames; ++i) {
    const HostFrame frame = renderStill(flatWall(), kSize, i);
    const Image<Guide> guides = reference::prepareGuides(frame, Storage::Exact);
    history = {guides, meansAndLengths(accumulate(frame, guides, history, Storage::Exact, settings))};
    reference::forEachPixel(kSize, [&](glm::ivec2 p) {
      sum[p] = i < 8 ? sum[p] + frame.lighting[p] / 8.0 : sum[p] * (7.0 / 8.0) + frame.lighting[p] / 8.0;
      EXPECT_EQ(history.accumulated[p].w, std::min(i + 1.0, 8.0));
      if (i >= 7) {
        EXPECT_LE(glm::length(glm::dvec3(history.accumulated[p]) - sum[p]), roundingOf(20.0));
      }
    });
  }
}

TEST(Theory, DisocclusionsStartWithoutHistory) {
  const HostFrame before = renderFrame(thinBars(), cameraAt({}, {}, kSize, 0), kSize);
  const HostFrame after = renderFrame(thinBars(), cameraAt({0.4, 0.0, 0.0}, {}, kSize, 1), kSize);
  const Image<Guide> guidesBefore = reference::prepareGuides(before, Storage::Exact);
  const Image<Guide> guidesAfter = reference::prepareGuides(after, Storage::Exact);
  const auto first = accumulate(before, guidesBefore, {}, Storage::Exact);
  const auto second = accumulate(after, guidesAfter, {guidesBefore, meansAndLengths(first)}, Storage::Exact);
  int fresh = 0;
  int kept = 0;
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    if (second[p].samples > 1.0) {
      ++kept;
      return;
    }
    ++fresh;
    EXPECT_EQ(second[p].mean, after.lighting[p]);
    // No tap showed this surface; bar and wall are at least 2.3 apart.
    const glm::ivec2 base(glm::floor(glm::dvec2(p) + glm::dvec2(after.motion[p])));
    const double depthBefore = after.depth[p] + after.motion[p].z;
    int same = 0;
    for (int i = 0; i < 4; ++i) {
      const glm::ivec2 q = base + glm::ivec2(i % 2, i / 2);
      same += before.depth.contains(q) && std::abs(before.depth[q] - depthBefore) < 0.1 ? 1 : 0;
    }
    EXPECT_LT(same, 4);
  });
  EXPECT_GT(kept, fresh);
  EXPECT_GT(fresh, 20);
}

TEST(Theory, CovariancesStayPositiveSemidefinite) {
  for (const NamedScene& named : allScenes()) {
    SCOPED_TRACE(named.name);
    const HostFrame frame = renderStill(named.scene, kSize);
    for (const Storage storage : {Storage::Exact, Storage::Quantised}) {
      const Image<Guide> guides = reference::prepareGuides(frame, storage);
      AtrousState state = reference::sampleMoments(guides, withLength(frame.lighting));
      // Rounding to halves changes each factor of uu vv - uv^2 by half a unit in the last place.
      const double roundoff = storage == Storage::Exact ? 1e-12 : 4.0 * reference::kHalfRoundoff;
      const double smallest = storage == Storage::Exact ? 1e-30 : std::pow(2.0 * reference::kSmallestHalf, 2);
      for (std::uint32_t t = 0; t < 4; ++t) {
        state = reference::atrousIteration(frame, guides, state, t, storage, {});
        for (const Moments& m : state.moments.pixels()) {
          EXPECT_GE(m.xx.x, 0.0);
          EXPECT_GE(m.xx.z, 0.0);
          const double product = m.xx.x * m.xx.z;
          EXPECT_GE(product - m.xx.y * m.xx.y,
                    -roundoff * product - 2.0 * reference::kSmallestHalf * (m.xx.x + m.xx.z) - smallest);
        }
      }
    }
  }
}

}  // namespace
}  // namespace walr::test::reference_theory_test
