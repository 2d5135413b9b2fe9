// The longer history of what is at rest (passes/WALR.md, 2 and 9): antilag against a calculation in double precision,
// and what the whole method shows.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "passes/methods/denoiser.h"
#include "passes/temporal/antilag.h"
#include "shaders/temporal/antilag.h"
#include "tests/passes/denoiser_run.h"
#include "tests/passes/shaders.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::history_at_rest_test {
namespace {

using reference::HostFrame;
using reference::Image;

class HistoryAtRest : public fg::test::GpuTest {};

constexpr glm::ivec2 kSize(66, 50);
constexpr float kMaxHistory = 8.0F;

/// The antilag pass alone, with windows of one tile.
class AntilagRun {
 public:
  AntilagRun(const fg::test::TestDevice& device, glm::ivec2 tiles) : tiles_(tiles) {
    const fg::Extent pixels{std::uint32_t(kAntilagTile * tiles.x), std::uint32_t(kAntilagTile * tiles.y)};
    const fg::Extent extent = antilagTiles(pixels);
    steering_ = graph_.import("steering", {VK_FORMAT_R32G32_SFLOAT, extent}, fg::vk::kUploaded);
    Antilag antilag = declareAntilag(graph_, pixels, steering_);
    antilag.tiles = sums_ = graph_.import("tiles", {VK_FORMAT_R32G32B32A32_SFLOAT, extent}, fg::vk::kUploaded);
    const AntilagResult result = addAntilag(graph_, antilag, {.enabled = true, .radius = 0}, kMaxHistory);
    factor_ = copyOut(graph_, "factor", result.factor);
    shortening_ = importOutput(graph_, tiles);
    fg::PassBuilder pass = graph_.compute("floats of bits", shaders::floatBits);
    pass.sample("source", result.shortening).dispatch(extent);
    graph_.exported(pass.store("target", shortening_), fg::vk::kReadable);
    run_ = std::make_unique<fg::test::GraphRun>(device, graph_, fg::vk::ExecutorOptions{.shared = device.pipelines()});
  }

  /// @param scores   of all tiles
  /// @param steering `SteeredHistory::limits` of all tiles
  void frame(const Image<double>& scores, const Image<glm::vec2>& steering) {
    std::vector<glm::vec4> sums;
    for (const double score : scores.pixels()) sums.emplace_back(score, 1.0F, 0.0F, 1.0F);
    run_->fill(sums_, sums);
    run_->fill(steering_, steering.pixels());
    run_->frame();
  }
  [[nodiscard]] Image<glm::dvec4> factor() const { return readHalves(*run_, factor_, tiles_); }
  [[nodiscard]] Image<glm::dvec4> shortening() const { return readHalves(*run_, shortening_, tiles_); }

 private:
  glm::ivec2 tiles_;
  fg::Graph graph_;
  fg::Texture steering_, sums_, factor_, shortening_;
  std::unique_ptr<fg::test::GraphRun> run_;
};

/// The antilag factor of a tile by passes/WALR.md, 9.
double expectedFactor(double score, double least, double before) {
  const AntilagSettings settings;
  const double ofChange = std::clamp((score - settings.scoreLow) / (settings.scoreHigh - settings.scoreLow), 0.0, 1.0);
  if (least >= 0.0) return std::max(ofChange, least);
  const double ending = std::min(4.0 * ofChange, 1.0);
  const double longer = (1.0 - ending) * (1.0 - least) + ending;
  return std::max(1.0 - (1.0 - ofChange) * longer, before - 1.0 / kMaxHistory);
}

// Columns of tiles differ in how long the measured noise lets their history be, rows in when their light changes.
TEST_F(HistoryAtRest, AntilagAgreesWithDoublePrecision) {
  const std::array<float, 6> least{0.5F, 0.0F, -0.4F, -1.5F, -2.9F, -5.0F};
  const std::array scores{0.0, 1.0, 2.2, 3.0, 5.0};
  const glm::ivec2 tiles(least.size(), scores.size());
  AntilagRun run(device(), tiles);
  Image<double> before(tiles);
  constexpr int kFrames = 60;  // Enough for a history of 48 frames to grow.
  for (int i = 0; i < kFrames; ++i) {
    SCOPED_TRACE("frame " + std::to_string(i));
    Image<double> score(tiles);
    Image<glm::vec2> steering(tiles);
    reference::forEachPixel(tiles, [&](glm::ivec2 t) {
      score[t] = i == 50 + t.y ? scores.at(std::size_t(t.y)) : 0.0;
      steering[t] = {least.at(std::size_t(t.x)), 0.25F};
    });
    run.frame(score, steering);
    const Image<glm::dvec4> factor = run.factor(), shortening = run.shortening();
    reference::forEachPixel(tiles, [&](glm::ivec2 t) {
      const double expected = expectedFactor(score[t], steering[t].x, before[t]);
      // Both are read as halves. A float's roundings are far below that.
      const double rounding = std::exp2(-11.0) * std::max(std::abs(expected), 0.125);
      EXPECT_NEAR(factor[t].x, expected, rounding) << t.x << ", " << t.y;
      const double shorter = expected < -1.0 ? expected + 1.0 : 0.25;
      EXPECT_NEAR(shortening[t].x, shorter, rounding) << t.x << ", " << t.y;
      before[t] = factor[t].x;
    });
  }
}

Image<glm::dvec4> denoised(DenoiserRun& run, const std::vector<HostFrame>& frames) {
  Image<glm::dvec4> last(kSize);
  for (const HostFrame& frame : frames) last = run.frame(frame);
  return last;
}

std::unique_ptr<Denoiser> walrAtRest(const std::string& factor, bool antialiases = true) {
  std::unique_ptr<Denoiser> walr = makeDenoiser("walr");
  walr->set("accumulation.rest-factor", factor);
  walr->set("antialiasing.enabled", antialiases ? "on" : "off");
  return walr;
}

/// A camera that stands still, and jitters.
HostFrame stillFrame(const Scene& scene, std::uint32_t i, double light = 1.0, Noise noise = Noise::Exponential) {
  const FrameDescription camera = jittered(cameraAt(cameraPosition(0.0), cameraPosition(0.0), kSize, i), i);
  const Light scaled = [light](glm::dvec3 point, glm::dvec3 normal) { return light * smoothLight(point, normal); };
  return renderFrame(scene, camera, kSize, scaled, noise);
}

/// `walr` with a longer history at rest, and without.
struct Runs {
  explicit Runs(const fg::test::TestDevice& device)
      : atRest(device, *longer, kSize), asInMotion(device, *same, kSize) {}
  /// The errors of both in one frame after another.
  std::array<double, 2> errors(const Scene& scene, std::uint32_t i, double light = 1.0) {
    const HostFrame frame = stillFrame(scene, i, light), truth = stillFrame(scene, i, light, Noise::None);
    return {surfaceError(atRest.frame(frame), truth), surfaceError(asInMotion.frame(frame), truth)};
  }
  void skip(const Scene& scene, std::uint32_t frames) {
    for (std::uint32_t i = 0; i < frames; ++i) {
      const HostFrame frame = stillFrame(scene, i);
      static_cast<void>(atRest.frame(frame));
      static_cast<void>(asInMotion.frame(frame));
    }
  }
  std::unique_ptr<Denoiser> longer = walrAtRest("6"), same = walrAtRest("1");
  DenoiserRun atRest, asInMotion;
};

constexpr std::uint32_t kGrown = 56;  ///< Frames after which history has its full length.

// Noise of mean light falls with the root of the history length, at most to the root of 1/6; errors of the fits stay.
// Measured: .59 and .63.
TEST_F(HistoryAtRest, TakesNoiseFromAStillPicture) {
  for (const Scene& scene : {flatWall(), thinBars()}) {
    Runs runs(device());
    runs.skip(scene, kGrown);
    double before = 0.0, after = 0.0;
    for (std::uint32_t i = kGrown; i < kGrown + 8; ++i) {
      const auto [withRest, without] = runs.errors(scene, i);
      before += without;
      after += withRest;
    }
    EXPECT_LT(after, 0.7 * before);
  }
}

// Light that changes at once ends the longer history. Measured: no frame errs by .3 % more.
TEST_F(HistoryAtRest, FollowsALightThatChanges) {
  Runs runs(device());
  runs.skip(flatWall(), kGrown);
  for (std::uint32_t i = kGrown; i < kGrown + 8; ++i) {
    SCOPED_TRACE("frame " + std::to_string(i - kGrown) + " after the change");
    const auto [withRest, without] = runs.errors(flatWall(), i, 0.25);
    EXPECT_LT(withRest, 1.02 * without);
  }
}

TEST_F(HistoryAtRest, LeavesMovingFramesAsTheyAre) {
  const std::vector<HostFrame> frames = movingFrames(stairs(), kSize, 12);
  std::unique_ptr<Denoiser> longer = walrAtRest("6", false), same = walrAtRest("1", false);
  DenoiserRun atRest(device(), *longer, kSize), asInMotion(device(), *same, kSize);
  EXPECT_TRUE(std::ranges::equal(denoised(atRest, frames).pixels(), denoised(asInMotion, frames).pixels()));
}

}  // namespace
}  // namespace walr::test::history_at_rest_test
