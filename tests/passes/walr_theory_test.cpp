// Promises of regression and averaging, on a device and in every storage; reference_theory_test.cpp tests the same for
// the double-precision reference.

#include <algorithm>
#include <cmath>
#include <string>

#include <glm/geometric.hpp>

#include "tests/passes/frame_symmetry.h"
#include "tests/passes/reference/guides.h"
#include "tests/passes/reference/storage.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/passes/walr_run.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::walr_theory_test {
namespace {

using reference::HostFrame;
using reference::Image;
using reference::Moments;

/// A storage, and the largest relative error of a stored value; a driver may truncate halves.
struct Storage {
  const char* name;
  MomentStorage storage;
  double roundoff;
};
constexpr Storage kStorages[] = {{"centred16", MomentStorage::Centred16, 2.0 * reference::kHalfRoundoff},
                                 {"raw16", MomentStorage::Raw16, 2.0 * reference::kHalfRoundoff},
                                 {"raw11", MomentStorage::Raw11, reference::kFloat10Roundoff},
                                 {"raw32", MomentStorage::Raw32, reference::kFloatRoundoff}};

WalrPaperSettings settingsOf(const Storage& storage) {
  WalrPaperSettings settings = robustWalr();
  settings.regression.storage = storage.storage;
  settings.regression.keepSampleCount = storage.storage == MomentStorage::Centred16;
  return settings;
}

/// A wall parallel to the image: every weight is 1 up to the rounding of a product of unit vectors.
HostFrame parallelWall(glm::ivec2 size) {
  HostFrame frame = renderStill(flatWall(), size, 0, Noise::None);
  reference::forEachPixel(size, [&](glm::ivec2 p) {
    frame.depth[p] = 4.0;
    frame.normal[p] = {0.0, 0.0, 1.0};
    frame.lighting[p] = glm::dvec3(0.0);
  });
  return frame;
}

class WalrTheoryTest : public fg::test::GpuTest {};

// One bright pixel: each of the 81x81 pixels around it gets one part in 81 * 81, and no other gets anything. If an
// iteration counted a sample twice, or not at all, a pixel would get twice as much, or nothing.
TEST_F(WalrTheoryTest, FourIterationsCountEachSampleOfTheWindowOnce) {
  constexpr glm::ivec2 kSize(163, 163);
  constexpr glm::ivec2 kCentre(81, 81);
  constexpr int kStores = 4;  // Three between iterations, and the result.
  const glm::dvec3 impulse(8192.0, 16384.0, 0.0);
  HostFrame frame = parallelWall(kSize);
  frame.lighting[kCentre] = impulse;
  for (const Storage& storage : kStorages) {
    SCOPED_TRACE(storage.name);
    WalrPaperSettings settings = settingsOf(storage);
    settings.spatialOnly = true;
    settings.regression.replaceTaps = TapReplacement::Off;
    WalrRun run(device(), kSize, settings, {}, false, {}, {"samples"});
    const WalrStages stages = run.frame(frame);
    const double tolerance = kStores * std::max(storage.roundoff, 2.0 * reference::kHalfRoundoff);
    double sum = 0.0;
    int wrong = 0;
    reference::forEachPixel(kSize, [&](glm::ivec2 p) {
      const glm::ivec2 d = glm::abs(p - kCentre);
      const bool inside = d.x <= 40 && d.y <= 40;
      const glm::dvec3 expected = inside ? impulse / (81.0 * 81.0) : glm::dvec3(0.0);
      const glm::dvec3 actual(stages.output[p]);
      for (int c = 0; c < 3; ++c) wrong += std::abs(actual[c] - expected[c]) <= tolerance * expected[c] ? 0 : 1;
      sum += actual.r;
      if (inside && storage.storage == MomentStorage::Centred16) {
        EXPECT_NEAR(stages.views.at("samples")[p].x, 81.0 * 81.0, 81.0 * 81.0 * 3.0 * storage.roundoff);
      }
    });
    EXPECT_EQ(wrong, 0);
    EXPECT_NEAR(sum, impulse.r, tolerance * impulse.r);  // The mean of the image is preserved.
  }
}

/// With the covariance M of a window, the ridge r changes the slope s of a linear signal to (M + r)^-1 M s. The mean
/// error over the window is then at most sqrt(r) |s| / 2. Each store rounds the mean and, through the covariances, the
/// slope. The raw packings lose the variance in the squares and promise nothing.
TEST_F(WalrTheoryTest, ASignalLinearInTheFeaturesIsReproduced) {
  constexpr glm::ivec2 kSize(48, 36);
  constexpr double kRidge = 1e-6;
  constexpr int kStores = 4;  // The input, two between iterations, and the result.
  HostFrame frame = renderStill(bumpyWall(0.3), kSize);
  const Image<reference::Guide> guides = reference::prepareGuides(frame, reference::Storage::Quantised);
  const glm::dvec2 slope(1.0, -0.5);
  double largest = 0.0;
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    frame.lighting[p] = glm::dvec3(2.0 + glm::dot(slope, guides[p].features));
    largest = std::max(largest, frame.lighting[p].x);
  });
  for (const Storage& storage : kStorages) {
    if (storage.storage != MomentStorage::Centred16 && storage.storage != MomentStorage::Raw32) continue;
    SCOPED_TRACE(storage.name);
    WalrPaperSettings settings = settingsOf(storage);
    settings.spatialOnly = true;
    settings.regression.iterations = 3;
    settings.regression.regularisation.ridge = static_cast<float>(kRidge);
    settings.regression.regularisation.noiseRidge = 0.0F;
    WalrRun run(device(), kSize, settings, {}, false);
    const Image<glm::dvec4> output = run.frame(frame).output;
    double squares = 0.0;
    reference::forEachPixel(kSize, [&](glm::ivec2 p) { squares += std::pow(output[p].x - frame.lighting[p].x, 2.0); });
    const double roundoff = std::max(storage.roundoff, 2.0 * reference::kHalfRoundoff);
    const double rms = std::sqrt(squares / double(output.pixels().size()));
    RecordProperty(storage.name, std::to_string(rms));
    EXPECT_LE(rms, 0.5 * std::sqrt(kRidge) * glm::length(slope) + kStores * roundoff * (largest + glm::length(slope)));
  }
}

// Both images are within the project's budget of double precision (walr_stages_test.cpp), so they differ by at most
// twice that. Tap replacement is off because its random numbers do not follow the symmetry.
TEST_F(WalrTheoryTest, OutputFollowsFlipsAndTransposition) {
  constexpr double kBudget = 2e-4 + 0.25 * 2.0 * reference::kHalfRoundoff;
  constexpr glm::ivec2 kSize(66, 46);
  WalrPaperSettings settings = robustWalr();
  settings.regression.replaceTaps = TapReplacement::Off;
  for (const Symmetry& symmetry : {Symmetry{"flip x", true, false, false}, Symmetry{"flip y", false, true, false},
                                   Symmetry{"transpose", false, false, true}}) {
    const glm::ivec2 mirroredSize = symmetry.transpose ? glm::ivec2(kSize.y, kSize.x) : kSize;
    WalrRun straight(device(), kSize, settings, {}, false);
    WalrRun mirrored(device(), mirroredSize, settings, {}, false);
    for (const NamedScene& named : allScenes()) {
      // Rounding decides between a bar and the wall behind it.
      if (named.name == std::string("thin bars")) continue;
      SCOPED_TRACE(std::string(symmetry.name) + ", " + named.name);
      straight.resetHistory();
      mirrored.resetHistory();
      for (std::uint32_t i = 0; i < 3; ++i) {
        const HostFrame frame = renderStill(named.scene, kSize, i);
        const Image<glm::dvec4> expected = mapImage(symmetry, straight.frame(frame).output);
        const Image<glm::dvec4> actual = mirrored.frame(mapFrame(symmetry, frame)).output;
        double squares = 0.0;
        for (std::size_t k = 0; k < actual.pixels().size(); ++k) {
          const glm::dvec3 a(actual.pixels()[k]);
          const glm::dvec3 e(expected.pixels()[k]);
          const glm::dvec3 d = a / (1.0 + a) - e / (1.0 + e);
          squares += d.x * d.x + d.y * d.y + d.z * d.z;
        }
        EXPECT_LE(std::sqrt(squares / (3.0 * double(actual.pixels().size()))), 2.0 * kBudget) << "frame " << i;
      }
    }
  }
}

// Powers of two change exponents only, as long as no covariance leaves the normal range of halves.
TEST_F(WalrTheoryTest, ScalingRadianceByAPowerOfTwoScalesTheOutputExactly) {
  constexpr glm::ivec2 kSize(48, 36);
  for (const WalrPaperSettings& settings : {robustWalr(), paperWalr()}) {
    SCOPED_TRACE(settings.regression.storage == MomentStorage::Centred16 ? "robust" : "paper");
    for (const double scale : {0x1p3, 0x1p5}) {
      WalrRun plain(device(), kSize, settings, {}, false);
      WalrRun scaled(device(), kSize, settings, {}, false);
      for (std::uint32_t i = 0; i < 3; ++i) {
        HostFrame frame = renderStill(sphere(), kSize, i);
        for (glm::dvec3& l : frame.lighting.pixels()) l *= 16.0;
        const Image<glm::dvec4> expected = plain.frame(frame).output;
        for (glm::dvec3& l : frame.lighting.pixels()) l *= scale;
        const Image<glm::dvec4> actual = scaled.frame(frame).output;
        reference::forEachPixel(kSize, [&](glm::ivec2 p) {
          EXPECT_EQ(glm::dvec3(actual[p]), scale * glm::dvec3(expected[p])) << p.x << ", " << p.y;
        });
      }
    }
  }
}

// Centred storage promises covariances that are positive semidefinite up to rounding. Raw storage holds averages of
// products instead; their difference from a product of averages may have any sign. In single precision that difference
// is no further below zero than the rounding of its terms, which are at most 1.
TEST_F(WalrTheoryTest, CovariancesStayPositiveSemidefinite) {
  constexpr glm::ivec2 kSize(66, 46);
  for (const Storage& storage : {kStorages[0], kStorages[3]}) {
    const bool centred = storage.storage == MomentStorage::Centred16;
    // Each of uu, vv and uv errs by a roundoff of itself, or of 1 where it is a difference, and by a subnormal step.
    const double relative = centred ? 4.0 * storage.roundoff : 0.0;
    const double absolute = centred ? reference::kSmallestHalf : 8.0 * reference::kFloatRoundoff;
    WalrRun run(device(), kSize, settingsOf(storage));
    for (const NamedScene& named : allScenes()) {
      SCOPED_TRACE(std::string(storage.name) + ", " + named.name);
      run.resetHistory();
      const WalrStages stages = run.frame(renderStill(named.scene, kSize));
      for (const reference::AtrousState& state : stages.iterations) {
        for (const Moments& m : state.moments.pixels()) {
          EXPECT_GE(m.xx.x, centred ? 0.0 : -absolute);
          EXPECT_GE(m.xx.z, centred ? 0.0 : -absolute);
          const double product = m.xx.x * m.xx.z;
          const double size = std::abs(m.xx.x) + std::abs(m.xx.z) + 2.0 * std::abs(m.xx.y);
          EXPECT_GE(product - m.xx.y * m.xx.y, -relative * product - 2.0 * absolute * size - 4.0 * absolute * absolute);
        }
      }
    }
  }
}

}  // namespace
}  // namespace walr::test::walr_theory_test
