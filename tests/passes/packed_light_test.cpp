// Packed light in 32 bits: the precision of the packing, the mean of its rounding, and its use by the stages.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <glm/common.hpp>

#include "passes/regression/block_regression.h"
#include "tests/passes/block_filter.h"
#include "tests/passes/comparison.h"
#include "tests/passes/filter_run.h"
#include "tests/passes/shaders.h"
#include "tests/passes/stage_checks.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::packed_light_test {
namespace {

using reference::HostFrame;
using reference::Image;

/// A packing, as round_light.comp selects it.
struct Packing {
  const char* name;
  std::uint32_t key;
  int mantissaBits;
};
constexpr Packing kAccumulated{"accumulated", 0x100, reference::kAccumulatedBits};
constexpr Packing kFiltered{"filtered", 0x101, reference::kFilteredBits};
constexpr Packing kResolved{"resolved", 0x102, reference::kResolvedBits};
constexpr Packing kPassThrough{"pass-through", 0, reference::kPassThroughBits};

/// Number of values that a random number of a shader has.
constexpr int kLevels = 256;

/// Number of pixels that round the same light, each with a random number of its own.
constexpr int kRandomNumbers = 4096;

/// Range and mean of a light's rounded values over the random numbers.
struct Rounded {
  glm::dvec4 least{std::numeric_limits<double>::infinity()};
  glm::dvec4 most{-std::numeric_limits<double>::infinity()};
  glm::dvec4 mean{0.0};
};

class PackedLight : public fg::test::GpuTest {
 protected:
  /// Round lights with all random numbers.
  [[nodiscard]] std::vector<Rounded> round(const Packing& packing, const std::vector<glm::dvec4>& lights,
                                           std::uint32_t longest = 3, std::uint32_t frame = 0) const {
    const fg::Extent extent{kRandomNumbers, static_cast<std::uint32_t>(lights.size())};
    std::vector<float> texels;
    for (const glm::dvec4& light : lights)
      for (int i = 0; i < kRandomNumbers; ++i)
        for (int c = 0; c < 4; ++c) texels.push_back(static_cast<float>(light[c]));
    const std::vector<float> result = run(extent, texels, packing.key, false, {frame, longest});
    std::vector<Rounded> rounded(lights.size());
    for (std::size_t i = 0; i < result.size() / 4; ++i) {
      const glm::dvec4 v(result[4 * i], result[4 * i + 1], result[4 * i + 2], result[4 * i + 3]);
      Rounded& r = rounded[i / kRandomNumbers];
      r.least = glm::min(r.least, v);
      r.most = glm::max(r.most, v);
      r.mean += v / double(kRandomNumbers);
    }
    return rounded;
  }

  /// The four random numbers of every pixel of an image, less their mean 1/2 and in units of their standard deviation.
  [[nodiscard]] std::vector<glm::dvec4> standardizedNumbers(int size, std::uint32_t key, std::uint32_t frame) const {
    const fg::Extent extent{static_cast<std::uint32_t>(size), static_cast<std::uint32_t>(size)};
    const std::vector<float> texels(std::size_t(4) * size * size);
    const std::vector<float> numbers = run(extent, texels, key, true, {frame, 1});
    const double deviation = std::sqrt((1.0 - 1.0 / (kLevels * kLevels)) / 12.0);
    std::vector<glm::dvec4> standardized;
    for (std::size_t i = 0; i < numbers.size(); i += 4) {
      const glm::dvec4 v(numbers[i], numbers[i + 1], numbers[i + 2], numbers[i + 3]);
      standardized.push_back((v - 0.5) / deviation);
    }
    return standardized;
  }

 private:
  /// Push constants of round_light.comp.
  struct Constants {
    std::uint32_t frame;
    std::uint32_t longest;
  };

  /// Run round_light.comp on RGBA texels.
  [[nodiscard]] std::vector<float> run(fg::Extent extent, const std::vector<float>& texels, std::uint32_t key,
                                       bool numbers, const Constants& constants) const {
    const fg::TextureDesc floats{VK_FORMAT_R32G32B32A32_SFLOAT, extent};
    fg::Graph graph;
    const fg::Texture source = graph.import("source", floats, fg::vk::kUploaded);
    fg::Texture target = graph.import("target", floats, fg::vk::kOverwritable);
    fg::PassBuilder pass = graph.compute("round", shaders::roundLight);
    pass.sample("source", source)
        .specialize("kKey", key)
        .specialize("kNumbers", numbers)
        .constants(constants)
        .dispatch(extent);
    target = pass.store("target", target);
    graph.exported(target, fg::vk::kReadable);
    fg::test::GraphRun graphRun(device(), graph, {.shared = device().pipelines()});
    graphRun.fill(source, texels);
    graphRun.frame();
    return graphRun.texels<float>(target);
  }
};

double brightest(glm::dvec4 light) {
  return std::max({light.r, light.g, light.b});
}

double single(double value) {
  return double(static_cast<float>(value));
}

/// Light of all magnitudes that half precision can hold, grey and saturated.
std::vector<glm::dvec4> lightsOfAllMagnitudes() {
  std::vector<glm::dvec4> lights;
  const glm::dvec3 colours[] = {{1.0, 0.83, 0.59}, {0.021, 1.0, 0.37}, {0.0013, 0.0, 1.0}};
  int i = 0;
  for (double magnitude = 3e-7; magnitude < 6e4; magnitude *= 1.61) {
    const glm::dvec3 light = magnitude * colours[i++ % 3];
    lights.emplace_back(single(light.r), single(light.g), single(light.b), 1.0);
  }
  return lights;
}

/// Expects stochastic rounding: every result is `low` or `low + step`, and their mean is `value` within five standard
/// deviations of a mean of so many trials, plus half the distance between random numbers.
void expectStochasticRounding(const Rounded& actual, int channel, double value, double low, double step) {
  const double share = (value - low) / step;
  const double deviation = step * std::sqrt(std::max(share * (1.0 - share), 0.0) / kRandomNumbers);
  EXPECT_GE(actual.least[channel], low);
  EXPECT_LE(actual.most[channel], share == 0.0 ? low : low + step);
  EXPECT_NEAR(actual.mean[channel], value, 5.0 * deviation + 0.5 / kLevels * step + kRandomNumbers * 0x1p-52 * value);
}

TEST_F(PackedLight, ColoursAreRoundedToNeighboursWithoutBias) {
  const std::vector<glm::dvec4> lights = lightsOfAllMagnitudes();
  for (const Packing& packing : {kAccumulated, kFiltered, kResolved}) {
    const std::vector<Rounded> rounded = round(packing, lights);
    for (std::size_t i = 0; i < lights.size(); ++i) {
      const double step = reference::packedStep(brightest(lights[i]), packing.mantissaBits);
      for (int c = 0; c < 3; ++c) {
        SCOPED_TRACE(std::string(packing.name) + ": " + std::to_string(lights[i][c]) + " of " +
                     std::to_string(brightest(lights[i])));
        expectStochasticRounding(rounded[i], c, lights[i][c], std::floor(lights[i][c] / step) * step, step);
      }
    }
  }
}

// The error is at most half a step of 9 bits. The step doubles where the brightest channel exceeds 511 steps, so the
// brightest channel is always above 255.5 steps, and half a step is at most 1/511 of it.
TEST_F(PackedLight, ThePassThroughIsRoundedToNearest) {
  const std::vector<glm::dvec4> lights = lightsOfAllMagnitudes();
  const std::vector<Rounded> rounded = round(kPassThrough, lights);
  constexpr double kSmallestNormal = 0x1p-16;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    SCOPED_TRACE(brightest(lights[i]));
    EXPECT_EQ(rounded[i].least, rounded[i].most);
    for (int c = 0; c < 3; ++c) {
      const double tolerance = reference::passThroughError(lights[i][c], brightest(lights[i]));
      EXPECT_NEAR(rounded[i].most[c], lights[i][c], tolerance);
      EXPECT_LE(tolerance, std::max(brightest(lights[i]), kSmallestNormal) / 511.0);
    }
  }
  const double largest = reference::largestPacked(reference::kPassThroughBits);
  const std::vector<Rounded> limits = round(kPassThrough, {{reference::kLargestHalf, 1e30, -1.0, 1.0}});
  EXPECT_EQ(glm::dvec3(limits[0].least), glm::dvec3(largest, largest, 0.0));
  EXPECT_EQ(limits[0].most, limits[0].least);
}

TEST_F(PackedLight, RoundedValuesAreRoundedToThemselves) {
  for (const Packing& packing : {kAccumulated, kFiltered, kResolved, kPassThrough}) {
    std::vector<glm::dvec4> lights;
    const int most = (1 << packing.mantissaBits) - 1;
    for (int exponent = -15; exponent <= 16; ++exponent) {
      const double step = std::ldexp(1.0, exponent - packing.mantissaBits);
      lights.emplace_back(most * step, 0.0, step, 2.0);
      lights.emplace_back((most / 2 + 1) * step, 3.0 * step, (most / 2) * step, 1.0);
    }
    lights.emplace_back(0.0, 0.0, 0.0, 1.0);
    const std::vector<Rounded> rounded = round(packing, lights);
    for (std::size_t i = 0; i < lights.size(); ++i) {
      EXPECT_EQ(rounded[i].least, lights[i]) << packing.name << ' ' << i;
      EXPECT_EQ(rounded[i].most, lights[i]) << packing.name << ' ' << i;
    }
  }
}

// Filtered and anti-aliased light are within the format before they are packed.
TEST_F(PackedLight, ValuesBeyondTheFormatAreClamped) {
  const Packing& packing = kAccumulated;
  const double largest = reference::largestPacked(packing.mantissaBits);
  const double smallest = std::ldexp(1.0, -15 - packing.mantissaBits);
  const std::vector<Rounded> rounded =
      round(packing, {{largest, largest, 1.0, 1.0},
                      {reference::kLargestHalf, 1e30, std::numeric_limits<double>::infinity(), 1.0},
                      {-1.0, -0.0, -1e30, 1.0},
                      {0x1p-140, 0x1p-126, 0.5 * smallest, 1.0}});
  EXPECT_EQ(glm::dvec2(rounded[0].least), glm::dvec2(largest));
  EXPECT_EQ(glm::dvec3(rounded[1].least), glm::dvec3(largest));
  EXPECT_EQ(glm::dvec3(rounded[1].most), glm::dvec3(largest));
  EXPECT_EQ(glm::dvec3(rounded[2].least), glm::dvec3(0.0));
  EXPECT_EQ(glm::dvec3(rounded[2].most), glm::dvec3(0.0));
  EXPECT_EQ(glm::dvec2(rounded[3].most), glm::dvec2(0.0));
  expectStochasticRounding(rounded[3], 2, 0.5 * smallest, 0.0, smallest);
}

TEST_F(PackedLight, HistoryLengthsOfAccumulationAreRoundedToNeighboursWithoutBias) {
  std::vector<glm::dvec4> lights;
  for (int i = 0; i <= 16; ++i) lights.emplace_back(1.0, 1.0, 1.0, i);
  for (double count = 1.0; count < 255.0; count *= 1.137) lights.emplace_back(1.0, 1.0, 1.0, single(count));
  lights.emplace_back(1.0, 1.0, 1.0, 255.0);
  const std::vector<Rounded> rounded = round(kAccumulated, lights);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    SCOPED_TRACE(lights[i].a);
    const double step = reference::packedCountStep(lights[i].a);
    expectStochasticRounding(rounded[i], 3, lights[i].a, std::floor(lights[i].a / step) * step, step);
  }
}

TEST_F(PackedLight, HistoryLengthsOfAntialiasingAreRoundedToNeighboursWithoutBias) {
  for (const std::uint32_t longest : {1U, 2U, 3U, 7U, 64U, 255U}) {
    std::vector<glm::dvec4> lights;
    for (double length = 1.0; length < longest; length *= 1.083) lights.emplace_back(1.0, 1.0, 1.0, single(length));
    lights.emplace_back(1.0, 1.0, 1.0, longest);
    const std::vector<Rounded> rounded = round(kResolved, lights, longest);
    for (std::size_t i = 0; i + 1 < lights.size(); ++i) {
      const double length = lights[i].a;
      SCOPED_TRACE(std::to_string(length) + " of " + std::to_string(longest));
      const double low = std::min(std::exp2(std::floor(std::log2(length))), 32.0);
      expectStochasticRounding(rounded[i], 3, length, low, reference::packedLengthStep(length, longest));
    }
    EXPECT_EQ(rounded.back().least.a, longest);
    EXPECT_EQ(rounded.back().most.a, longest);
  }
}

// Random numbers repeat for the same frame.
TEST_F(PackedLight, AFrameHasTheSameRandomNumbersAgain) {
  EXPECT_EQ(standardizedNumbers(16, kResolved.key, 5), standardizedNumbers(16, kResolved.key, 5));
}

// Of n numbers, each of the 256 levels occurs n / 256 times. The sum of squared deviations from that, divided by
// n / 256, has a mean of 255 and a variance of 2 x 255 (chi-squared distribution).
TEST_F(PackedLight, RandomNumbersAreUniform) {
  constexpr int kSide = 256;
  const double deviation = std::sqrt((1.0 - 1.0 / (kLevels * kLevels)) / 12.0);
  for (const Packing& packing : {kAccumulated, kResolved}) {
    const std::vector<glm::dvec4> numbers = standardizedNumbers(kSide, packing.key, 7);
    for (int c = 0; c < 4; ++c) {
      SCOPED_TRACE(std::string(packing.name) + ' ' + std::to_string(c));
      std::vector<double> counts(kLevels);
      for (const glm::dvec4& v : numbers) {
        const double level = (v[c] * deviation + 0.5) * kLevels - 0.5;
        ASSERT_NEAR(level, std::round(level), 1e-9);
        counts.at(static_cast<std::size_t>(std::lround(level))) += 1.0;
      }
      const double expected = double(kSide) * kSide / kLevels;
      double chiSquared = 0.0;
      for (const double count : counts) chiSquared += (count - expected) * (count - expected) / expected;
      EXPECT_NEAR(chiSquared, kLevels - 1.0, 5.0 * std::sqrt(2.0 * (kLevels - 1.0)));
    }
  }
}

// Between any two of the random numbers of pixels up to four apart, in the same frame or the next one, of the same
// texture or another, there is no correlation. That of n pairs of independent numbers has a standard deviation of
// 1 / sqrt(n); 10,000 of them stay within 6 with a probability of 1 - 2e-5.
TEST_F(PackedLight, RandomNumbersAreUncorrelated) {
  constexpr int kSide = 96;
  constexpr int kReach = 4;
  /// All random numbers of a channel of a texture in a frame.
  using Plane = std::vector<double>;
  std::array<std::vector<Plane>, 2> frames;
  for (std::uint32_t frame = 0; frame < 2; ++frame) {
    for (const Packing& packing : {kAccumulated, kResolved}) {
      const std::vector<glm::dvec4> numbers = standardizedNumbers(kSide, packing.key, 11 + frame);
      for (int c = 0; c < 4; ++c) {
        Plane& plane = frames.at(frame).emplace_back();
        for (const glm::dvec4& v : numbers) plane.push_back(v[c]);
      }
    }
  }
  const auto correlation = [&](const Plane& a, const Plane& b, glm::ivec2 offset) {
    double sum = 0.0;
    for (int y = std::max(0, -offset.y); y < kSide - std::max(0, offset.y); ++y)
      for (int x = std::max(0, -offset.x); x < kSide - std::max(0, offset.x); ++x)
        sum += a[y * kSide + x] * b[(y + offset.y) * kSide + x + offset.x];
    return sum / double((kSide - std::abs(offset.x)) * (kSide - std::abs(offset.y)));
  };
  for (std::size_t i = 0; i < frames[0].size(); ++i) {
    for (std::size_t j = 0; j < frames[0].size(); ++j) {
      for (int y = -kReach; y <= kReach; ++y) {
        for (int x = -kReach; x <= kReach; ++x) {
          const glm::ivec2 offset(x, y);
          const double tolerance = 6.0 / std::sqrt(double((kSide - std::abs(x)) * (kSide - std::abs(y))));
          const std::string pair = std::to_string(i) + ", " + std::to_string(j);
          const bool itself = i == j && offset == glm::ivec2(0);
          EXPECT_NEAR(correlation(frames[0][i], frames[0][j], offset), itself ? 1.0 : 0.0, tolerance) << pair;
          EXPECT_NEAR(correlation(frames[0][i], frames[1][j], offset), 0.0, tolerance) << pair << " in the next frame";
        }
      }
    }
  }
}

// Filtered light is dithered instead: one number for all channels. Those of a pixel in n frames are multiples of the
// golden ratio modulo 1, whose largest gap is at most (1 + 2 / sqrt(5)) / n. A float of a coordinate below 64 holds a
// number to 2^-18.
TEST_F(PackedLight, DitherIsEvenOverTheFramesOfAPixel) {
  constexpr int kSide = 48;
  constexpr std::uint32_t kFrames = 24;
  const double deviation = std::sqrt((1.0 - 1.0 / (kLevels * kLevels)) / 12.0);
  std::vector<std::vector<double>> ofPixel(std::size_t(kSide) * kSide);
  for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
    const std::vector<glm::dvec4> numbers = standardizedNumbers(kSide, kFiltered.key, 1000 + frame);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      EXPECT_EQ(numbers[i], glm::dvec4(numbers[i].x));
      ofPixel[i].push_back(numbers[i].x * deviation + 0.5);
    }
  }
  const double largestGap = (1.0 + 2.0 / std::sqrt(5.0)) / kFrames + 0x1p-16;
  for (std::vector<double>& numbers : ofPixel) {
    std::ranges::sort(numbers);
    EXPECT_GE(numbers.front(), 0.0);
    EXPECT_LT(numbers.back(), 1.0);
    EXPECT_LE(numbers.front() + 1.0 - numbers.back(), largestGap);
    for (std::size_t i = 1; i < numbers.size(); ++i) EXPECT_LE(numbers[i] - numbers[i - 1], largestGap);
  }
}

constexpr glm::ivec2 kSize(66, 46);

/// Settings of how the temporal stages find their history. Without the share of accumulated light, which would steer
/// the antilag factor (many_samples_test.cpp): the reference here does not.
struct NamedSettings {
  const char* name;
  WalrSettings settings;
};
std::vector<NamedSettings> waysToReproject() {
  WalrSettings apart = walrWithoutShare();
  apart.antialiasing.thresholds.normalThreshold = 0.4F;  // Makes anti-aliasing do its own reprojection.
  WalrSettings byDepth = walrWithoutShare();
  byDepth.accumulation.rejection = byDepth.antialiasing.rejection = HistoryRejection::Depth;
  byDepth.accumulation.historyFilter = HistoryFilter::Bicubic;
  byDepth.accumulation.antilag.enabled = false;
  WalrSettings untested = walrWithoutShare();
  untested.accumulation.rejection = untested.antialiasing.rejection = HistoryRejection::None;
  untested.antialiasing.maxHistory = 100.0F;
  WalrSettings accumulationOnly = walrWithoutShare();
  accumulationOnly.antialiasing.storage = LightStorage::Half;
  WalrSettings antialiasingOnly = walrWithoutShare();
  antialiasingOnly.accumulation.storage = LightStorage::Half;
  return {{"shared", walrWithoutShare()},
          {"apart", apart},
          {"by depth", byDepth},
          {"untested", untested},
          {"packed accumulation", accumulationOnly},
          {"packed anti-aliasing", antialiasingOnly}};
}

TEST_F(PackedLight, TemporalStagesAgreeWithTheReferenceOnEveryScene) {
  for (const NamedScene& named : allScenes()) {
    SCOPED_TRACE(named.name);
    expectSequence(device(), movingFrames(named.scene, kSize), walrWithoutShare());
  }
}

TEST_F(PackedLight, TemporalStagesAgreeWithTheReferenceForEveryReprojection) {
  for (const NamedSettings& named : waysToReproject()) {
    SCOPED_TRACE(named.name);
    for (const SceneDescription& scene : {SceneDescription{}, SceneDescription{.objectMotion = false}}) {
      std::vector<HostFrame> frames = movingFrames(skyBesideSurface(), kSize);
      for (HostFrame& frame : frames) {
        frame.scene = scene;
        for (std::size_t i = 0; i < frame.depth.pixels().size(); ++i)
          if (frame.depth.pixels()[i] > 1e9) frame.lighting.pixels()[i] = glm::dvec3(3.0, -2.0, 5.0);
      }
      expectSequence(device(), frames, named.settings);
    }
    std::vector<HostFrame> still;
    for (std::uint32_t i = 0; i < 5; ++i) {
      still.push_back(renderStill(stairs(), kSize, i));
      still.back().scene = {.cameraMotion = false, .objectMotion = false};
    }
    expectSequence(device(), still, named.settings);
  }
}

// The regression gives the same result for packed light as for the same light in halves, up to less than a step.
TEST_F(PackedLight, BlocksGiveTheSameResultAsForHalves) {
  const WalrSettings settings = walrWithoutShare();  // Else light that no fit predicts is added.
  FilterRun inHalves(
      device(), kSize, 1,
      [&](fg::Graph& graph, fg::Buffer frame, const walr::Guides& guides, const auto& inputs) {
        return addBlockFilter(graph, frame, {inputs[0], LightingAlpha::SampleCount}, guides, settings.blocks);
      },
      true);
  for (const NamedScene& named : allScenes()) {
    WalrRun run(device(), kSize, settings);
    WalrStages stages;
    HostFrame last;
    for (const HostFrame& frame : movingFrames(named.scene, kSize)) stages = run.frame(last = frame);
    const Image<glm::dvec4> expected = inHalves.run(last, stages.guides, {stages.accumulated});
    Comparison comparison(named.name);
    reference::forEachPixel(kSize, [&](glm::ivec2 p) {
      comparison.compared();
      comparison.value(p, "surface", stages.filtered[p].a, stages.guides[p].depth > 0.0 ? 1.0 : -1.0, 0.0);
      if (stages.guides[p].depth == 0.0) return;
      const double step = reference::packedStep(brightest(expected[p]) * (1.0 + 2.0 * reference::kHalfRoundoff),
                                                reference::kFilteredBits);
      for (int c = 0; c < 3; ++c)
        comparison.value(p, "radiance", stages.filtered[p][c], expected[p][c],
                         step + halfTolerance(expected[p][c], 0.0));
    });
    comparison.expect(0.0);
  }
}

// A still wall under noise-free light. No channel can be packed exactly, and two are darker than a step. The output
// varies over time by no more than stochastic rounding explains, and its mean is the light.
TEST_F(PackedLight, AStillImageIsStableAndUnbiased) {
  const glm::dvec3 light(0.3, 0.01, 0.0007);
  constexpr std::uint32_t kUnsettled = 24;
  constexpr std::uint32_t kFrames = 64;
  const WalrSettings settings{};
  WalrRun run(device(), kSize, settings, {}, false);
  Image<glm::dvec3> sums(kSize);
  Image<glm::dvec3> squares(kSize);
  HostFrame frame = renderStill(flatWall(), kSize, 0, Noise::None);
  for (glm::dvec3& l : frame.lighting.pixels())
    for (int c = 0; c < 3; ++c) l[c] = reference::roundToHalf(light[c]);
  const glm::dvec3 truth = frame.lighting.pixels().front();
  for (std::uint32_t i = 0; i < kUnsettled + kFrames; ++i) {
    frame.constants.frameIndex = i;
    const WalrStages stages = run.frame(frame);
    if (i < kUnsettled) continue;
    reference::forEachPixel(kSize, [&](glm::ivec2 p) {
      const glm::dvec3 error = glm::dvec3(stages.output[p]) - truth;
      sums[p] += error;
      squares[p] += error * error;
    });
  }
  // Rounding adds a variance of at most a quarter of a squared step. In an exponential mean over n frames the
  // variance of its own rounding grows by n^2 / (2 n - 1), and that of its input shrinks by 1 / (2 n - 1). History
  // has a share of 1 - 1 / n in the output.
  const double n = settings.antialiasing.maxHistory;
  const auto steps = [&](int bits) { return reference::packedStep(truth.r, bits); };
  const double filtered = 0.25 * std::pow(steps(reference::kFilteredBits), 2.0);
  const double resolved = 0.25 * std::pow(steps(reference::kResolvedBits), 2.0);
  const double spread = filtered / (2.0 * n - 1.0) + resolved * std::pow(n - 1.0, 2.0) / (2.0 * n - 1.0);
  // A rounding error stays in the accumulated mean for m frames, so its deviation counts m times in the mean over time.
  // Blocks and windows reduce it further.
  const double m = settings.accumulation.maxHistory;
  const double accumulated = 0.25 * std::pow(steps(reference::kAccumulatedBits), 2.0);
  const double trials = double(kFrames) * kSize.x * kSize.y;
  const double deviationOfMean =
      std::sqrt((accumulated * m * m + filtered + resolved * (n - 1.0) * (n - 1.0)) / trials);
  glm::dvec3 bias(0.0);
  glm::dvec3 variance(0.0);
  for (std::size_t i = 0; i < sums.pixels().size(); ++i) {
    const glm::dvec3 mean = sums.pixels()[i] / double(kFrames);
    bias += mean / double(sums.pixels().size());
    variance += (squares.pixels()[i] / double(kFrames) - mean * mean) / double(sums.pixels().size());
  }
  for (int c = 0; c < 3; ++c) {
    RecordProperty("relative_bias_" + std::to_string(c), std::to_string(bias[c] / truth[c]));
    RecordProperty("deviation_of_brightest_" + std::to_string(c), std::to_string(std::sqrt(variance[c]) / truth.r));
    // Halves of the blocks' moments and fits, and those of the output, are rounded to nearest.
    const double halves = 6.0 * 2.0 * reference::kHalfRoundoff * truth[c];
    EXPECT_NEAR(bias[c], 0.0, 5.0 * deviationOfMean + halves) << c;
    EXPECT_LE(variance[c], spread + halves * halves) << c;
  }
}

}  // namespace
}  // namespace walr::test::packed_light_test
