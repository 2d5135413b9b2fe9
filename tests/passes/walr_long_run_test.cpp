// Ten thousand frames of a still, noisy scene on a device: the mean does not drift.

#include <cmath>

#include "tests/passes/synthetic_scene.h"
#include "tests/passes/walr_run.h"
#include "tests/vulkan/gpu_fixture.h"
#include "tests/vulkan/plain_device.h"

namespace walr::test::walr_long_run_test {
namespace {

using reference::HostFrame;

constexpr glm::ivec2 kSize(22, 18);
constexpr std::uint32_t kCycle = 61;  ///< Number of different noisy frames, shown in turn.
constexpr std::uint32_t kFrames = 164 * kCycle;
static_assert(kFrames > 10000);

class WalrLongRunTest : public fg::test::GpuTest {};

// A running mean is linear: over whole cycles its mean is the mean of the samples, up to the rounding of its stores. A
// store errs by up to half a unit in the last place, evenly over a width of 2 roundoffs, and the mean of n samples
// keeps an error for n frames. Over all stores of a cycle that leaves a mean error of standard deviation n (2 roundoffs
// / sqrt(12)) / sqrt(stores). A store that always rounds down would leave n roundoffs, 60 times more.
TEST_F(WalrLongRunTest, TheMeanDoesNotDriftAndMemoryDoesNotGrow) {
  std::vector<HostFrame> cycle;
  glm::dvec3 inputMean(0.0);
  for (std::uint32_t i = 0; i < kCycle; ++i) {
    cycle.push_back(renderStill(flatWall(), kSize, i));
    for (const glm::dvec3& l : cycle.back().lighting.pixels()) inputMean += l;
  }
  WalrPaperSettings settings = robustWalr();
  settings.regression.iterations = 1;
  WalrRun validated(device(), kSize, settings);
  for (const HostFrame& frame : cycle) (void)validated.frame(frame);
  const fg::test::PlainDevice plain;
  WalrRun run(plain.device(), kSize, settings);
  (void)run.frame(cycle.front());
  const std::uint64_t bytes = run.allocatedBytes();

  glm::dvec3 accumulatedMean(0.0);
  for (std::uint32_t i = 1; i <= kFrames; ++i) {
    HostFrame& frame = cycle[i % kCycle];
    frame.constants.frameIndex = i;
    const WalrStages stages = run.frame(frame);
    if (i + kCycle <= kFrames) continue;
    for (const glm::dvec4& v : stages.accumulated.pixels()) {
      accumulatedMean += glm::dvec3(v);
      EXPECT_EQ(v.w, double(settings.accumulation.maxHistory));
    }
  }
  EXPECT_EQ(run.allocatedBytes(), bytes);
  const double stores = double(kCycle) * kSize.x * kSize.y;
  const double n = double(settings.accumulation.maxHistory);
  const double deviation = n * 2.0 * reference::kHalfRoundoff / std::sqrt(12.0 * stores);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(accumulatedMean[c] / inputMean[c], 1.0, 5.0 * deviation) << "channel " << c;
}

}  // namespace
}  // namespace walr::test::walr_long_run_test
