// The longer history of what is at rest (passes/WALR.md, 2 and 9): antilag against a calculation in double precision,
// and what the whole method shows.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
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

constexpr float kRestFactor = 6.0F;

/// The antilag pass alone, without or with another pass that tells how far history is to be shortened.
class AntilagRun {
 public:
  AntilagRun(const fg::test::TestDevice& device, glm::ivec2 tiles, bool steered, std::uint32_t radius)
      : tiles_(tiles), pixels_{std::uint32_t(kAntilagTile * tiles.x), std::uint32_t(kAntilagTile * tiles.y)} {
    const fg::Extent extent = antilagTiles(pixels_);
    const fg::TextureDesc sums{VK_FORMAT_R32G32B32A32_SFLOAT, extent};
    frame_ = graph_.upload("frame constants", sizeof(FrameConstants));
    if (steered) steering_ = graph_.import("steering", {VK_FORMAT_R32G32_SFLOAT, extent}, fg::vk::kUploaded);
    Antilag antilag = declareAntilag(graph_, pixels_, steering_, true);
    antilag.tiles = now_ = graph_.import("tiles", sums, fg::vk::kUploaded);
    const AntilagResult result =
        addAntilag(graph_, antilag, {.enabled = true, .radius = radius}, {kMaxHistory, kRestFactor}, frame_);
    factor_ = copyOut(graph_, "factor", result.factor);
    shortening_ = importOutput(graph_, tiles);
    fg::PassBuilder pass = graph_.compute("floats of bits", shaders::floatBits);
    pass.sample("source", result.shortening).dispatch(extent);
    graph_.exported(pass.store("target", shortening_), fg::vk::kReadable);
    run_ = std::make_unique<fg::test::GraphRun>(device, graph_, fg::vk::ExecutorOptions{.shared = device.pipelines()});
  }

  /// @param now      `Antilag::tiles`
  /// @param steering `SteeredHistory::limits` of all tiles
  void frame(const FrameDescription& camera, const Image<glm::vec4>& now, const Image<glm::vec2>& steering) {
    run_->executor().upload(frame_, frameConstants(camera, pixels_));
    run_->fill(now_, now.pixels());
    if (steering_.valid()) run_->fill(steering_, steering.pixels());
    run_->frame();
  }
  [[nodiscard]] Image<glm::dvec4> factor() const { return readHalves(*run_, factor_, tiles_); }
  [[nodiscard]] Image<glm::dvec4> shortening() const { return readHalves(*run_, shortening_, tiles_); }

 private:
  glm::ivec2 tiles_;
  fg::Extent pixels_;
  fg::Graph graph_;
  fg::Texture steering_, now_, factor_, shortening_;
  fg::Buffer frame_;
  std::unique_ptr<fg::test::GraphRun> run_;
};

/// Sums over a window of tiles (passes/WALR.md, 3).
struct WindowSums {
  double differences = 0.0;  ///< Of this frame.
  double squares = 0.0;
  double magnitudes = 0.0;     ///< Of the differences, which bound their rounding.
  double products = 0.0;       ///< Of a tile's innovation with that of the frame before.
  double squaresBefore = 0.0;  ///< Of that of the frame before.
  double productMagnitudes = 0.0;
};

WindowSums sumsAround(glm::ivec2 tile, int radius, const Image<glm::vec4>& now, const Image<glm::vec4>& before) {
  WindowSums sums;
  for (int y = tile.y - radius; y <= tile.y + radius; ++y) {
    for (int x = tile.x - radius; x <= tile.x + radius; ++x) {
      if (!now.contains({x, y})) continue;
      const double innovation = now[{x, y}].x, last = before[{x, y}].x;
      sums.differences += innovation;
      sums.squares += now[{x, y}].y;
      sums.magnitudes += std::abs(innovation);
      sums.products += innovation * last;
      sums.productMagnitudes += std::abs(innovation * last);
      sums.squaresBefore += last * last;
    }
  }
  return sums;
}

/// Adds what the previous frame has stored: its antilag factor, and cube roots of the sums.
void addEarlier(WindowSums& sums, const glm::dvec4& stored) {
  const double counted = 1.0 - std::clamp(stored.x, 0.0, 1.0), kept = 0.875;
  sums.products = counted * (sums.products + kept * std::pow(stored.z, 3.0));
  sums.productMagnitudes = counted * (sums.productMagnitudes + kept * std::pow(std::abs(stored.z), 3.0));
  sums.squaresBefore = counted * (sums.squaresBefore + kept * std::pow(stored.w, 3.0));
}

/// The least antilag factor.
double leastAtRest(const WindowSums& sums, double before) {
  if (sums.squaresBefore == 0.0) return 0.0;
  const double frames = std::max(1.0 - before, 1.0) * kMaxHistory + 1.0;
  const double slope = sums.products / sums.squaresBefore;
  const double steered = slope > 0.0 ? frames * (1.0 - 2.0 * std::min(8.0 / frames, 1.0) * slope) : frames + 1.0;
  return 1.0 - std::clamp((steered - 1.0) / kMaxHistory, 1.0, double(kRestFactor));
}

double changeOfLight(const WindowSums& sums, const AntilagSettings& settings) {
  const double score = std::abs(sums.differences) / std::sqrt(sums.squares);
  return std::clamp((score - settings.scoreLow) / (settings.scoreHigh - settings.scoreLow), 0.0, 1.0);
}

double expectedFactor(double ofChange, double least, double before) {
  if (least >= 0.0) return std::max(ofChange, least);
  const double ending = std::min(4.0 * ofChange, 1.0);
  const double longer = (1.0 - ending) * (1.0 - least) + ending;
  return std::max(1.0 - (1.0 - ofChange) * longer, before - 1.0 / kMaxHistory);
}

constexpr double kFloats = 16.0 * 0x1p-24;  ///< Relative rounding of a window's sums, and of what follows from them.

/// Holds one tile of a frame against a calculation in double precision.
/// @param stored   what the frame before has stored
/// @param steering limits of the tile
void expectTile(const WindowSums& sums, bool still, const glm::dvec4& stored, const glm::dvec2& steering,
                const glm::dvec4& factor, double shortening) {
  // Cube roots are stored as halves (cube_roots.glsl).
  const double rounding = 1.5 * std::exp2(-10.0);
  EXPECT_NEAR(std::pow(factor.z, 3.0), sums.products,
              rounding * std::abs(sums.products) + kFloats * sums.productMagnitudes);
  EXPECT_NEAR(std::pow(factor.w, 3.0), sums.squaresBefore, (rounding + kFloats) * sums.squaresBefore);
  const AntilagSettings settings;
  const double longer = still ? leastAtRest(sums, stored.x) : 0.0;
  const double expected = expectedFactor(changeOfLight(sums, settings), longer < 0.0 ? longer : steering.x, stored.x);
  // The slope is multiplied by 16 at most, in units of frames of which there are 8; the change by 4 x 5 + 6.
  const double ofSlope =
      sums.squaresBefore > 0.0 ? 2.0 * kFloats * (1.0 + sums.productMagnitudes / sums.squaresBefore) : 0.0;
  const double ofChange =
      26.0 * kFloats * (4.0 + sums.magnitudes / std::sqrt(sums.squares)) / (settings.scoreHigh - settings.scoreLow);
  EXPECT_NEAR(factor.x, expected, std::exp2(-11.0) * std::max(std::abs(expected), 0.125) + ofSlope + ofChange);
  // Halves of floats that differ by 1.
  const double shorter = factor.x < -1.0 ? factor.x + 1.0 : steering.y;
  EXPECT_NEAR(shortening, shorter, std::exp2(-10.0) * std::max(std::abs(factor.x), 0.125));
}

// Columns of tiles differ in how far successive innovations agree, from opposite ones to equal ones, and rows in how
// far another pass shortens history. At last, the light changes now and then.
TEST_F(HistoryAtRest, AntilagAgreesWithDoublePrecision) {
  const glm::ivec2 tiles(12, 5);
  constexpr std::uint32_t kRadius = 1, kFrames = 76, kStill = 52, kMoving = 30;
  for (const bool steered : {false, true}) {
    SCOPED_TRACE(steered ? "steered" : "not steered");
    AntilagRun run(device(), tiles, steered, kRadius);
    std::mt19937 random(3);
    std::normal_distribution<double> noise;
    Image<glm::vec4> before(tiles);
    Image<glm::dvec4> stored(tiles);
    Image<glm::vec2> steering(tiles);
    if (steered) reference::forEachPixel(tiles, [&](glm::ivec2 t) { steering[t] = {0.2F * float(t.y), 0.25F}; });
    double longest = 0.0, changed = 0.0;
    for (std::uint32_t i = 0; i < kFrames; ++i) {
      SCOPED_TRACE("frame " + std::to_string(i));
      const bool changes = i >= kStill && i % 8 == 0;
      Image<glm::vec4> now(tiles);
      reference::forEachPixel(tiles, [&](glm::ivec2 t) {
        const double agreement = double(t.x - 8) / 8.0;
        const double innovation = agreement * before[t].x + std::sqrt(1.0 - agreement * agreement) * noise(random);
        now[t] = changes ? glm::vec4(innovation + 0.9, 1.0, 0.0, 64.0) : glm::vec4(innovation, 100.0, 0.0, 64.0);
      });
      // The camera jitters, and moves in one frame by a 40th of a pixel.
      const glm::ivec2 size = tiles * kAntilagTile;
      const double step = i == kMoving ? 2.0 / 40.0 / double(size.y) : 0.0;
      run.frame(jittered(cameraAt({step, 0.0, 0.0}, {}, size, i), i), now, steering);
      const Image<glm::dvec4> factor = run.factor(), shortening = run.shortening();
      reference::forEachPixel(tiles, [&](glm::ivec2 t) {
        SCOPED_TRACE(std::to_string(t.x) + ", " + std::to_string(t.y));
        WindowSums sums = sumsAround(t, int(kRadius), now, before);
        addEarlier(sums, stored[t]);
        expectTile(sums, i != kMoving, stored[t], steering[t], factor[t], shortening[t].x);
        longest = std::max(longest, -factor[t].x);
        changed += changes && factor[t].x > 0.05 && factor[t].x < 0.95 ? 1.0 : 0.0;
        stored[t] = factor[t];
      });
      before = now;
    }
    EXPECT_EQ(longest, kRestFactor - 1.0);  // Some tiles reach the longest history.
    EXPECT_GT(changed, 20.0);
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

/// Which light is denoised.
enum class Kind { Diffuse, Specular };
constexpr std::array kKinds{Kind::Diffuse, Kind::Specular};
InputConventions conventionsOf(Kind kind) {
  return {.specular = kind == Kind::Specular};
}
std::string nameOf(Kind kind) {
  return kind == Kind::Specular ? "specular light" : "diffuse light";
}

/// Rough surfaces, which reflect what is near.
HostFrame frameOf(Kind kind, const HostFrame& frame) {
  return kind == Kind::Specular ? asSpecular(frame, 1.0, 0.5) : frame;
}

/// A camera that stands still, and jitters.
HostFrame stillFrame(Kind kind, const Scene& scene, std::uint32_t i, double light = 1.0,
                     Noise noise = Noise::Exponential) {
  const FrameDescription camera = jittered(cameraAt(cameraPosition(0.0), cameraPosition(0.0), kSize, i), i);
  const Light scaled = [light](glm::dvec3 point, glm::dvec3 normal) { return light * smoothLight(point, normal); };
  return frameOf(kind, renderFrame(scene, camera, kSize, scaled, noise));
}

/// `walr` with a longer history at rest, and without.
struct Runs {
  Runs(const fg::test::TestDevice& device, Kind light)
      : kind(light),
        atRest(device, *longer, kSize, conventionsOf(light)),
        asInMotion(device, *same, kSize, conventionsOf(light)) {}
  /// The errors of both in one frame after another.
  std::array<double, 2> errors(const Scene& scene, std::uint32_t i, double light = 1.0) {
    const HostFrame frame = stillFrame(kind, scene, i, light), truth = stillFrame(kind, scene, i, light, Noise::None);
    return {surfaceError(atRest.frame(frame), truth), surfaceError(asInMotion.frame(frame), truth)};
  }
  void skip(const Scene& scene, std::uint32_t frames) {
    for (std::uint32_t i = 0; i < frames; ++i) {
      const HostFrame frame = stillFrame(kind, scene, i);
      static_cast<void>(atRest.frame(frame));
      static_cast<void>(asInMotion.frame(frame));
    }
  }
  Kind kind;
  std::unique_ptr<Denoiser> longer = walrAtRest("6"), same = walrAtRest("1");
  DenoiserRun atRest, asInMotion;
};

constexpr std::uint32_t kGrown = 56;  ///< Frames after which history has its full length.

// Noise of mean light falls with the root of the history length, at most to the root of 1/6; errors of the fits stay.
// Measured: .69 and .64 of diffuse light, .57 and .63 of specular light.
TEST_F(HistoryAtRest, TakesNoiseFromAStillPicture) {
  for (const Kind kind : kKinds) {
    for (const Scene& scene : {flatWall(), thinBars()}) {
      SCOPED_TRACE(nameOf(kind));
      Runs runs(device(), kind);
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
}

// Light that changes at once ends the longer history. Measured: no frame errs by .3 % more.
TEST_F(HistoryAtRest, FollowsALightThatChanges) {
  for (const Kind kind : kKinds) {
    SCOPED_TRACE(nameOf(kind));
    Runs runs(device(), kind);
    runs.skip(flatWall(), kGrown);
    for (std::uint32_t i = kGrown; i < kGrown + 8; ++i) {
      SCOPED_TRACE("frame " + std::to_string(i - kGrown) + " after the change");
      const auto [withRest, without] = runs.errors(flatWall(), i, 0.25);
      EXPECT_LT(withRest, 1.02 * without);
    }
  }
}

// A bright spot that wanders over the wall ends the longer history where it is. Measured: 1.00 and 1.07; 1.50 of
// diffuse light by innovations of quads in 11 x 11 tiles.
TEST_F(HistoryAtRest, FollowsALightThatMoves) {
  for (const Kind kind : kKinds) {
    SCOPED_TRACE(nameOf(kind));
    Runs runs(device(), kind);
    double before = 0.0, after = 0.0;
    for (std::uint32_t i = 0; i < kGrown + 8; ++i) {
      const FrameDescription camera = jittered(cameraAt(cameraPosition(0.0), cameraPosition(0.0), kSize, i), i);
      const Light spot = [i](glm::dvec3 point, glm::dvec3 /*normal*/) {
        const glm::dvec2 offset = glm::dvec2(point) - glm::dvec2(0.02 * (double(i) - 40.0), 0.0);
        return glm::dvec3(0.5 + 4.0 * std::exp(-glm::dot(offset, offset) / 0.3));
      };
      const HostFrame frame = frameOf(kind, renderFrame(flatWall(), camera, kSize, spot, Noise::Exponential));
      const HostFrame truth = frameOf(kind, renderFrame(flatWall(), camera, kSize, spot, Noise::None));
      const double withRest = surfaceError(runs.atRest.frame(frame), truth);
      const double without = surfaceError(runs.asInMotion.frame(frame), truth);
      if (i < kGrown) continue;
      before += without;
      after += withRest;
    }
    EXPECT_LT(after, 1.1 * before);
  }
}

TEST_F(HistoryAtRest, LeavesMovingFramesAsTheyAre) {
  for (const Kind kind : kKinds) {
    SCOPED_TRACE(nameOf(kind));
    std::vector<HostFrame> frames;
    for (const HostFrame& frame : movingFrames(stairs(), kSize, 12)) frames.push_back(frameOf(kind, frame));
    std::unique_ptr<Denoiser> longer = walrAtRest("6", false), same = walrAtRest("1", false);
    DenoiserRun atRest(device(), *longer, kSize, conventionsOf(kind));
    DenoiserRun asInMotion(device(), *same, kSize, conventionsOf(kind));
    EXPECT_TRUE(std::ranges::equal(denoised(atRest, frames).pixels(), denoised(asInMotion, frames).pixels()));
  }
}

}  // namespace
}  // namespace walr::test::history_at_rest_test
