// Views of WALR's guides and temporal stages agree with the double-precision reference.

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/passes/comparison.h"
#include "tests/passes/reference/history.h"
#include "tests/passes/reference/temporal_antialiasing.h"
#include "tests/passes/stage_checks.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/passes/walr_run.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::walr_temporal_views_test {
namespace {

using reference::HostFrame;
using reference::Image;

constexpr glm::ivec2 kSize(66, 46);
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Settings that each select other shaders.
struct NamedSettings {
  const char* name;
  AnyWalr settings;
  SceneDescription scene;
  bool jittered = false;
};
std::vector<NamedSettings> allSettings() {
  WalrPaperSettings apart = robustWalr();
  apart.antialiasing.thresholds.normalThreshold = 0.4F;  // Makes anti-aliasing do its own reprojection.
  WalrPaperSettings byDepth = apart;
  byDepth.accumulation.rejection = HistoryRejection::Depth;
  byDepth.antialiasing.rejection = HistoryRejection::Depth;
  WalrSettings packedApart;
  packedApart.antialiasing.thresholds.normalThreshold = 0.4F;
  const SceneDescription camera{.objectMotion = false};
  return {{"robust", robustWalr(), {}},
          {"paper", paperWalr(), {}},
          {"two reprojections", apart, {}},
          {"camera alone", apart, camera},
          {"by depth", byDepth, {}},
          {"by depth, camera alone", byDepth, camera},
          {"packed", WalrSettings{}, {}},
          {"packed, two reprojections", packedApart, {}},
          {"jittered", robustWalr(), {}, true},
          {"jittered, two reprojections", apart, {}, true},
          {"jittered, packed", WalrSettings{}, {}, true}};
}

/// The history of a stage at a pixel.
struct Past {
  reference::HistorySample history;
  int rejected = 0;
  bool undecided = false;
};
Past pastOf(const DeviceFrame& f, const Image<glm::dvec4>& before, glm::ivec2 p,
            const reference::ReprojectionOptions& options, const reference::HistoryTests& tests,
            const reference::HistoryReading& reading) {
  const reference::Reprojection r = reference::reproject(f.frame, f.current.guides, p, options);
  const auto taps = reference::historyTaps(f.frame, r, f.previous.guides, tests);
  Past past{reference::sampleHistory(r, taps, before, reading), 0, r.undecided};
  for (const reference::HistoryTap& tap : taps) {
    // With no test of history only the image's border rejects a tap; the sky is skipped because it has no samples.
    const bool accepted =
        tests.rejection == HistoryRejection::None ? f.previous.guides.contains(tap.pixel) : tap.matches;
    past.rejected += r.valid && accepted ? 0 : 1;
    past.undecided = past.undecided || tap.undecided;
  }
  past.undecided = past.undecided || past.history.undecided;
  return past;
}

void expectHistory(Comparison& comparison, const DeviceFrame& f, glm::ivec2 p, const AnyWalr& settings, bool keepTaps) {
  const glm::dvec3 view = f.current.views.at("history")[p];
  const TemporalAccumulationSettings& accumulation = settings.accumulation();
  const Past past =
      pastOf(f, f.previous.accumulated, p, {.dilateMotion = accumulation.dilateMotion, .keepTaps = keepTaps},
             reference::historyTestsOf(accumulation), {.filter = accumulation.historyFilter});
  if (comparison.skips(past.undecided)) return;
  const bool packed = settings.packsAccumulation();
  comparison.value(p, "history length", f.current.accumulated[p].w, view.x,
                   packed ? reference::packedCountStep(view.x) : halfTolerance(view.x, 0.0));
  comparison.value(p, "rejected", view.y, past.rejected, 0.0);
  comparison.value(p, "no history", view.z, past.history.found ? 0.0 : 1.0, 0.0);
}

/// The output is a mean of n frames, n - 1 of which are the clipped history. The history that follows from it agrees
/// with the view.
void expectClipping(Comparison& comparison, const DeviceFrame& f, glm::ivec2 p, const AnyWalr& settings,
                    bool keepTaps) {
  const glm::dvec3 clip = f.current.views.at("clip")[p];
  const glm::dvec3 resolved = f.current.views.at("resolved-history")[p];
  const TemporalAntialiasingSettings& antialiasing = settings.antialiasing();
  const Past past =
      pastOf(f, f.previous.resolved, p, reference::reprojectionOf(f.frame, antialiasing, keepTaps),
             reference::historyTestsOf(f.frame, antialiasing), reference::historyReadingOf(f.frame, antialiasing));
  if (comparison.skips(past.undecided || past.history.found != (resolved.z == 0.0))) return;
  const bool packed = settings.packsAntialiasing();
  const double n = resolved.x;
  comparison.value(p, "frames", f.current.resolved[p].w, n,
                   packed ? reference::packedLengthStep(n, settings.antialiasing().maxHistory) : halfTolerance(n, 0.0));
  comparison.value(p, "rejected after the filter", resolved.y, past.rejected, 0.0);
  const bool clipped = clip.z == 1.0;
  comparison.value(p, "clipped or not", clip.x > 0.0 ? 1.0 : 0.0, clip.z, 0.0);
  comparison.value(p, "share where clipped", clip.y > 0.0 ? 1.0 : 0.0, clip.z, 0.0);
  if (!past.history.found) {
    comparison.value(p, "clipped without history", clip.x, 0.0, 0.0);
    return;
  }
  const glm::dvec3 output(f.current.output[p]);
  const glm::dvec3 filtered = reference::lightOfFrame(f.frame, f.current.guides, f.current.filtered, p, antialiasing);
  if (output.x == 0.0 || output.y == 0.0 || output.z == 0.0) return;  // Values below 0 were clamped.
  const glm::dvec3 kept = filtered + (output - filtered) * n / (n - 1.0);
  const glm::dvec3 before(past.history.value);
  const glm::dvec3 size = glm::abs(output) + glm::abs(filtered) + glm::abs(before);
  const double reach = size.x + size.y + size.z;
  // The output is stored as a half, and the history computed from it is n / (n - 1) times as uncertain. The error of
  // the history itself is added. A length in YCoCg is at most that in RGB.
  const glm::dvec3 pastError(past.history.error);
  const double tolerance =
      n / (n - 1.0) * 2.0 * reference::kHalfRoundoff * reach + pastError.x + pastError.y + pastError.z;
  const double distance = glm::length(reference::toYCoCg(kept) - reference::toYCoCg(before));
  comparison.value(p, "distance", clipped ? clip.x : 0.0, distance, tolerance);
}

class WalrTemporalViewsTest : public fg::test::GpuTest {};

TEST_F(WalrTemporalViewsTest, ShowHistoryAndClipping) {
  for (const NamedSettings& named : allSettings()) {
    for (const Scene& scene : {thinBars(), skyBesideSurface()}) {
      SCOPED_TRACE(named.name);
      WalrRun run(device(), kSize, named.settings, {}, true, named.scene, {"history", "clip", "resolved-history"});
      const bool keepTaps = sharesReprojection(named.settings.antialiasing(), named.settings.accumulation());
      DeviceFrame f;
      for (const HostFrame& frame : named.jittered ? jitteredFrames(scene, kSize) : movingFrames(scene, kSize)) {
        f.previous = std::move(f.current);
        f.frame = frame;
        f.frame.scene = named.scene;
        f.current = run.frame(f.frame);
      }
      Comparison history("history");
      Comparison clipping("clipping");
      int clipped = 0;
      reference::forEachPixel(kSize, [&](glm::ivec2 p) {
        if (f.current.guides[p].depth == 0.0) {
          for (const auto& [name, image] : f.current.views) EXPECT_EQ(image[p], glm::dvec3(0.0)) << name;
          return;
        }
        expectHistory(history, f, p, named.settings, keepTaps);
        expectClipping(clipping, f, p, named.settings, keepTaps);
        clipped += f.current.views.at("clip")[p].z == 1.0 ? 1 : 0;
      });
      history.expect(kUndecidedShare);
      clipping.expect(kUndecidedShare);
      EXPECT_GT(clipped, 0);
    }
  }
}

TEST_F(WalrTemporalViewsTest, AStillImageLosesNoHistory) {
  const SceneDescription still{.cameraMotion = false, .objectMotion = false, .jitter = false};
  WalrRun run(device(), kSize, robustWalr(), {}, true, still, {"history", "resolved-history", "broken-lighting"});
  for (std::uint32_t i = 0; i < 3; ++i) {
    const WalrStages stages = run.frame(renderStill(flatWall(), kSize, i));
    const glm::dvec3 expected(i + 1.0, 0.0, i == 0 ? 1.0 : 0.0);
    for (const char* view : {"history", "resolved-history"})
      for (const glm::dvec3& v : stages.views.at(view).pixels()) EXPECT_EQ(v, expected) << view << ", frame " << i;
    for (const glm::dvec3& v : stages.views.at("broken-lighting").pixels()) EXPECT_EQ(v, glm::dvec3(0.0));
  }
}

TEST_F(WalrTemporalViewsTest, ShowWhereHistoryIsShortened) {
  constexpr std::uint32_t kChange = 4;
  WalrPaperSettings settings = robustWalr();
  settings.accumulation.antilag.enabled = true;
  WalrRun run(device(), kSize, settings, {}, true, {}, {"antilag", "history"});
  WalrStages stages;
  Image<glm::dvec4> before;
  for (std::uint32_t i = 0; i <= kChange + 1; ++i) {
    HostFrame frame = renderStill(bumpyWall(0.1), kSize, i);
    if (i >= kChange)
      for (glm::dvec3& l : frame.lighting.pixels()) l *= 0.25;  // Exact for halves.
    before = stages.accumulated;
    stages = run.frame(frame);
  }
  const double most = settings.accumulation.maxHistory;
  int shortened = 0;
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    const glm::dvec3 view = stages.views.at("antilag")[p];
    EXPECT_NEAR(view.y, most * (1.0 - view.x), 4.0 * reference::kFloatRoundoff * most);
    EXPECT_EQ(view.z, before[p].w > view.y ? 1.0 : 0.0);
    const double samples = std::min(before[p].w, view.y) + 1.0;
    EXPECT_NEAR(stages.accumulated[p].w, samples, halfTolerance(samples, 0.0));
    EXPECT_EQ(stages.views.at("history")[p].x, samples);
    shortened += view.z == 1.0 ? 1 : 0;
  });
  EXPECT_GT(shortened, kSize.x * kSize.y / 2);
}

// Each broken pixel, and no other, shows in the view for its kind of fault.
TEST_F(WalrTemporalViewsTest, MasksShowExactlyWhatIsBroken) {
  struct Damage {
    const char* view;
    int component;
    void (*apply)(HostFrame&, glm::ivec2);
  };
  const Damage damages[] = {
      {"broken-lighting", 0, [](HostFrame& f, glm::ivec2 p) { f.lighting[p].g = kNaN; }},
      {"broken-lighting", 0, [](HostFrame& f, glm::ivec2 p) { f.lighting[p].b = -kInfinity; }},
      {"broken-lighting", 1, [](HostFrame& f, glm::ivec2 p) { f.lighting[p].r = -0.25; }},
      {"broken-lighting", 2, [](HostFrame& f, glm::ivec2 p) { f.motion[p].y = kInfinity; }},
      {"broken-guides", 0, [](HostFrame& f, glm::ivec2 p) { f.depth[p] = kNaN; }},
      {"broken-guides", 1, [](HostFrame& f, glm::ivec2 p) { f.normal[p].x = kNaN; }},
      {"broken-guides", 2, [](HostFrame& f, glm::ivec2 p) { f.albedo[p].b = kInfinity; }},
      {"no-surface", 0, [](HostFrame& f, glm::ivec2 p) { f.depth[p] = 1e10; }},
      {"no-surface", 1, [](HostFrame& f, glm::ivec2 p) { f.normal[p] = glm::dvec3(0.0); }},
      {"no-surface", 2, [](HostFrame& f, glm::ivec2 p) { f.albedo[p] = glm::dvec3(0.0); }},
  };
  WalrRun run(device(), kSize, robustWalr(), {}, false, {}, {"broken-lighting", "broken-guides", "no-surface"});
  HostFrame frame = renderStill(bumpyWall(0.1), kSize);
  Image<glm::dvec3> expected[] = {Image<glm::dvec3>(kSize), Image<glm::dvec3>(kSize), Image<glm::dvec3>(kSize)};
  const std::string views[] = {"broken-lighting", "broken-guides", "no-surface"};
  int x = 3;
  for (const Damage& damage : damages) {
    x += 5;
    for (int y = 2; y < kSize.y; y += 3) {
      damage.apply(frame, {x, y});
      for (int v = 0; v < 3; ++v)
        if (views[v] == damage.view) expected[v][{x, y}][damage.component] = 1.0;
      // A pixel has no surface either where depth, normal or albedo are not finite.
      if (std::string(damage.view) == "broken-guides") expected[2][{x, y}][damage.component] = 1.0;
    }
  }
  const WalrStages stages = run.frame(frame);
  for (int v = 0; v < 3; ++v) EXPECT_EQ(stages.views.at(views[v]).pixels(), expected[v].pixels()) << views[v];
}

}  // namespace
}  // namespace walr::test::walr_temporal_views_test
