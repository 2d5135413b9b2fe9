// History lengths out of a denoiser, and the host's confidence in its history.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <glm/gtc/packing.hpp>

#include <walr/walr_passes.h>

#include "tests/integration/hosted_run.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/passes/texel_codec.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::history_test {
namespace {

using reference::forEachPixel;
using reference::HostFrame;

constexpr glm::ivec2 kSize(45, 37);
constexpr const char* kMethods[] = {"walr", "walr_paper", "bmfr", "svgf", "flr", "joint_bilateral", "accumulate"};
constexpr std::uint8_t kAll = 255;

bool isLeft(glm::ivec2 p) {
  return p.x < kSize.x / 2;
}

/// Frames of a surface beside sky. The camera stands still, so that history lengths are whole numbers.
class History : public fg::test::GpuTest {
 protected:
  static HostFrame frameAt(std::uint32_t index, double step = 0.0) {
    return renderFrame(skyBesideSurface(),
                       cameraAt({step * index, 0.0, 0.0}, {step * (index - 1.0), 0.0, 0.0}, kSize, index), kSize);
  }
  static FrameDescription cameraOf(std::uint32_t index, double step = 0.0) {
    return cameraAt({step * index, 0.0, 0.0}, {step * (index - 1.0), 0.0, 0.0}, kSize, index);
  }
  static HostedRun::Options options(VkFormat confidence) {
    HostedRun::Options options;
    options.confidenceFormat = confidence;
    options.historyLength = true;
    return options;
  }
  /// Every surface pixel of a frame has the history length that a function tells, and the sky has none.
  static void expectLengths(const HostedRun& run, const HostFrame& frame, auto&& expected) {
    const std::vector<std::uint16_t> lengths = run.historyLength();
    int surfaces = 0;
    forEachPixel(kSize, [&](glm::ivec2 p) {
      const bool surface = frame.depth[p] < 1e9;
      if (surface && frame.albedo[p].x < 0.01) return;  // Some methods denoise it, some pass it through.
      surfaces += surface ? 1 : 0;
      const float length = glm::unpackHalf1x16(lengths[std::size_t(p.y) * kSize.x + p.x]);
      ASSERT_EQ(length, surface ? expected(p) : 0.0F) << p.x << ", " << p.y;
    });
    EXPECT_GT(surfaces, 500);
  }
};

TEST_F(History, LengthCountsFrames) {
  for (const char* method : kMethods) {
    SCOPED_TRACE(method);
    HostedRun run(device(), method, kSize, options(VK_FORMAT_UNDEFINED));
    for (std::uint32_t i = 0; i < 4; ++i) {
      const HostFrame frame = frameAt(i);
      run.fill(frame);
      (void)run.frame(cameraOf(i), i == 3 ? WALR_FRAME_RESET_HISTORY : 0);
      expectLengths(run, frame, [&](glm::ivec2) { return i == 3 ? 1.0F : float(i) + 1.0F; });
    }
  }
}

// `walr` accumulates a texel of light for a group of pixels, which all get its length.
TEST_F(History, LengthOfSparseLightIsThatOfThePixelsGroup) {
  const glm::ivec2 group(3, 2);
  HostedRun::Options given = options(VK_FORMAT_UNDEFINED);
  for (int axis = 0; axis < 2; ++axis) given.conventions.light_group[axis] = static_cast<std::uint32_t>(group[axis]);
  HostedRun run(device(), "walr", kSize, given);
  for (std::uint32_t i = 0; i < 4; ++i) {
    // Then accumulated light has a texel for each pixel, and begins anew.
    if (i == 3) require(walr_set_setting(run.denoiser(), "antialiasing.normal-threshold", "0.8"));
    const HostFrame frame = frameAt(i);
    run.fill(frame);
    reference::Image<glm::dvec3> light((kSize + group - 1) / group);
    forEachPixel(light.size(), [&](glm::ivec2 p) { light[p] = frame.lighting[p * group]; });
    run.fill("lighting", texelBytes(encodeHalves(light)));
    (void)run.frame(cameraOf(i));
    HostFrame ofGroups = frame;
    forEachPixel(kSize, [&](glm::ivec2 p) {
      ofGroups.depth[p] = frame.depth[p / group * group];
      ofGroups.albedo[p] = frame.albedo[p / group * group];
    });
    if (i < 3) {
      expectLengths(run, ofGroups, [&](glm::ivec2) { return float(i) + 1.0F; });
    } else {
      for (const std::uint16_t length : run.historyLength()) ASSERT_LE(glm::unpackHalf1x16(length), 1.0F);
    }
  }
}

// Before a still camera, the history of what moves is no longer than before a moving one.
TEST_F(History, IsLongerAtRest) {
  constexpr float kLongest = 8.0F;
  // Innovations are judged over 7 x 7 tiles of 8 x 8 pixels: some of these must not see what moves.
  constexpr glm::ivec2 kWide(144, 48);
  HostedRun run(device(), "walr", kWide, options(VK_FORMAT_UNDEFINED));
  HostFrame frame;
  for (std::uint32_t i = 0; i < 24; ++i) {
    const FrameDescription camera = cameraAt({}, {}, kWide, i);
    frame = renderFrame(approachingPanel(i, 0.02), camera, kWide);
    run.fill(frame);
    (void)run.frame(camera);
  }
  const std::vector<std::uint16_t> lengths = run.historyLength();
  int moving = 0, longer = 0;
  forEachPixel(kWide, [&](glm::ivec2 p) {
    const float length = glm::unpackHalf1x16(lengths[std::size_t(p.y) * kWide.x + p.x]);
    const bool moves = glm::length(glm::dvec2(frame.motion[p])) > 0.1;  // Pixels.
    moving += moves ? 1 : 0;
    longer += length > 2.0F * kLongest ? 1 : 0;
    EXPECT_LE(length, moves ? kLongest : 6.0F * kLongest) << p.x << ", " << p.y;
  });
  EXPECT_GT(moving, 50);
  EXPECT_GT(longer, 200);
}

TEST_F(History, ConfidenceScalesTheLongestHistory) {
  for (const char* method : kMethods) {
    SCOPED_TRACE(method);
    HostedRun run(device(), method, kSize, options(VK_FORMAT_R32_SFLOAT));
    const bool isBilateral = std::string(method) == "joint_bilateral";
    require(
        walr_set_setting(run.denoiser(), isBilateral ? "antialiasing.max-history" : "accumulation.max-history", "4"));
    // Else innovations shorten history, too.
    if (std::string(method) == "walr") require(walr_set_setting(run.denoiser(), "blocks.innovation-gain", "0"));
    std::vector<float> confidence(std::size_t(kSize.x) * kSize.y);
    forEachPixel(kSize, [&](glm::ivec2 p) { confidence[std::size_t(p.y) * kSize.x + p.x] = isLeft(p) ? 0.0F : 0.5F; });
    for (std::uint32_t i = 0; i < 6; ++i) {
      const HostFrame frame = frameAt(i);
      run.fill(frame);
      run.fill("confidence", texelBytes(confidence));
      (void)run.frame(cameraOf(i));
      // Half of four frames, and this one.
      expectLengths(run, frame, [&](glm::ivec2 p) { return isLeft(p) ? 1.0F : std::min(float(i) + 1.0F, 3.0F); });
    }
  }
}

/// Bits of the results of some frames of a moving camera.
std::vector<std::vector<std::uint16_t>> resultsOf(HostedRun& run, const std::vector<std::byte>& confidence,
                                                  auto&& fillFrame, auto&& cameraOf) {
  std::vector<std::vector<std::uint16_t>> results;
  for (std::uint32_t i = 0; i < 4; ++i) {
    fillFrame(i);
    if (!confidence.empty()) run.fill("confidence", confidence);
    results.push_back(run.frame(cameraOf(i)));
  }
  return results;
}

TEST_F(History, FullConfidenceChangesNothing) {
  constexpr double kStep = 0.06;
  const std::size_t pixels = std::size_t(kSize.x) * kSize.y;
  const auto notANumber = texelBytes(std::vector<float>(pixels, std::numeric_limits<float>::quiet_NaN()));
  const auto beyond = texelBytes(std::vector<float>(pixels, std::numeric_limits<float>::infinity()));
  const auto below = texelBytes(std::vector<float>(pixels, -2.0F));
  for (const char* method : kMethods) {
    SCOPED_TRACE(method);
    const auto results = [&](VkFormat format, const std::vector<std::byte>& confidence) {
      HostedRun::Options given = options(format);
      given.historyLength = false;
      HostedRun run(device(), method, kSize, given);
      return resultsOf(
          run, confidence, [&](std::uint32_t i) { run.fill(frameAt(i, kStep)); },
          [&](std::uint32_t i) { return cameraOf(i, kStep); });
    };
    const auto without = results(VK_FORMAT_UNDEFINED, {});
    EXPECT_EQ(results(VK_FORMAT_R8_UNORM, std::vector<std::byte>(pixels, std::byte{kAll})), without);
    EXPECT_EQ(results(VK_FORMAT_R32_SFLOAT, notANumber), without);
    EXPECT_EQ(results(VK_FORMAT_R32_SFLOAT, beyond), without);
    EXPECT_NE(results(VK_FORMAT_R32_SFLOAT, below), without);
  }
}

TEST_F(History, ConfidenceIsReadInItsRectangle) {
  HostedRun::Options given = options(VK_FORMAT_R8_UNORM);
  given.offset = {5, 3};
  given.margin = {16, 9};
  HostedRun run(device(), "accumulate", kSize, given);
  std::vector<std::uint8_t> confidence(std::size_t(kSize.x) * kSize.y);
  forEachPixel(kSize, [&](glm::ivec2 p) { confidence[std::size_t(p.y) * kSize.x + p.x] = isLeft(p) ? 0 : kAll; });
  for (std::uint32_t i = 0; i < 3; ++i) {
    const HostFrame frame = frameAt(i);
    const auto place = [&](const char* name, const auto& texels, std::size_t components) {
      using Value = typename std::decay_t<decltype(texels)>::value_type;
      std::vector<std::byte> bytes(std::size_t(run.imageSize().x) * run.imageSize().y * components * sizeof(Value));
      for (int y = 0; y < kSize.y; ++y) {
        const std::size_t row = components * sizeof(Value) * kSize.x;
        const std::size_t to = (std::size_t(y + given.offset.y) * run.imageSize().x + given.offset.x) * components;
        std::memcpy(bytes.data() + to * sizeof(Value), reinterpret_cast<const std::byte*>(texels.data()) + y * row,
                    row);
      }
      run.fill(name, bytes);
    };
    place("lighting", encodeHalves(frame.lighting), 4);
    place("depth", encodeFloats(frame.depth), 1);
    place("normal", encodeHalves(frame.normal), 4);
    place("motion", encodeHalves(frame.motion), 4);
    place("albedo", encodeHalves(frame.albedo), 4);
    place("confidence", confidence, 1);
    (void)run.frame(cameraOf(i));
    expectLengths(run, frame, [&](glm::ivec2 p) { return isLeft(p) ? 1.0F : float(i) + 1.0F; });
  }
}

/// Names of the host's images in a list of passes.
std::vector<std::string> hostImages(const WalrDenoiserInfo& info) {
  WalrPasses passes = nullptr;
  require(createPasses(info, passes));
  const WalrPassList* list = nullptr;
  require(walr_get_pass_list(passes, &list));
  std::vector<std::string> names;
  for (std::uint32_t i = 0; i < list->resource_count; ++i)
    if (list->resources[i]->kind == WALR_RESOURCE_HOST) names.emplace_back(list->resources[i]->name);
  require(walr_destroy_passes(passes));
  return names;
}

TEST(HistoryPassByPass, BothImagesAreTheHosts) {
  WalrDenoiserInfo info = denoiserInfo(nullptr);
  const auto has = [&](const char* name) { return std::ranges::count(hostImages(info), std::string(name)) == 1; };
  EXPECT_FALSE(has("confidence"));
  EXPECT_FALSE(has("history_length"));
  info.confidence_format = VK_FORMAT_R8_UNORM;
  info.history_length = VK_TRUE;
  EXPECT_TRUE(has("confidence"));
  EXPECT_TRUE(has("history_length"));
  info.method = "temporal_accumulation";
  EXPECT_THROW(hostImages(info), std::runtime_error);
  info.history_length = VK_FALSE;
  EXPECT_TRUE(has("confidence"));
  info.confidence_format = VK_FORMAT_R32_UINT;
  EXPECT_THROW(hostImages(info), std::runtime_error);
}

TEST(OutputsPassByPass, AreTheHostsImagesAndOfWalrOnly) {
  struct Output {
    const char* name;
    VkBool32 WalrDenoiserInfo::*wanted;
    std::size_t offset;
    const char* named;  ///< In errors.
  };
  for (const Output& output : {Output{"light_direction", &WalrDenoiserInfo::light_direction,
                                      offsetof(WalrDenoiserInfo, light_direction), "light"},
                               Output{"expected_error", &WalrDenoiserInfo::expected_error,
                                      offsetof(WalrDenoiserInfo, expected_error), "expected"}}) {
    SCOPED_TRACE(output.name);
    WalrDenoiserInfo info = denoiserInfo(nullptr);
    const auto has = [&] { return std::ranges::count(hostImages(info), std::string(output.name)) == 1; };
    EXPECT_FALSE(has());
    info.*output.wanted = VK_TRUE;
    EXPECT_TRUE(has());
    // A caller with the header before this member.
    info.struct_size = std::uint32_t(output.offset);
    EXPECT_FALSE(has());
    info.struct_size = sizeof(info);
    for (const char* method : {"flr", "temporal_accumulation"}) {
      info.method = method;
      try {
        (void)hostImages(info);
        ADD_FAILURE() << method << " took it";
      } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find(output.named), std::string::npos) << error.what();
      }
    }
  }
}

TEST_F(History, AMethodWithoutItSaysSo) {
  HostedRun::Options given;
  given.historyLength = true;
  const auto message = [&](const char* method) -> std::string {
    try {
      HostedRun run(device(), method, kSize, given);
      require(walr_set_setting(run.denoiser(), "spatial-only", "on"));
      require(walr_prepare(run.denoiser()));
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_NE(message("none").find("there is no history length"), std::string::npos) << message("none");
  EXPECT_NE(message("svgf").find("there is no history length"), std::string::npos) << message("svgf");
}

}  // namespace
}  // namespace walr::test::history_test
