// Fireflies (passes/WALR.md, 3): single samples that outshine all others leave no trace, and light that is merely rare,
// small or sudden stays.
#include <cmath>
#include <functional>
#include <memory>
#include <random>
#include <string>

#include "tests/passes/counted_run.h"
#include "tests/passes/denoiser_run.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::fireflies_test {
namespace {

using reference::HostFrame;
using reference::Image;

constexpr glm::ivec2 kSize(96, 72);
constexpr double kPixels = double(kSize.x) * kSize.y;

std::unique_ptr<Denoiser> methodWith(const char* name, const char* fireflies) {
  std::unique_ptr<Denoiser> method = makeDenoiser(name);
  method->set("accumulation.antilag", "on");
  method->set("accumulation.fireflies", fireflies);
  return method;
}

glm::dvec3 sumOf(const Image<glm::dvec4>& image) {
  glm::dvec3 sum(0.0);
  for (const glm::dvec4& pixel : image.pixels()) sum += glm::dvec3(pixel);
  return sum;
}

/// Sums of the last image of `frames` frames, each changed by `change(frame, index)` first.
glm::dvec3 lastSum(const fg::test::TestDevice& device, const char* name, const char* fireflies, std::uint32_t frames,
                   const std::function<void(HostFrame&, std::uint32_t)>& change) {
  const auto method = methodWith(name, fireflies);
  DenoiserRun run(device, *method, kSize);
  Image<glm::dvec4> output;
  for (std::uint32_t i = 0; i < frames; ++i) {
    HostFrame frame = renderStill(flatWall(), kSize, i);
    change(frame, i);
    output = run.frame(frame);
  }
  return sumOf(output);
}

class Fireflies : public fg::test::GpuTest {};

// The wall's light is at most 0.9 * 0.8 * 1.3 + 0.05 = 1 in red, its brightest channel. Exponential noise has a root
// mean square of sqrt(2) times its mean, so that a sample brings at most T = sqrt(8 * 49 * 64 / 14) * sqrt(2) = 60, and
// this noise may double the square's mean over a window for a frame. An eighth of it counts in a mean over eight
// frames.
constexpr double kMostSample = 1.41 * 60.0;

TEST_F(Fireflies, LeaveNoTrace) {
  constexpr double kMost = kMostSample / 8.0;
  struct Case {
    glm::dvec3 light;
    std::uint32_t first, last;
  };
  for (const char* name : {"walr", "accumulate"}) {
    const glm::dvec3 clean = lastSum(device(), name, "14", 12, [](HostFrame&, std::uint32_t) {});
    for (const Case& c : {Case{glm::dvec3(30000.0), 11, 11}, Case{glm::dvec3(500.0), 11, 11},
                          Case{glm::dvec3(0.0, 0.0, 30000.0), 10, 10}}) {
      const auto put = [&](HostFrame& frame, std::uint32_t i) {
        if (i >= c.first && i <= c.last) frame.lighting[{50, 30}] = c.light;
      };
      SCOPED_TRACE(std::string(name) + ", blue " + std::to_string(c.light.b));
      const glm::dvec3 held = lastSum(device(), name, "14", 12, put) - clean;
      const glm::dvec3 whole = lastSum(device(), name, "0", 12, put) - clean;
      EXPECT_LT(std::abs(held.b), kMost);
      EXPECT_GT(whole.b, 2.0 * kMost);
    }
  }
}

// Mean light over frames 8 to 31, if one sample in 500 holds all of it. The sums of the two runs have the same samples.
// Windows at the border hold less, so that the picture must not be small.
TEST_F(Fireflies, LightOfOnePathInFiveHundredStays) {
  constexpr glm::ivec2 kLarge(192, 144);
  double sums[2] = {};
  for (const bool held : {false, true}) {
    const auto method = methodWith("accumulate", held ? "14" : "0");
    DenoiserRun run(device(), *method, kLarge);
    std::mt19937 random(5);
    for (std::uint32_t i = 0; i < 32; ++i) {
      HostFrame frame = renderStill(flatWall(), kLarge, i);
      for (glm::dvec3& light : frame.lighting.pixels()) light = glm::dvec3(random() % 500 == 0 ? 250.0 : 0.0);
      const double sum = sumOf(run.frame(frame)).g;
      if (i >= 8) sums[held ? 1 : 0] += sum;
    }
  }
  EXPECT_GT(sums[1], 0.95 * sums[0]);
}

// A lamp of 4,000 times the light before shows at once: its samples pass as if there were no bound, and so do they
// after a black picture.
TEST_F(Fireflies, ALampIsFollowedAtOnce) {
  for (const double before : {0.0, 1.0 / 4096.0}) {
    const auto lamp = [&](HostFrame& frame, std::uint32_t i) {
      if (i >= 6) return;
      for (glm::dvec3& light : frame.lighting.pixels()) light *= before;
    };
    const double held = lastSum(device(), "walr", "14", 7, lamp).g;
    EXPECT_EQ(held, lastSum(device(), "walr", "0", 7, lamp).g) << before;
    EXPECT_GT(held, 0.25 * kPixels * 0.5) << before;
  }
}

// The unit of what is lost is T: at most kMostSample, and at least 20, which is T of light of 0.3.
TEST_F(Fireflies, AreCounted) {
  const auto method = methodWith("walr", "14");
  CountedRun run(device(), *method, kSize);
  for (std::uint32_t i = 0; i < 4; ++i) {
    HostFrame frame = renderStill(flatWall(), kSize, i);
    if (i == 3) frame.lighting[{50, 30}] = glm::dvec3(30000.0);
    const CountedRun::Counts counts = run.count(frame);
    EXPECT_EQ(counts.at("held-back-samples"), i == 3 ? 1U : 0U) << i;
    EXPECT_GE(counts.at("held-back-light"), i == 3 ? std::uint64_t(30000.0 / kMostSample) - 1 : 0U) << i;
    EXPECT_LE(counts.at("held-back-light"), i == 3 ? 30000U / 20U : 0U) << i;
  }
}

}  // namespace
}  // namespace walr::test::fireflies_test
