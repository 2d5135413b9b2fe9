// Counters of the other methods' filters: exact where the answer is known, and equal to the sums of their views on
// every hard case.

#include <cmath>
#include <limits>
#include <string>

#include "tests/passes/counted_run.h"
#include "tests/passes/hard_cases.h"
#include "tests/passes/reference/hash.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::baselines_counters_test {
namespace {

using reference::HostFrame;
using reference::Image;
using Settings = std::vector<std::pair<const char*, const char*>>;

constexpr glm::ivec2 kSize(96, 72);
constexpr std::uint64_t kPixels = std::uint64_t(kSize.x) * kSize.y;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

CountedRun countedRun(const fg::test::TestDevice& device, const char* name, const Settings& settings,
                      glm::ivec2 size = kSize) {
  const auto method = makeDenoiser(name);
  for (const auto& [setting, value] : settings) method->set(setting, value);
  return {device, *method, size};
}

/// Light as a small window sees it at one sample per pixel: one pixel in `rarity`, scattered, has the value 4, the
/// others 0.
HostFrame sparseLight(const Scene& scene, std::uint32_t rarity) {
  HostFrame frame = renderStill(scene, kSize);
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    frame.lighting[p] = glm::dvec3(reference::pcg4d({p, 3, 7}).x % rarity == 0 ? 4.0 : 0.0);
  });
  return frame;
}

void dropSamples(HostFrame& frame, bool (*dropped)(glm::ivec2 p)) {
  reference::forEachPixel(frame.size(), [&](glm::ivec2 p) {
    if (dropped(p)) frame.lighting[p].y = kNaN;
  });
}

std::uint64_t channelsAtZero(const Image<glm::dvec4>& output) {
  std::uint64_t count = 0;
  for (const glm::dvec4& pixel : output.pixels())
    for (int c = 0; c < 3; ++c) count += pixel[c] == 0.0 ? 1 : 0;
  return count;
}

class BaselineCountersTest : public fg::test::GpuTest {};

// On a wall with a single normal and no noise, the components of the normal and one axis of the positions are linear
// combinations of the constant and the other axes, so all blocks drop features. With noise all features are kept.
TEST_F(BaselineCountersTest, BmfrCountsBlocksShortOfRank) {
  const HostFrame flat = renderStill(flatWall(), kSize);
  CountedRun aware = countedRun(device(), "bmfr", {{"fit.rank-handling", "deterministic"}});
  EXPECT_EQ(aware.count(flat).at("rank-deficient-fits"), kPixels);
  CountedRun noisy = countedRun(device(), "bmfr", {});
  EXPECT_EQ(noisy.count(flat).at("rank-deficient-fits"), 0U);
}

// Frame 11 displaces the grid by (-2, -2), so blocks begin at -18, 14, 46 and 78. With no samples in columns 40 to 85,
// the blocks from 46 to 77 have none.
TEST_F(BaselineCountersTest, BmfrCountsBlocksWithoutASample) {
  HostFrame frame = renderStill(bumpyWall(0.1), kSize, 11);
  dropSamples(frame, [](glm::ivec2 p) { return p.x >= 40 && p.x < 86; });
  CountedRun run = countedRun(device(), "bmfr", {});
  const auto counted = run.count(frame);
  EXPECT_EQ(counted.at("unfitted-pixels"), 32U * kSize.y);
  EXPECT_EQ(counted.at("rank-deficient-fits"), 32U * kSize.y);
  EXPECT_EQ(counted.at("unsampled-pixels"), 46U * kSize.y);
  EXPECT_EQ(counted.at("non-finite-fits"), 0U);
}

// A channel of a fit is below 0 exactly where the output is 0: the light is so sparse that fits swing through 0, but
// each window holds some light, so no fit is exactly 0.
TEST_F(BaselineCountersTest, FitsBelowZeroAreThoseThatComeOutAsZero) {
  struct Case {
    const char* method;
    Settings settings;
    std::uint32_t rarity;
  };
  const Case cases[] = {{"bmfr", {{"antialiasing.enabled", "off"}}, 100},
                        {"flr", {{"spatial-only", "on"}, {"regression.single-frame-sigma", "3"}}, 10}};
  for (const auto& [method, settings, rarity] : cases) {
    SCOPED_TRACE(method);
    CountedRun run = countedRun(device(), method, settings);
    const auto counted = run.count(sparseLight(bumpyWall(0.3), rarity));
    EXPECT_GT(counted.at("clamped-channels"), 100U);
    EXPECT_EQ(counted.at("clamped-channels"), channelsAtZero(run.output()));
  }
}

// Where the guides do not vary, the ridge determines every slope. Where normals and depth vary as widely as here, a
// ridge of 1e-6 determines none.
TEST_F(BaselineCountersTest, FlrCountsFitsDeterminedByTheRidge) {
  const Settings settings{{"spatial-only", "on"}, {"regression.occlusion-guide", "off"}, {"regression.ridge", "1e-6"}};
  CountedRun run = countedRun(device(), "flr", settings);
  EXPECT_EQ(run.count(renderStill(flatWall(), kSize)).at("regularised-fits"), kPixels);
  EXPECT_EQ(run.count(renderStill(bumpyWall(0.3), kSize)).at("regularised-fits"), 0U);
}

// A window reaches 1 sigma of 4 pixels, which is one cell, and so covers the eight cells around. Among the columns
// without a sample, those at least a cell away from the others have no sample in reach.
TEST_F(BaselineCountersTest, FlrCountsCellsWithoutASample) {
  HostFrame frame = renderStill(bumpyWall(0.1), kSize);
  dropSamples(frame, [](glm::ivec2 p) { return p.x >= 32 && p.x < 64; });
  CountedRun run = countedRun(device(), "flr",
                              {{"spatial-only", "on"},
                               {"regression.single-frame-sigma", "4"},
                               {"regression.reach", "1"},
                               {"regression.upsampling", "nearest"}});
  const auto counted = run.count(frame);
  EXPECT_EQ(counted.at("unsampled-pixels"), 32U * kSize.y);
  EXPECT_EQ(counted.at("no-samples"), 24U * kSize.y);
  EXPECT_EQ(counted.at("unfitted-pixels"), 24U * kSize.y);
  EXPECT_EQ(counted.at("non-finite-fits"), 0U);
}

// Until a pixel has four frames, the spatial variance replaces the temporal one.
TEST_F(BaselineCountersTest, SvgfCountsDeviationsFromTheSurroundings) {
  CountedRun run = countedRun(device(), "svgf", {});
  for (std::uint32_t i = 0; i < 5; ++i) {
    HostFrame frame = renderStill(bumpyWall(0.1), kSize, i);
    if (i == 0) dropSamples(frame, [](glm::ivec2 p) { return p.x < 7; });
    const auto counted = run.count(frame);
    const std::uint64_t late = 7U * kSize.y;  // Pixels of the columns that have one sample less.
    EXPECT_EQ(counted.at("unsampled-pixels"), i == 0 ? late : 0U) << "frame " << i;
    const std::uint64_t few = i == 0 ? kPixels - late : i < 3 ? kPixels : i == 3 ? late : 0U;
    EXPECT_EQ(counted.at("deviations-from-surroundings"), few) << "frame " << i;
  }
}

TEST_F(BaselineCountersTest, JointBilateralCountsWindowsWithoutASample) {
  HostFrame frame = renderStill(flatWall(), kSize);
  dropSamples(frame, [](glm::ivec2 p) { return p.x >= 32 && p.x < 64; });
  CountedRun run = countedRun(device(), "joint_bilateral", {{"spatial-only", "on"}, {"bilateral.radius", "4"}});
  const auto counted = run.count(frame);
  EXPECT_EQ(counted.at("unsampled-pixels"), 32U * kSize.y);
  EXPECT_EQ(counted.at("no-samples"), 24U * kSize.y);
}

/// Whether a pixel shows a surface but its light is not finite.
std::uint64_t unsampledSurfaces(const HostFrame& frame) {
  std::uint64_t count = 0;
  reference::forEachPixel(frame.size(), [&](glm::ivec2 p) {
    const glm::dvec3 l = frame.lighting[p];
    const bool sampled = std::isfinite(l.x) && std::isfinite(l.y) && std::isfinite(l.z);
    count += !sampled && reference::surfaceAt(frame, p, {}).depth > 0.0 ? 1 : 0;
  });
  return count;
}

// No fit is non-finite, pixels without a sample are counted, and every counter is the sum of its view.
TEST_F(BaselineCountersTest, AreTheSumsOfTheirViewsOnHardCases) {
  const std::vector<HardCase> cases = hardCases();
  for (const char* name : {"bmfr", "flr", "svgf", "joint_bilateral"}) {
    for (const char* spatialOnly : {"off", "on"}) {
      // The fit reads samples as it reads accumulated light, and lavapipe compiles its views for tens of seconds.
      if (name == std::string("bmfr") && spatialOnly == std::string("on")) continue;
      const auto method = makeDenoiser(name);
      method->set("spatial-only", spatialOnly);
      std::vector<std::string> views;
      for (const ViewInfo& view : method->views())
        if (!view.counters.empty()) views.emplace_back(view.name);
      CountedRun run(device(), *method, cases.front().frames.front().size(), views);
      for (const HardCase& hard : cases) {
        SCOPED_TRACE(std::string(name) + ", spatial-only " + spatialOnly + ", " + hard.name);
        run.reset();
        for (std::size_t i = 0; i < hard.frames.size(); ++i) {
          const auto counted = run.count(hard.frames[i]);
          run.expectSumsOfViews(counted);
          if (counted.contains("non-finite-fits")) {
            EXPECT_EQ(counted.at("non-finite-fits"), 0U);
          }
          // From the second frame on, history may replace the sample.
          if (i == 0) {
            EXPECT_EQ(counted.at("unsampled-pixels"), unsampledSurfaces(hard.frames[i]));
          }
          const Image<glm::dvec4> output = run.output();
          for (const glm::dvec4& v : output.pixels()) {
            for (int c = 0; c < 3; ++c) ASSERT_TRUE(std::isfinite(v[c]) && v[c] >= 0.0);
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace walr::test::baselines_counters_test
