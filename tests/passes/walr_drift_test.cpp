// Ten thousand frames through the whole pipeline: the output does not drift.

#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "tests/passes/denoiser_run.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"
#include "tests/vulkan/plain_device.h"

namespace walr::test::walr_drift_test {
namespace {

using reference::HostFrame;

constexpr glm::ivec2 kSize(22, 18);
constexpr std::uint32_t kCycle = 61;  ///< Number of different noisy frames, shown in turn.
constexpr std::uint32_t kCycles = 166;
constexpr std::uint32_t kUnsettled = 2;  ///< Cycles until histories are full.
static_assert((kCycles - kUnsettled) * kCycle > 10000);

/// The mean of values, and its variance.
struct MeanOf {
  explicit MeanOf(std::span<const double> values) {
    const auto n = static_cast<double>(values.size());
    for (const double v : values) mean += v / n;
    for (const double v : values) variance += (v - mean) * (v - mean) / ((n - 1.0) * n);
  }
  double mean = 0.0;
  double variance = 0.0;
};

class WalrDriftTest : public fg::test::GpuTest {};

// The same frames are shown again and again; only the random choice of samples and taps differs each time. Histories
// are much shorter than a cycle, so the means of the cycles are nearly independent of each other. Without drift, both
// halves of the run have the same mean within four standard deviations of their difference. That deviation is so small
// that a drift of a thousandth would show.
TEST_F(WalrDriftTest, TheOutputDoesNotDriftAndMemoryDoesNotGrow) {
  std::vector<HostFrame> cycle;
  for (std::uint32_t i = 0; i < kCycle; ++i) cycle.push_back(renderStill(stairs(), kSize, i));
  const std::unique_ptr<Denoiser> method = makeDenoiser("walr");
  // Windows of several iterations, whose taps meet edges, as in a larger image.
  method->set("walr.fit-window", "off");
  method->set("blocks.iterations", "2");
  // History lengths that follow the innovations outlast a cycle: with them, the means of the cycles would depend on
  // each other, and wander by .04 %.
  method->set("blocks.innovation-gain", "0");
  DenoiserRun validated(device(), *method, kSize);
  for (const HostFrame& frame : cycle) (void)validated.frame(frame);
  const fg::test::PlainDevice plain;
  DenoiserRun run(plain.device(), *method, kSize);

  std::array<std::vector<double>, 3> means;
  std::uint64_t bytes = 0;
  for (std::uint32_t k = 0; k < kCycles; ++k) {
    glm::dvec3 mean(0.0);
    for (std::uint32_t i = 0; i < kCycle; ++i) {
      HostFrame& frame = cycle[i];
      frame.constants.frameIndex = k * kCycle + i;
      const reference::Image<glm::dvec4> output = run.frame(frame);
      for (const glm::dvec4& v : output.pixels()) mean += glm::dvec3(v);
    }
    ASSERT_TRUE(std::isfinite(mean.r + mean.g + mean.b)) << "cycle " << k;
    if (k == 0) bytes = run.allocatedBytes();
    if (k < kUnsettled) continue;
    for (int c = 0; c < 3; ++c) means[c].push_back(mean[c] / (double(kCycle) * kSize.x * kSize.y));
  }
  EXPECT_EQ(run.allocatedBytes(), bytes);
  for (int c = 0; c < 3; ++c) {
    const std::span<const double> all(means[c]);
    const MeanOf early(all.first(all.size() / 2));
    const MeanOf late(all.last(all.size() / 2));
    const double deviation = std::sqrt(early.variance + late.variance);
    RecordProperty("relative_drift_" + std::to_string(c), std::to_string((late.mean - early.mean) / early.mean));
    RecordProperty("relative_deviation_" + std::to_string(c), std::to_string(deviation / early.mean));
    EXPECT_NEAR(late.mean, early.mean, 4.0 * deviation) << "channel " << c;
    EXPECT_LT(4.0 * deviation, 1e-3 * early.mean) << "channel " << c;
  }
}

}  // namespace
}  // namespace walr::test::walr_drift_test
