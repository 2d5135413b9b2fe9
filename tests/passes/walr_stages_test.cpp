// Every stage of WALR on a device agrees with the double-precision reference.

#include <cmath>
#include <string_view>

#include "tests/passes/hard_cases.h"
#include "tests/passes/reference/walr.h"
#include "tests/passes/stage_checks.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::walr_stages_test {
namespace {

using reference::HostFrame;

/// The presets, and the preset paper with other storages, each with the epsilon that suits it.
struct NamedSettings {
  const char* name;
  WalrPaperSettings settings;
};
std::vector<NamedSettings> allSettings() {
  WalrPaperSettings raw11 = paperWalr();
  raw11.regression.storage = MomentStorage::Raw11;
  raw11.regression.regularisation.ridge = 1e-2F;
  WalrPaperSettings raw32 = paperWalr();
  raw32.regression.storage = MomentStorage::Raw32;
  raw32.regression.regularisation.ridge = 1e-5F;
  WalrPaperSettings centredWithFloor = robustWalr();
  centredWithFloor.regression.regularisation.method = Regularisation::Floor;
  centredWithFloor.regression.regularisation.ridge = 1e-4F;
  return {{"robust", robustWalr()},
          {"paper", paperWalr()},
          {"raw11", raw11},
          {"raw32", raw32},
          {"centred16 with floor", centredWithFloor}};
}

class WalrStagesTest : public fg::test::GpuTest {};

TEST_F(WalrStagesTest, AgreeWithTheReferenceOnEveryScene) {
  for (const WalrPaperSettings& settings : {robustWalr(), paperWalr()}) {
    SCOPED_TRACE(settings.regression.storage == MomentStorage::Centred16 ? "robust" : "paper");
    WalrRun run(device(), {98, 66}, settings);
    for (const NamedScene& named : allScenes()) {
      SCOPED_TRACE(named.name);
      expectSequence(run, movingFrames(named.scene, {98, 66}), settings);
    }
  }
}

TEST_F(WalrStagesTest, AgreeWithTheReferenceForEveryStorageOnHardCases) {
  const std::vector<HardCase> cases = hardCases();
  for (const NamedSettings& named : allSettings()) {
    SCOPED_TRACE(named.name);
    WalrRun run(device(), cases.front().frames.front().size(), named.settings);
    for (const HardCase& hard : cases) {
      SCOPED_TRACE(hard.name);
      expectSequence(run, hard.frames, named.settings);
    }
  }
}

TEST_F(WalrStagesTest, AgreeWithTheReferenceWithoutTracingReplacementOrSampleCounts) {
  WalrPaperSettings plain = robustWalr();
  plain.regression.traceEdges = false;
  plain.regression.replaceTaps = TapReplacement::Off;
  plain.regression.keepSampleCount = false;
  plain.regression.sdfFraction = 0.0F;
  plain.regression.iterations = 3;
  plain.antialiasing.clipRadius = 2;
  WalrPaperSettings short1 = robustWalr();
  short1.regression.iterations = 1;
  short1.accumulation.historyFilter = HistoryFilter::Bicubic;
  short1.regression.edgeStopping.planeNormal = PlaneNormal::Shading;
  for (const WalrPaperSettings& settings : {plain, short1}) {
    expectSequence(device(), movingFrames(thinBars(), {98, 66}), settings);
    expectSequence(device(), movingFrames(stairs(), {98, 66}), settings);
  }
}

TEST_F(WalrStagesTest, AgreeWithTheReferenceForEveryReplacementWithAndWithoutDistances) {
  for (const TapReplacement replacement : {TapReplacement::Off, TapReplacement::Uniform, TapReplacement::Near}) {
    for (const bool repeatCentre : {false, true}) {
      for (const float sdfFraction : {0.0F, 1.0F}) {
        SCOPED_TRACE("replacement " + std::to_string(int(replacement)) +
                     (repeatCentre ? ", repeating the centre" : "") + ", distances times " +
                     std::to_string(sdfFraction));
        WalrPaperSettings settings = robustWalr();
        settings.regression.iterations = 3;  // The first, middle and last have shaders of their own.
        settings.regression.replaceTaps = replacement;
        settings.regression.repeatCentre = repeatCentre;
        settings.regression.edgeLeak = repeatCentre ? 0.0F : 0.3F;
        settings.regression.sdfFraction = sdfFraction;
        expectSequence(device(), movingFrames(thinBars(), {66, 46}), settings);
      }
    }
  }
}

// Raw storage marks a pixel without a sample by its features, and the light of the sky that its texels hold looks like
// features.
TEST_F(WalrStagesTest, AgreeWithTheReferenceForEveryStorageBesideALitSky) {
  std::vector<HostFrame> frames = movingFrames(skyBesideSurface(), {66, 46});
  for (HostFrame& frame : frames)
    for (std::size_t i = 0; i < frame.depth.pixels().size(); ++i)
      if (frame.depth.pixels()[i] > 1e9) frame.lighting.pixels()[i] = glm::dvec3(3.0, 2.0, 5.0);
  for (NamedSettings named : allSettings()) {
    SCOPED_TRACE(named.name);
    named.settings.regression.iterations = 2;  // The first writes what the last reads.
    named.settings.regression.edgeLeak = 0.3F;
    expectSequence(device(), frames, named.settings);
  }
}

TEST_F(WalrStagesTest, AgreeWithTheReferenceForEveryNumberOfIterations) {
  for (const std::uint32_t iterations : {1U, 2U, 3U, 4U, 5U}) {
    SCOPED_TRACE(std::to_string(iterations) + " iterations");
    for (WalrPaperSettings settings : {robustWalr(), paperWalr()}) {
      settings.regression.iterations = iterations;
      expectSequence(device(), movingFrames(stairs(), {66, 46}), settings);
    }
  }
}

TEST_F(WalrStagesTest, AgreeWithTheReferenceAtOddSizes) {
  for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(3, 5), glm::ivec2(37, 1), glm::ivec2(35, 29)}) {
    SCOPED_TRACE(std::to_string(size.x) + " x " + std::to_string(size.y));
    expectSequence(device(), movingFrames(bumpyWall(0.1), size), robustWalr());
    // It differs in storage and filters, and meets the borders of other sizes as `robust` does.
    if (size.x == 35) expectSequence(device(), movingFrames(bumpyWall(0.1), size), paperWalr());
  }
}

TEST_F(WalrStagesTest, AgreeWithTheReferenceForWorldSpaceNormalsAndStaticScenes) {
  std::vector<HostFrame> frames = movingFrames(sphere(), {98, 66});
  for (HostFrame& frame : frames) {
    // The camera only moves, so world and view space differ by a rotation only where the test adds one.
    frame.conventions = {InputConventions::Space::World, InputConventions::MotionDepth::StaticScene};
    for (glm::dvec3& motion : frame.motion.pixels()) motion.z = 0.0;
  }
  expectSequence(device(), frames, robustWalr());
}

/// Root mean square difference after x / (1 + x), which is at most 1/4 of a relative difference.
double toneMappedRmse(const reference::Image<glm::dvec4>& actual, const reference::Image<glm::dvec3>& expected) {
  double sum = 0.0;
  reference::forEachPixel(expected.size(), [&](glm::ivec2 p) {
    const glm::dvec3 a(actual[p]);
    const glm::dvec3 d = a / (1.0 + a) - expected[p] / (1.0 + expected[p]);
    sum += d.x * d.x + d.y * d.y + d.z * d.z;
  });
  return std::sqrt(sum / (3.0 * double(expected.pixels().size())));
}

// The whole pipeline of the device and the reference, which rounds nothing, each run on their own from the first frame
// on. The bound is the project's budget for centred half-precision moments, 2e-4, plus the error of storing the
// filtered frame where the driver truncates: a unit in the last place, 2^-10 relative. The thin bars are left to the
// tests of the stages, which skip pixels where rounding decides between a bar and the wall behind it.
TEST_F(WalrStagesTest, WholePipelineStaysNearDoublePrecision) {
  constexpr double kBudget = 2e-4 + 0.25 * 2.0 * reference::kHalfRoundoff;
  WalrPaperSettings responsive = robustWalr();
  responsive.accumulation.antilag.enabled = true;
  for (const WalrPaperSettings& settings : {robustWalr(), responsive}) {
    WalrRun run(device(), {66, 46}, settings);
    for (const NamedScene& named : allScenes()) {
      if (named.name == std::string_view("thin bars")) continue;
      SCOPED_TRACE(std::string(named.name) + (settings.accumulation.antilag.enabled ? ", responsive" : ""));
      run.resetHistory();
      reference::Walr exact(reference::Storage::Exact, settings);
      for (std::uint32_t i = 0; i < 4; ++i) {
        HostFrame frame = renderStill(named.scene, {66, 46}, i);
        if (i > 0)  // The light falls after the first frame; its halves stay exact.
          for (glm::dvec3& l : frame.lighting.pixels()) l *= 0.25;
        const WalrStages stages = run.frame(frame);
        const reference::Image<glm::dvec3> expected = exact.denoise(frame);
        EXPECT_LE(toneMappedRmse(stages.filtered, exact.filtered()), kBudget) << "filtered frame " << i;
        EXPECT_LE(toneMappedRmse(stages.output, expected), kBudget) << "frame " << i;
      }
    }
  }
}

}  // namespace
}  // namespace walr::test::walr_stages_test
