// Counters of every method: exact, also while other frames are in flight.

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "tests/passes/counted_run.h"
#include "tests/passes/hard_cases.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::counters_test {
namespace {

using reference::HostFrame;
using reference::Image;

constexpr glm::ivec2 kSize(48, 36);
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Counts taken directly from the input.
struct InputCounts {
  std::uint64_t nonFiniteLighting = 0;
  std::uint64_t nonFiniteDepth = 0;
  std::uint64_t nonFiniteNormals = 0;
  std::uint64_t surfaces = 0;
};
InputCounts countInput(const HostFrame& frame) {
  InputCounts counts;
  reference::forEachPixel(frame.size(), [&](glm::ivec2 p) {
    counts.nonFiniteLighting += reference::isFinite(frame.lighting[p]) ? 0 : 1;
    counts.nonFiniteDepth += std::isfinite(frame.depth[p]) ? 0 : 1;
    counts.nonFiniteNormals += reference::isFinite(frame.normal[p]) ? 0 : 1;
    counts.surfaces += reference::surfaceAt(frame, p, {}).depth > 0.0 ? 1 : 0;
  });
  return counts;
}

/// Visit `count` scattered pixels, from the `start`-th of a sequence on that visits no pixel twice.
template <typename Apply>
void scatter(int start, int count, Apply apply) {
  for (int i = start; i < start + count; ++i) {
    const int index = i * 29 % (kSize.x * kSize.y);  // 29 has no divisor in common with the number of pixels.
    apply(glm::ivec2(index % kSize.x, index / kSize.x));
  }
}

class CountersTest : public fg::test::GpuTest {};

TEST_F(CountersTest, EveryMethodCountsExactlyWhatIsInjected) {
  HostFrame frame = renderStill(bumpyWall(0.1), kSize);
  scatter(0, 17, [&](glm::ivec2 p) { frame.lighting[p].g = kNaN; });
  scatter(17, 5, [&](glm::ivec2 p) { frame.lighting[p].r = kInfinity; });
  scatter(30, 11, [&](glm::ivec2 p) { frame.lighting[p].b = -1.0; });
  scatter(50, 7, [&](glm::ivec2 p) { frame.motion[p].x = kNaN; });
  scatter(60, 3, [&](glm::ivec2 p) { frame.depth[p] = kNaN; });
  scatter(70, 4, [&](glm::ivec2 p) { frame.depth[p] = 1e10; });
  scatter(80, 6, [&](glm::ivec2 p) { frame.normal[p].z = kInfinity; });
  scatter(90, 8, [&](glm::ivec2 p) { frame.normal[p] = glm::dvec3(0.0); });
  scatter(100, 9, [&](glm::ivec2 p) { frame.albedo[p].g = kNaN; });
  scatter(110, 2, [&](glm::ivec2 p) { frame.albedo[p] = glm::dvec3(0.0); });
  const std::map<std::string, std::uint64_t> expected{
      {"non-finite-lighting", 22}, {"clamped-lighting", 11}, {"non-finite-motion", 7}, {"non-finite-depth", 3},
      {"non-finite-normals", 6},   {"non-finite-albedo", 9}, {"sky", 3 + 4},           {"unusable-normals", 14},
      {"no-diffuse-lobe", 9 + 2}};
  const std::uint64_t surfaces = kSize.x * kSize.y - 7 - 14 - 11;
  for (const std::string& name : denoiserNames()) {
    if (name == "none") continue;
    SCOPED_TRACE(name);
    const auto method = makeDenoiser(name);
    // The preset `paper` treats every surface as diffuse, so that it does not read the albedo at all.
    if (name == "walr_paper") method->usePreset("robust");
    CountedRun run(device(), *method, kSize);
    const auto counted = run.count(frame);
    for (const auto& [counter, value] : expected) {
      const bool always = counter == "sky" || counter == "unusable-normals" || counter == "non-finite-depth";
      if (counted.contains(counter)) {
        EXPECT_EQ(counted.at(counter), value) << counter;
      } else {
        EXPECT_FALSE(always) << counter;
      }
    }
    // A first frame has no history.
    if (counted.contains("no-history")) {
      EXPECT_EQ(counted.at("no-history"), surfaces);
      EXPECT_EQ(counted.at("rejected-history-taps"), 4 * surfaces);
    }
  }
}

TEST_F(CountersTest, PixelsWithoutASampleAreThoseWhoseLightIsNotFinite) {
  HostFrame frame = renderStill(bumpyWall(0.1), kSize);
  scatter(0, 17, [&](glm::ivec2 p) { frame.lighting[p].g = kNaN; });
  for (const char* name : {"walr", "walr_paper"}) {
    for (const char* spatialOnly : {"off", "on"}) {
      SCOPED_TRACE(std::string(name) + ", spatial-only " + spatialOnly);
      const auto method = makeDenoiser(name);
      method->set("spatial-only", spatialOnly);
      CountedRun run(device(), *method, kSize);
      EXPECT_EQ(run.count(frame).at("unsampled-pixels"), 17U);
    }
  }
}

TEST_F(CountersTest, AreReadWhileOtherFramesAreInFlight) {
  const auto method = makeDenoiser("walr");
  CountedRun run(device(), *method, kSize);
  const auto broken = [](int count) {
    HostFrame frame = renderStill(bumpyWall(0.1), kSize);
    scatter(0, count, [&](glm::ivec2 p) { frame.lighting[p].g = kNaN; });
    return frame;
  };
  // Both frames of a pair are recorded before the test waits for the first one. Each frame has its own counters.
  for (int i = 1; i < 8; i += 2) {
    const std::uint32_t first = run.submit(broken(3 * i));
    const std::uint32_t second = run.submit(broken(3 * i + 1));
    ASSERT_NE(first, second);
    run.finish();
    EXPECT_EQ(run.counters(first).at("non-finite-lighting"), 3 * i);
    EXPECT_EQ(run.counters(second).at("non-finite-lighting"), 3 * i + 1);
  }
}

/// `walr_paper` with a preset, or `walr` if the preset is empty.
std::unique_ptr<Denoiser> walrOf(const std::string& preset) {
  if (preset.empty()) return makeDenoiser("walr");
  std::unique_ptr<Denoiser> method = makeDenoiser("walr_paper");
  method->usePreset(preset);
  return method;
}

TEST_F(CountersTest, DoNotChangeTheOutput) {
  const HostFrame frames[] = {renderStill(stairs(), kSize, 0), renderStill(stairs(), kSize, 1)};
  for (const char* preset : {"", "robust", "paper"}) {
    const std::unique_ptr<Denoiser> method = walrOf(preset);
    fg::Graph graph;
    const DenoiserInputs inputs = importInputs(graph, kSize);
    const fg::Texture output = importOutput(graph, kSize);
    graph.exported(method->add(graph, inputs, output), fg::vk::kReadable);
    fg::test::GraphRun plain(device(), graph, {.shared = device().pipelines()});
    CountedRun counted(device(), *method, kSize);
    for (const HostFrame& frame : frames) {
      upload(plain, inputs, frame);
      plain.frame();
      (void)counted.count(frame);
      EXPECT_EQ(readHalves(plain, output, kSize).pixels(), counted.output().pixels()) << preset;
    }
  }
}

/// A preset of `walr_paper`, or `walr` if it is empty, with settings of storage and regularisation.
struct Variant {
  const char* preset;
  std::vector<std::pair<const char*, const char*>> settings;
};
const std::vector<Variant> kVariants{
    {"", {}},
    {"robust", {}},
    {"robust", {{"regression.regularisation", "floor"}, {"regression.ridge", "1e-4"}}},
    {"paper", {}},
    {"paper", {{"regression.moments", "raw11"}, {"regression.ridge", "1e-2"}}},
    {"paper", {{"regression.moments", "raw11"}, {"regression.ridge", "1e-2"}, {"regression.regularisation", "ridge"}}},
    {"paper", {{"regression.moments", "raw16"}, {"regression.regularisation", "ridge"}}},
    {"paper", {{"regression.moments", "raw32"}, {"regression.ridge", "1e-5"}}},
    {"paper", {{"regression.moments", "raw32"}, {"regression.ridge", "1e-5"}, {"regression.regularisation", "ridge"}}}};

// The output is finite and not negative, the counters of the input agree with the input, and every counter that has a
// view is the view's sum.
TEST_F(CountersTest, AgreeWithInputAndViewsOnHardCasesInEveryStorageAndSolver) {
  const std::vector<HardCase> cases = hardCases();
  for (const Variant& variant : kVariants) {
    const std::unique_ptr<Denoiser> method = walrOf(variant.preset);
    const std::string preset = variant.preset;
    std::string name = preset.empty() ? "walr" : preset;
    for (const auto& [setting, value] : variant.settings) {
      method->set(setting, value);
      name += std::string(", ") + setting + "=" + value;
    }
    SCOPED_TRACE(name);
    const bool masked = preset != "paper";
    const std::vector<std::string> views{"no-surface", "history", "clamped", "pivots", "few-samples", "clip"};
    method->set(preset.empty() ? "walr.fit-window" : "walr_paper.fit-window", "off");
    CountedRun run(device(), *method, kSize, views);
    for (const HardCase& hard : cases) {
      SCOPED_TRACE(hard.name);
      run.reset();
      for (const HostFrame& frame : hard.frames) {
        const auto counted = run.count(frame);
        const InputCounts input = countInput(frame);
        EXPECT_EQ(counted.at("non-finite-lighting"), input.nonFiniteLighting);
        EXPECT_EQ(counted.at("non-finite-depth"), input.nonFiniteDepth);
        EXPECT_EQ(counted.at("non-finite-normals"), input.nonFiniteNormals);
        const std::uint64_t passThrough =
            counted.at("sky") + counted.at("unusable-normals") + counted.at("no-diffuse-lobe");
        if (masked) {
          EXPECT_EQ(passThrough, kSize.x * kSize.y - input.surfaces);
        }
        run.expectSumsOfViews(counted);
        const Image<glm::dvec4> output = run.output();
        for (const glm::dvec4& v : output.pixels()) {
          for (int c = 0; c < 3; ++c) {
            ASSERT_TRUE(std::isfinite(v[c]));
            ASSERT_GE(v[c], 0.0);
          }
        }
      }
    }
  }
}

// Where the features do not vary, regularisation alone determines every fit. Where they vary as widely as this
// scene's normals do, with variances of at least 0.01, a ridge of 1e-5 determines none.
TEST_F(CountersTest, RegularisedFitsAreThoseWhoseFeaturesDoNotVary) {
  const std::unique_ptr<Denoiser> method = walrOf("robust");
  method->set("regression.noise-ridge", "0");
  method->set("regression.ridge", "1e-5");
  method->set("walr_paper.fit-window", "off");
  CountedRun run(device(), *method, kSize);
  const auto flat = run.count(renderStill(flatWall(), kSize));
  EXPECT_EQ(flat.at("regularised-fits"), std::uint64_t(kSize.x) * kSize.y);
  EXPECT_EQ(flat.at("clamped-channels"), 0U);
  run.reset();
  EXPECT_EQ(run.count(renderStill(bumpyWall(0.3), kSize)).at("regularised-fits"), 0U);
}

}  // namespace
}  // namespace walr::test::counters_test
