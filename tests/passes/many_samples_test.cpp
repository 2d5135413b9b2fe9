// The share of accumulated light in walr: better input gives a better picture.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tests/passes/denoiser_run.h"
#include "tests/passes/reference/storage.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::many_samples_test {
namespace {

using reference::HostFrame;

constexpr glm::ivec2 kSize(64, 48);

/// Light with detail of a few pixels that no guide shows.
glm::dvec3 detailedLight(glm::dvec3 point, glm::dvec3 normal) {
  return smoothLight(point, normal) * (1.0 + 0.4 * std::sin(11.0 * point.x) * std::sin(9.0 * point.y));
}

/// A frame with this many samples per pixel, and without noise.
struct NoisyFrame {
  HostFrame noisy;
  HostFrame truth;
};

/// @param step scene units that the camera moves to the side in a frame
NoisyFrame frameOf(std::uint32_t index, std::uint32_t samples, double step, const Light& light) {
  const FrameDescription camera =
      cameraAt({step * index, 0.0, 0.0}, {step * (index == 0 ? 0 : index - 1), 0.0, 0.0}, kSize, index);
  const HostFrame truth = renderFrame(flatWall(), camera, kSize, light, Noise::None);
  NoisyFrame frame{.noisy = truth, .truth = truth};
  if (samples == 0) return frame;
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    double brightness = 0.0;
    for (std::uint32_t k = 0; k < samples; ++k) brightness += noiseOfSample(p, index * samples + k) / samples;
    for (int c = 0; c < 3; ++c)
      frame.noisy.lighting[p][c] = reference::roundToHalf(frame.truth.lighting[p][c] * brightness);
  });
  return frame;
}

double errorOf(const HostFrame& noisy, const HostFrame& truth) {
  reference::Image<glm::dvec4> image(kSize);
  reference::forEachPixel(kSize, [&](glm::ivec2 p) { image[p] = glm::dvec4(noisy.lighting[p], 1.0); });
  return surfaceError(image, truth);
}

using Settings = std::vector<std::pair<std::string, std::string>>;

class Method {
 public:
  Method(const fg::test::TestDevice& device, const std::string& name, const std::string& preset,
         const Settings& settings)
      : denoiser_(makeDenoiser(name)) {
    if (!preset.empty()) denoiser_->usePreset(preset);
    for (const auto& [setting, value] : settings) denoiser_->set(setting, value);
    run_ = std::make_unique<DenoiserRun>(device, *denoiser_, kSize);
  }

  double error(const NoisyFrame& frame) { return surfaceError(run_->frame(frame.noisy), frame.truth); }

 private:
  std::unique_ptr<Denoiser> denoiser_;
  std::unique_ptr<DenoiserRun> run_;
};

const Settings kWithoutAntialiasing{{"antialiasing.enabled", "off"}};

Settings with(const Settings& settings, const std::string& name, const std::string& value) {
  Settings result = settings;
  result.emplace_back(name, value);
  return result;
}

/// Frames of a moving camera.
std::vector<NoisyFrame> walk(std::uint32_t samples, const Light& light) {
  constexpr std::uint32_t kFrames = 20;
  constexpr double kStep = 0.13;  // More than a pixel.
  std::vector<NoisyFrame> frames;
  for (std::uint32_t i = 0; i < kFrames; ++i) frames.push_back(frameOf(i, samples, kStep, light));
  return frames;
}

/// Mean error of the last frames.
double lastError(const std::vector<NoisyFrame>& frames, Method&& method) {
  constexpr std::size_t kJudged = 4;
  double error = 0.0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double ofFrame = method.error(frames[i]);
    if (i + kJudged >= frames.size()) error += ofFrame / kJudged;
  }
  return error;
}

class ManySamples : public fg::test::GpuTest {
 protected:
  [[nodiscard]] Method standard(const Settings& settings = kWithoutAntialiasing) const {
    return {device(), "walr", "standard", settings};
  }
  [[nodiscard]] Method withoutShare() const { return standard(with(kWithoutAntialiasing, "blocks.residual", "off")); }
};

TEST_F(ManySamples, MakeTheErrorSmaller) {
  const auto frames = walk(1, detailedLight);
  const double one = lastError(frames, standard());
  EXPECT_LT(one, lastError(frames, withoutShare()));
  // This project's requirement: at most .8 of the error with four times as many samples, and .6 with sixteen times.
  // Only the noise halves with each factor of four. Detail that no guide shows costs noise, so that the error falls
  // less.
  EXPECT_LT(lastError(walk(4, detailedLight), standard()), 0.8 * one);
  EXPECT_LT(lastError(walk(16, detailedLight), standard()), 0.6 * one);
}

TEST_F(ManySamples, GoodLightIsNotMadeWorse) {
  const auto frames = walk(256, detailedLight);
  double input = 0.0;
  for (std::size_t i = frames.size() - 4; i < frames.size(); ++i) {
    input += errorOf(frames[i].noisy, frames[i].truth) / 4.0;
  }
  EXPECT_LT(lastError(frames, standard()), 1.03 * input);
  // Blocks alone leave out the detail, however good the light is.
  EXPECT_GT(lastError(frames, withoutShare()), 2.0 * input);
}

// Without noise, anti-aliasing keeps no history, and its result is the current frame within 1 %, of which the rounding
// of light to 9 bits is a tenth.
TEST_F(ManySamples, AntialiasingDoesNotBlurGoodLight) {
  const auto frames = walk(0, detailedLight);
  const double without = lastError(frames, standard());
  EXPECT_LT(lastError(frames, standard({})), 1.01 * without);
  // With its longest history, three frames, two of three parts have been reprojected.
  EXPECT_GT(lastError(frames, standard({{"blocks.residual-antialiasing", "1"}})), 1.3 * without);
}

// The requirement of MakeTheErrorSmaller, with anti-aliasing.
TEST_F(ManySamples, MakeTheErrorSmallerWithAntialiasing) {
  const double one = lastError(walk(1, detailedLight), standard({}));
  EXPECT_LT(lastError(walk(4, detailedLight), standard({})), 0.8 * one);
  EXPECT_LT(lastError(walk(16, detailedLight), standard({})), 0.6 * one);
}

TEST_F(ManySamples, HistoryIsShortWhereItBlurs) {
  const auto frames = walk(0, detailedLight);
  const double steered = lastError(frames, standard());
  // Of a frame's detail a history of 8 frames keeps 1/8 unblurred and one of 2 frames a half. Bilinear reprojection
  // takes as much from a frame again with each further frame, so that the error is at least halved.
  EXPECT_LT(steered, 0.5 * lastError(frames, standard(with(kWithoutAntialiasing, "blocks.innovation-gain", "0"))));
}

TEST_F(ManySamples, HistoryIsLongWhereThereIsOnlyNoise) {
  const auto frames = walk(1, smoothLight);
  // `AccumulatedShareSettings::innovationBias` lets noise shorten history by 1 / 1.28. This raises the error by its
  // root, 1.13.
  EXPECT_LT(lastError(frames, standard()), 1.13 * lastError(frames, withoutShare()));
}

// A camera that stands still: the mean error of the accumulated light falls with the root of the number of frames, for
// ever. What the fits miss stays. The best mixture of both has the error e1 e2 / sqrt(e1^2 + e2^2).
TEST_F(ManySamples, ErrorsFallForAsLongAsTheCameraStandsStill) {
  const Settings longest{{"accumulation.max-history", "255"}};
  const Settings noLonger = with(longest, "accumulation.rest-factor", "1");
  const Settings blocks = with(with(noLonger, "antialiasing.enabled", "off"), "accumulation.storage", "half");
  Method mixture = standard(blocks), mean(device(), "accumulate", "", longest),
         fits = standard(with(blocks, "blocks.residual", "off"));
  for (std::uint32_t i = 0; i < 256; ++i) {
    const NoisyFrame frame = frameOf(i, 1, 0.0, detailedLight);
    const double mixed = mixture.error(frame), accumulated = mean.error(frame), predicted = fits.error(frame);
    if (i < 15 || (i & (i + 1)) != 0) continue;
    const double best = accumulated * predicted / std::hypot(accumulated, predicted);
    // Noise may shorten history by 1 / 1.28 (innovationBias), which raises the error of accumulated light by
    // its root, 1.13, and that of the mixture by less.
    EXPECT_LT(mixed, 1.1 * best) << "frame " << i;
    // In the last frame the two are level, and the mixture differs by .08 % between lavapipe and an NVIDIA H200.
    EXPECT_LT(mixed, 1.001 * accumulated) << "frame " << i;
  }
}

}  // namespace
}  // namespace walr::test::many_samples_test
