// WALR's histories when the camera jumps, a frame is lost, pixels are jittered, exposure changes or the scene is still.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "tests/passes/comparison.h"
#include "tests/passes/reference/walr.h"
#include "tests/passes/stage_checks.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::walr_history_test {
namespace {

using reference::HostFrame;

constexpr glm::ivec2 kSize(66, 50);
const glm::dvec3 kConstant(0.75, 0.5, 1.25);

glm::dvec3 constantLight(glm::dvec3 /*point*/, glm::dvec3 /*normal*/) {
  return kConstant;
}

HostFrame movingFrame(const Scene& scene, double time, double previousTime, std::uint32_t index) {
  return renderFrame(scene, cameraAt(cameraPosition(time), cameraPosition(previousTime), kSize, index), kSize);
}

void scaleLight(HostFrame& frame, double scale) {
  for (glm::dvec3& l : frame.lighting.pixels())
    for (int c = 0; c < 3; ++c) l[c] = reference::roundToHalf(l[c] * scale);
}

class WalrHistoryTest : public fg::test::GpuTest {
 protected:
  /// Both presets agree with the reference.
  void expectFrames(const std::vector<HostFrame>& frames) const {
    for (const WalrPaperSettings& settings : {robustWalr(), paperWalr()}) {
      SCOPED_TRACE(settings.regression.storage == MomentStorage::Centred16 ? "robust" : "paper");
      expectSequence(device(), frames, settings);
    }
  }
};

TEST_F(WalrHistoryTest, StagesAgreeWithTheReferenceAcrossACameraCut) {
  for (const Scene& scene : {sphere(), stairs()}) {
    std::vector<HostFrame> frames{movingFrame(scene, 0, -1, 0), movingFrame(scene, 1, 0, 1)};
    frames.push_back(movingFrame(scene, 12, 1, 2));
    expectFrames(frames);
  }
}

TEST_F(WalrHistoryTest, StagesAgreeWithTheReferenceWhenAFrameIsSkipped) {
  for (const Scene& scene : {sphere(), thinBars()})
    expectFrames({movingFrame(scene, 0, -1, 0), movingFrame(scene, 1, 0, 1), movingFrame(scene, 3, 1, 3)});
}

/// Settings of anti-aliasing under jitter, each of which selects another shader or other taps. Without the share of
/// accumulated light, which would steer the antilag factor (many_samples_test.cpp): the reference here does not.
std::vector<AnyWalr> jitteredSettings() {
  WalrPaperSettings surfaces = robustWalr();
  surfaces.antialiasing.pixelArea = false;
  WalrPaperSettings apart = robustWalr();
  apart.antialiasing.thresholds.normalThreshold = 0.4F;  // Makes anti-aliasing do its own reprojection.
  apart.antialiasing.clipRadius = 2;
  WalrSettings packedSurfaces = walrWithoutShare();
  packedSurfaces.antialiasing.pixelArea = false;
  WalrSettings packedApart = walrWithoutShare();
  packedApart.antialiasing.thresholds.normalThreshold = 0.4F;
  return {robustWalr(), paperWalr(), surfaces, apart, walrWithoutShare(), packedSurfaces, packedApart};
}

TEST_F(WalrHistoryTest, StagesAgreeWithTheReferenceUnderJitter) {
  for (const AnyWalr& settings : jitteredSettings()) {
    for (const Scene& scene : {thinBars(), skyBesideSurface()})
      expectSequence(device(), jitteredFrames(scene, kSize), settings);
  }
}

TEST_F(WalrHistoryTest, StagesAgreeWithTheReferenceWhenExposureChangesBy256) {
  for (const double scale : {0x1p8, 0x1p-8}) {
    std::vector<HostFrame> frames;
    for (std::uint32_t i = 0; i < 3; ++i) frames.push_back(movingFrame(bumpyWall(0.1), i, i - 1.0, i));
    scaleLight(frames.back(), scale);
    expectFrames(frames);
  }
}

/// Settings with antilag, each of which selects another shader of the accumulation.
std::vector<WalrPaperSettings> responsiveSettings() {
  WalrPaperSettings plane = robustWalr();
  plane.accumulation.antilag.enabled = true;
  WalrPaperSettings depth = plane;
  depth.accumulation.rejection = depth.antialiasing.rejection = HistoryRejection::Depth;
  depth.accumulation.historyFilter = HistoryFilter::Bicubic;
  WalrPaperSettings none = plane;
  none.accumulation.rejection = none.antialiasing.rejection = HistoryRejection::None;
  WalrPaperSettings apart = plane;
  apart.antialiasing.thresholds.normalThreshold = 0.4F;  // Makes anti-aliasing do its own reprojection.
  apart.accumulation.antilag.radius = 0;
  return {plane, depth, none, apart};
}

/// Largest antilag factor after the light has changed in the last frame.
double antilagAfterChange(const fg::test::TestDevice& device, const WalrPaperSettings& settings,
                          const SceneDescription& scene, double change) {
  WalrRun run(device, kSize, settings, {}, true, scene);
  double largest = 0.0;
  for (std::uint32_t i = 0; i < 4; ++i) {
    HostFrame frame = renderStill(bumpyWall(0.1), kSize, i);
    if (i == 3) scaleLight(frame, change);
    const WalrStages stages = run.frame(frame);
    if (i == 3) largest = *std::ranges::max_element(stages.antilag.pixels());
  }
  return largest;
}

TEST_F(WalrHistoryTest, StagesAgreeWithTheReferenceWhereTheLightChanges) {
  for (const WalrPaperSettings& settings : responsiveSettings()) {
    SCOPED_TRACE("rejection " + std::to_string(int(settings.accumulation.rejection)) + ", radius " +
                 std::to_string(settings.accumulation.antilag.radius));
    for (const bool cameraAlone : {false, true}) {
      // The light changes in the last frame but one, so antilag shortens history in the last one.
      std::vector<HostFrame> frames;
      for (std::uint32_t i = 0; i < 5; ++i) frames.push_back(movingFrame(bumpyWall(0.1), i, i - 1.0, i));
      for (std::size_t i = 3; i < 5; ++i) scaleLight(frames[i], 0.25);
      for (HostFrame& frame : frames) frame.scene.objectMotion = !cameraAlone;
      expectSequence(device(), frames, settings);
    }
    std::vector<HostFrame> still;
    for (std::uint32_t i = 0; i < 4; ++i) {
      still.push_back(renderStill(thinBars(), kSize, i));
      still.back().scene = {.cameraMotion = false, .objectMotion = false, .jitter = false};
      if (i >= 2) scaleLight(still.back(), 4.0);
    }
    expectSequence(device(), still, settings);
  }
}

TEST_F(WalrHistoryTest, AntilagFollowsTheLight) {
  const WalrPaperSettings settings = responsiveSettings().front();
  // A fall to a quarter is many standard errors of a window; unchanged light differs by less than a few.
  EXPECT_EQ(antilagAfterChange(device(), settings, {}, 0.25), 1.0);
  EXPECT_LT(antilagAfterChange(device(), settings, {}, 1.0), 0.5);
}

TEST_F(WalrHistoryTest, StagesAgreeWithTheReferenceWithMotionFromTheCameraAlone) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  WalrPaperSettings settings = robustWalr();
  // Makes anti-aliasing do its own reprojection, so motion is not rounded.
  settings.antialiasing.thresholds.normalThreshold = 0.4F;
  for (const Scene& scene : {sphere(), stairs()}) {
    std::vector<HostFrame> frames;
    for (std::uint32_t i = 1; i < 4; ++i) {
      const FrameDescription camera = cameraAt(cameraPosition(i), cameraPosition(i - 1.0), kSize, i);
      frames.push_back(renderFrame(scene, jittered(camera, i), kSize));
      frames.back().scene.objectMotion = false;
      for (glm::dvec3& motion : frames.back().motion.pixels()) motion = glm::dvec3(kNaN);  // Must not be read.
    }
    expectSequence(device(), frames, settings);
  }
}

/// Frames in which a panel comes nearer while the camera moves.
std::vector<HostFrame> approaching(double step, InputConventions::MotionDepth motionDepth) {
  std::vector<HostFrame> frames;
  for (std::uint32_t i = 0; i < 3; ++i) {
    frames.push_back(movingFrame(approachingPanel(i, step), i, i - 1.0, i));
    frames.back().conventions.motionDepth = motionDepth;
    if (motionDepth == InputConventions::MotionDepth::Given) continue;
    forgetMotionDepth(frames.back());
  }
  return frames;
}

TEST_F(WalrHistoryTest, StagesAgreeWithTheReferenceWhereDepthIsFound) {
  std::vector<WalrPaperSettings> all = responsiveSettings();
  // Curved surfaces differ from their planes by more than this, so that the tap of which depth is taken decides.
  all.push_back(all.front());
  all.back().accumulation.thresholds.planeTolerance = all.back().antialiasing.thresholds.planeTolerance = 1e-4F;
  for (const WalrPaperSettings& settings : all) {
    SCOPED_TRACE("rejection " + std::to_string(int(settings.accumulation.rejection)) + ", radius " +
                 std::to_string(settings.accumulation.antilag.radius));
    for (const double step : {0.04, 0.2})
      expectSequence(device(), approaching(step, InputConventions::MotionDepth::Found), settings);
    std::vector<HostFrame> still;
    for (std::uint32_t i = 0; i < 3; ++i) {
      still.push_back(movingFrame(sphere(), i, i - 1.0, i));
      still.back().conventions.motionDepth = InputConventions::MotionDepth::Found;
    }
    expectSequence(device(), still, settings);
  }
}

/// Mean history length on the panel in the third frame.
double historyOnPanel(const fg::test::TestDevice& device, double step, InputConventions::MotionDepth motionDepth) {
  const std::vector<HostFrame> frames = approaching(step, motionDepth);
  WalrRun run(device, kSize, robustWalr(), frames.front().conventions);
  WalrStages stages;
  for (const HostFrame& frame : frames) stages = run.frame(frame);
  double sum = 0.0;
  int pixels = 0;
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    if (frames.back().objectId[p] != 1) return;
    sum += stages.accumulated[p].w;
    ++pixels;
  });
  return sum / pixels;
}

// A panel that comes nearer by more than the plane tolerance keeps its history if its depth is found, unless it comes
// nearer by more than a tenth a frame, and has none if it is taken for a still surface.
TEST_F(WalrHistoryTest, FoundDepthKeepsTheHistoryOfWhatComesNearer) {
  using enum InputConventions::MotionDepth;
  const double given = historyOnPanel(device(), 0.05, Given);
  EXPECT_GT(given, 2.9);
  EXPECT_EQ(historyOnPanel(device(), 0.05, Found), given);
  EXPECT_EQ(historyOnPanel(device(), 0.05, StaticScene), 1.0);
  EXPECT_EQ(historyOnPanel(device(), 0.2, Found), 1.0);
  EXPECT_EQ(historyOnPanel(device(), 0.2, Given), historyOnPanel(device(), 0.05, Given));
}

TEST_F(WalrHistoryTest, StagesAgreeWithTheReferenceInAStillImage) {
  for (const Scene& scene : {skyBesideSurface(), thinBars()}) {
    std::vector<HostFrame> frames;
    for (std::uint32_t i = 0; i < 3; ++i) {
      frames.push_back(renderStill(scene, kSize, i));
      frames.back().scene = {.cameraMotion = false, .objectMotion = false, .jitter = false};
    }
    expectFrames(frames);
  }
}

// Everything is suddenly twice as far away, but motion does not say so. All history is rejected, and the output equals
// that of a first frame. Anti-aliasing of the preset paper only clips history and does not reject it.
TEST_F(WalrHistoryTest, AnUnannouncedCutLeavesNothingOfTheHistory) {
  for (const bool robust : {true, false}) {
    const WalrPaperSettings settings = robust ? robustWalr() : paperWalr();
    WalrRun run(device(), kSize, settings);
    for (std::uint32_t i = 0; i < 3; ++i) (void)run.frame(renderStill(flatWall(), kSize, i));
    HostFrame after = renderStill(bumpyWall(0.1), kSize, 3);
    for (double& depth : after.depth.pixels()) depth *= 2.0;
    const WalrStages cut = run.frame(after);
    WalrRun fresh(device(), kSize, settings);
    const WalrStages first = fresh.frame(after);
    EXPECT_EQ(cut.accumulated.pixels(), first.accumulated.pixels());
    if (robust) {
      EXPECT_EQ(cut.outputBits, first.outputBits);
    }
  }
}

// On a plane the image shifts by the same number of pixels everywhere. Only pixels that come in at the border have no
// history: along an axis, the shift and one more.
TEST_F(WalrHistoryTest, ASkippedFrameCostsHistoryOnlyAtTheBorder) {
  WalrRun run(device(), kSize);
  for (std::uint32_t i = 0; i < 4; ++i) (void)run.frame(movingFrame(flatWall(), i, i - 1.0, i));
  const HostFrame skipped = movingFrame(flatWall(), 5, 3, 5);
  const WalrStages stages = run.frame(skipped);
  glm::dvec2 shift(0.0);
  for (const glm::dvec3& motion : skipped.motion.pixels()) shift = glm::max(shift, glm::abs(glm::dvec2(motion)));
  int first = 0;
  for (const glm::dvec4& v : stages.accumulated.pixels()) first += v.w == 1.0 ? 1 : 0;
  const glm::dvec2 lost = (shift + 1.0) / glm::dvec2(kSize);
  EXPECT_LE(first, (lost.x + lost.y) * kSize.x * kSize.y);
  EXPECT_GT(first, 0);
}

// A still camera with jitter sees the same plane at the same place once the jitter is removed from motion: no pixel
// ever loses its history, and constant light stays constant.
TEST_F(WalrHistoryTest, JitterCostsNoHistory) {
  const WalrPaperSettings settings = robustWalr();
  WalrRun run(device(), kSize, settings);
  for (std::uint32_t i = 1; i <= 20; ++i) {
    const HostFrame frame =
        renderFrame(flatWall(), jittered(cameraAt({}, {}, kSize, i), i), kSize, constantLight, Noise::None);
    const WalrStages stages = run.frame(frame);
    const double expected = std::min(double(i), double(settings.accumulation.maxHistory));
    for (const glm::dvec4& v : stages.accumulated.pixels()) {
      EXPECT_NEAR(v.w, expected, 2.0 * reference::kHalfRoundoff * expected);
      // Every frame's store may round anew, and the mean keeps that error for as many frames as it spans.
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(v[c], kConstant[c], 2.0 * reference::kHalfRoundoff * expected * kConstant[c]);
    }
  }
}

// After a step of the light by 2^8, a mean of n samples keeps (1 - 1/n)^k of the difference after k frames. In a
// neighbourhood of one colour, variance clipping limits the distance of the anti-aliasing history to the smallest box,
// 4 / 2048 of the luma. Here the luma is at most 4 times the smallest channel.
/// A panel in front of a wall, lit differently. Its right edge leans by a pixel in eight rows.
constexpr double kPanelLight = 1.0;
constexpr double kWallLight = 0.25;
constexpr double kLean = 1.0 / 8.0;

std::optional<SceneHit> leaningPanel(glm::dvec3 origin, glm::dvec3 direction) {
  const glm::dvec3 normal(0.0, 0.0, 1.0);
  const double toPanel = (-4.0 - origin.z) / direction.z;
  const glm::dvec3 p = origin + toPanel * direction;
  const bool panel = p.x < 0.05 + kLean * p.y;
  return SceneHit{panel ? toPanel : (-6.0 - origin.z) / direction.z, normal};
}
glm::dvec3 lightOfPanel(glm::dvec3 point, glm::dvec3 /*normal*/) {
  return glm::dvec3(point.z > -5.0 ? kPanelLight : kWallLight);
}

/// Where the panel ends, mean over all rows, in pixels from the image's left side.
template <typename Pixel>
double edgeIn(const reference::Image<Pixel>& image) {
  double sum = 0.0;
  for (const Pixel& light : image.pixels()) sum += (light[0] - kWallLight) / (kPanelLight - kWallLight);
  return sum / image.size().y;
}

// An upscaler that follows needs edges where this frame's jitter puts them. Anti-aliasing leaves them there if it takes
// no history of another surface.
TEST_F(WalrHistoryTest, EdgesMoveWithTheJitter) {
  for (const bool antialiasing : {false, true}) {
    SCOPED_TRACE(antialiasing ? "with anti-aliasing" : "without anti-aliasing");
    WalrSettings settings;
    settings.antialiasing.enabled = antialiasing;
    settings.antialiasing.pixelArea = false;
    WalrRun run(device(), kSize, settings, {}, false);
    double first = 0.0;
    for (std::uint32_t i = 1; i <= 16; ++i) {
      const HostFrame frame =
          renderFrame(leaningPanel, jittered(cameraAt({}, {}, kSize, i), i), kSize, lightOfPanel, Noise::None);
      const double edge = edgeIn(run.frame(frame).output);
      if (i == 1) first = edge;
      // A sample further right finds the edge further left, and so does one further down, where the edge leans to. The
      // edge crosses pixel centres once in eight rows, so that its mean place is known to 1/16 of a pixel in both
      // frames.
      const glm::dvec2 moved(jitterAt(i) - jitterAt(1));
      EXPECT_NEAR(edge - first, -moved.x - kLean * moved.y, 2.0 / 16.0) << "frame " << i;
    }
  }
}

/// Mean of the panel's and the wall's light over the area of every pixel, from 16 x 16 points in each.
reference::Image<double> areaMeans(const FrameDescription& camera) {
  constexpr int kPoints = 16;
  reference::Image<double> sums(kSize);
  for (int i = 0; i < kPoints * kPoints; ++i) {
    FrameDescription displaced = camera;
    displaced.jitter = (glm::vec2(i % kPoints, i / kPoints) + 0.5F) / float(kPoints) - 0.5F;
    const HostFrame frame = renderFrame(leaningPanel, displaced, kSize, lightOfPanel, Noise::None);
    for (std::size_t k = 0; k < sums.pixels().size(); ++k) sums.pixels()[k] += frame.lighting.pixels()[k].r;
  }
  for (double& sum : sums.pixels()) sum /= kPoints * kPoints;
  return sums;
}

/// Root mean square error against the means over pixels' areas of the 16 frames after the first 16 of a still, jittered
/// camera.
double errorOfAreas(const fg::test::TestDevice& device, const WalrSettings& settings,
                    const reference::Image<double>& expected) {
  WalrRun run(device, kSize, settings, {}, false);
  double squares = 0.0;
  for (std::uint32_t i = 1; i <= 32; ++i) {
    const HostFrame frame =
        renderFrame(leaningPanel, jittered(cameraAt({}, {}, kSize, i), i), kSize, lightOfPanel, Noise::None);
    const reference::Image<glm::dvec4> output = run.frame(frame).output;
    for (std::size_t k = 0; i > 16 && k < output.pixels().size(); ++k) {
      const double error = output.pixels()[k].r - expected.pixels()[k];
      squares += error * error;
    }
  }
  return std::sqrt(squares / (16.0 * double(expected.pixels().size())));
}

// A mean that gives each frame a share of 1/n has 1 / (2 n - 1) of the variance of one frame: a fifth for n = 3, if
// frames were independent. Points of the jitter cover a pixel more evenly than independent ones, and clipping moves
// history by the rounding of packed light only, because a neighbourhood of both surfaces spans both lights.
TEST_F(WalrHistoryTest, JitteredEdgesBecomeMeansOverPixels) {
  const reference::Image<double> expected = areaMeans(cameraAt({}, {}, kSize, 0));
  for (const bool ownReprojection : {false, true}) {
    SCOPED_TRACE(ownReprojection ? "own reprojection" : "taps of accumulation");
    WalrSettings settings;
    if (ownReprojection) settings.antialiasing.thresholds.normalThreshold = 0.4F;
    ASSERT_EQ(settings.antialiasing.maxHistory, 3.0F);
    const double ofAreas = errorOfAreas(device(), settings, expected);
    settings.antialiasing.filterRadius = 0.5F;
    EXPECT_LT(ofAreas, errorOfAreas(device(), settings, expected)) << "a frame adds single samples";
    settings.antialiasing.pixelArea = false;
    const double ofSurfaces = errorOfAreas(device(), settings, expected);
    EXPECT_LT(ofAreas, std::sqrt(1.0 / 5.0) * ofSurfaces);
    EXPECT_GT(ofSurfaces, 0.0);
  }
}

TEST_F(WalrHistoryTest, AStepOfExposureDecaysAsTheMeanDoes) {
  WalrPaperSettings settings = robustWalr();
  settings.accumulation.maxHistory = 4.0F;
  const double n = double(settings.accumulation.maxHistory);
  WalrRun run(device(), kSize, settings);
  for (std::uint32_t i = 0; i < 16; ++i) {
    HostFrame frame = renderFrame(flatWall(), cameraAt({}, {}, kSize, i), kSize, constantLight, Noise::None);
    const double scale = i < 6 ? 1.0 : 0x1p8;
    scaleLight(frame, scale);
    const WalrStages stages = run.frame(frame);
    const double left = i < 6 ? 0.0 : std::pow(1.0 - 1.0 / n, i - 5.0) * (1.0 - 0x1p-8);
    const double roundings = 2.0 * reference::kHalfRoundoff * n;
    for (std::size_t k = 0; k < stages.output.pixels().size(); ++k) {
      for (int c = 0; c < 3; ++c) {
        const double expected = kConstant[c] * scale * (1.0 - left);
        EXPECT_NEAR(stages.accumulated.pixels()[k][c], expected, roundings * expected) << "frame " << i;
        const double filtered = stages.filtered.pixels()[k][c];
        const double box = 4.0 * 4.0 / 2048.0;
        EXPECT_NEAR(stages.output.pixels()[k][c], filtered, (box + 4.0 * reference::kHalfRoundoff) * filtered)
            << "frame " << i;
      }
    }
  }
}

}  // namespace
}  // namespace walr::test::walr_history_test
