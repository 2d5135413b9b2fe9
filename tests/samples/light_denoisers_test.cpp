// Two lights that share their guides have the pictures of each light alone, to the bit.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include "samples/denoise/light_denoisers.h"
#include "samples/image/half.h"
#include "tests/samples/synthetic_sequence.h"

namespace walr::light_denoisers_test {
namespace {

constexpr int kWidth = 72;
constexpr int kHeight = 48;
constexpr fg::Extent kExtent{kWidth, kHeight};

/// A method with a preset, empty for the default, and a setting for each light.
struct Choice {
  std::string method;
  std::string indirect = {};  ///< Preset.
  std::string direct = {};    ///< Preset.
  std::string setting = {};   ///< Of both; may be empty.
  std::string value = {};
};

void PrintTo(const Choice& choice, std::ostream* out) {
  *out << choice.method << ' ' << choice.indirect << ' ' << choice.direct << ' ' << choice.setting;
}

void fillWithNoise(Image& image, std::uint32_t seed) {
  for (std::size_t i = 0; i < image.values().size(); ++i) {
    const auto mixed = static_cast<std::uint32_t>((i + 7919U * seed) * 2654435761U);
    image.values()[i] = toHalf(static_cast<float>(mixed >> 24U) / 64.0F);
  }
}

/// Frames of a wall that the camera passes, with other light in each, a camera cut, and objects.
std::vector<Frame> frames() {
  std::vector<Frame> frames;
  for (int number = 0; number < 6; ++number) {
    Frame frame = test::projectFrame(number, kWidth, kHeight);
    frame.direct = Image(kWidth, kHeight, 3);
    fillWithNoise(frame.indirect, 2U * static_cast<std::uint32_t>(number));
    fillWithNoise(frame.direct, 2U * static_cast<std::uint32_t>(number) + 1U);
    for (std::size_t i = 0; i < frame.motion.pixelCount(); ++i) frame.motion.pixel(i)[0] = 1.3F;
    frame.objectId = Image(kWidth, kHeight, 1);
    for (std::size_t i = 0; i < frame.objectId.pixelCount(); ++i) {
      frame.objectId.values()[i] = static_cast<float>(i % kWidth / 16);
    }
    frame.camera.projection = glm::perspective(1.0F, static_cast<float>(kWidth) / kHeight, 0.1F, 100.0F);
    frame.previousProjection = frame.camera.projection;
    frame.resetHistory = number == 0 || number == 4;
    frames.push_back(std::move(frame));
  }
  return frames;
}

LightMethod lightMethod(const Choice& choice, Light light) {
  LightMethod made{light, makeDenoiser(choice.method)};
  const std::string& preset = light == Light::Indirect ? choice.indirect : choice.direct;
  if (!preset.empty()) made.method->usePreset(preset);
  if (!choice.setting.empty()) made.method->set(choice.setting, choice.value);
  return made;
}

class LightDenoisersTest : public testing::TestWithParam<Choice> {
 protected:
  // One device for all cases: the driver of tests keeps its pipelines, and creating them takes longer than the frames.
  static void SetUpTestSuite() { gpu.emplace(GpuDevice::Options{.device = {}, .validation = true}); }
  static void TearDownTestSuite() { gpu.reset(); }
  void TearDown() override { EXPECT_NO_THROW(gpu->refuseMessages()); }

  [[nodiscard]] std::vector<DenoisedFrame> denoise(std::span<const LightMethod> lights) const {
    const Layout& layout = projectLayout();
    LightDenoisers denoiser(*gpu, lights, kExtent, layout, {}, 2, {.objectIds = true});
    std::vector<DenoisedFrame> results;
    for (Frame& frame : frames()) {
      if (denoiser.full()) results.push_back(*denoiser.finish());
      denoiser.submit(denoiser.pack(std::move(frame)));
    }
    while (std::optional<DenoisedFrame> last = denoiser.finish()) results.push_back(std::move(*last));
    return results;
  }
  [[nodiscard]] std::vector<DenoisedFrame> denoise(std::initializer_list<Light> lights) const {
    std::vector<LightMethod> methods;
    for (const Light light : lights) methods.push_back(lightMethod(GetParam(), light));
    return denoise(methods);
  }

  static inline std::optional<GpuDevice> gpu;
};

TEST_P(LightDenoisersTest, BothLightsAreThoseOfDenoisersOfTheirOwn) {
  const std::vector<DenoisedFrame> both = denoise({Light::Indirect, Light::Direct});
  const std::vector<DenoisedFrame> indirect = denoise({Light::Indirect});
  const std::vector<DenoisedFrame> direct = denoise({Light::Direct});
  ASSERT_EQ(both.size(), frames().size());
  ASSERT_EQ(indirect.size(), both.size());
  ASSERT_EQ(direct.size(), both.size());
  for (std::size_t i = 0; i < both.size(); ++i) {
    SCOPED_TRACE("frame " + std::to_string(i));
    EXPECT_TRUE(std::ranges::equal(both[i].indirect.values(), indirect[i].indirect.values()));
    EXPECT_TRUE(std::ranges::equal(both[i].direct.values(), direct[i].direct.values()));
    EXPECT_FALSE(std::ranges::equal(both[i].direct.values(), both[i].indirect.values()));
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, LightDenoisersTest,
                         testing::Values(Choice{"walr"}, Choice{"walr", {}, {}, "blocks.residual", "off"},
                                         Choice{"walr", {}, {}, "spatial-only", "on"},
                                         Choice{"walr", {}, {}, "antialiasing.enabled", "off"},
                                         Choice{"walr", {}, {}, "accumulation.storage", "half"},
                                         Choice{"walr", {}, {}, "antialiasing.object-ids", "on"},
                                         Choice{"walr_paper", "robust", "robust", "accumulation.dilate-motion", "on"},
                                         Choice{"walr_paper", "robust", "robust", "accumulation.rejection", "depth"},
                                         Choice{"walr_paper", "paper", "paper"},
                                         Choice{"walr_paper", "robust", "robust"}, Choice{"refwlr", "robust", "robust"},
                                         Choice{"bmfr", "tuned", "paper"}, Choice{"svgf", "tuned", "paper"},
                                         Choice{"flr"}, Choice{"flnr"}, Choice{"joint_bilateral"}, Choice{"accumulate"},
                                         Choice{"none"}));

/// Lights of all three kinds. `none` shares no guides.
struct AllLights {
  std::string method;
  LightPattern light = {};  ///< Of diffuse light; specular light has samples where it has a distance.
};

TEST(LightDenoisers, AllLightsAreThoseOfDenoisersOfTheirOwn) {
  GpuDevice gpu({.device = {}, .validation = true});
  for (const AllLights& choice :
       {AllLights{"accumulate"}, AllLights{"accumulate", {.columns = 2, .rows = 2}}, AllLights{"none"}}) {
    SCOPED_TRACE(choice.method + " " + std::to_string(choice.light.columns));
    Layout layout = projectLayout();
    layout.conventions.light = choice.light;
    Layout specularLayout = projectLayout();
    specularLayout.conventions.specular = true;
    const auto run = [&](std::initializer_list<Light> lights, const Layout& described) {
      std::vector<LightMethod> methods;
      for (const Light light : lights) methods.push_back(lightMethod({choice.method}, light));
      LightDenoisers denoiser(gpu, methods, kExtent, described, {}, 1, {.objectIds = true});
      std::optional<DenoisedFrame> last;
      for (Frame& frame : frames()) {
        frame.light = choice.light;
        frame.specular = Image(kWidth, kHeight, 3);
        fillWithNoise(frame.specular, 100U + static_cast<std::uint32_t>(frame.number));
        frame.specularAlbedo = Image(kWidth, kHeight, 3);
        std::ranges::fill(frame.specularAlbedo.values(), 0.5F);
        frame.specularDistance = frame.roughness = Image(kWidth, kHeight, 1);
        std::ranges::fill(frame.specularDistance.values(), 2.0F);
        std::ranges::fill(frame.roughness.values(), 0.25F);
        denoiser.submit(denoiser.pack(std::move(frame)));
        last = denoiser.finish();
      }
      return *last;
    };
    const DenoisedFrame all = run({Light::Indirect, Light::Direct, Light::Specular}, layout);
    const DenoisedFrame specular = run({Light::Specular}, specularLayout);
    EXPECT_TRUE(std::ranges::equal(all.indirect.values(), run({Light::Indirect}, layout).indirect.values()));
    EXPECT_TRUE(std::ranges::equal(all.direct.values(), run({Light::Direct}, layout).direct.values()));
    EXPECT_TRUE(std::ranges::equal(all.specular.values(), specular.specular.values()));
    // It has a history.
    EXPECT_EQ(std::ranges::equal(all.specular.values(), specular.frame.specular.values()), choice.method == "none");
  }
  EXPECT_NO_THROW(gpu.refuseMessages());
}

TEST(LightDenoisers, SlopesAreThoseOfTheFirstLight) {
  GpuDevice gpu({.device = {}, .validation = true});
  Frame frame = frames().front();  // Of a wall, here with ripples: without them, light has no slope.
  for (std::size_t i = 0; i < frame.normal.pixelCount(); ++i) {
    const glm::vec3 normal = glm::normalize(glm::vec3(std::sin(0.5F * static_cast<float>(i)), 0.2F, 1.0F));
    for (int c = 0; c < 3; ++c) frame.normal.pixel(i)[c] = normal[c];
  }
  const auto run = [&](std::initializer_list<Light> lights) {
    std::vector<LightMethod> methods;
    for (const Light light : lights) methods.push_back(lightMethod({"walr"}, light));
    LightDenoisers denoiser(gpu, methods, kExtent, projectLayout(), {.lightDirection = true}, 1, {.objectIds = true});
    denoiser.submit(denoiser.pack(frame));
    return denoiser.finish()->slopes;
  };
  const LightSlopes both = run({Light::Indirect, Light::Direct});
  const LightSlopes indirect = run({Light::Indirect}), direct = run({Light::Direct});
  for (std::size_t axis = 0; axis < both.size(); ++axis) {
    EXPECT_TRUE(std::ranges::equal(both.at(axis).values(), indirect.at(axis).values()));
  }
  EXPECT_FALSE(std::ranges::equal(both.front().values(), direct.front().values()));
  EXPECT_NO_THROW(gpu.refuseMessages());
}

// One light has another test of its history, so that it finds the taps by itself.
TEST(LightDenoisers, LightsMayTestTheirHistoryInOtherWays) {
  GpuDevice gpu({.device = {}, .validation = true});
  const auto method = [](const char* tolerance) {
    std::unique_ptr<Denoiser> made = makeDenoiser("walr");
    made->set("accumulation.plane-tolerance", tolerance);
    made->set("antialiasing.plane-tolerance", tolerance);
    return made;
  };
  const auto run = [&](std::vector<LightMethod> lights) {
    LightDenoisers denoiser(gpu, lights, kExtent, projectLayout(), {}, 1, {});
    std::optional<DenoisedFrame> last;
    for (Frame& frame : frames()) {
      frame.objectId = {};
      denoiser.submit(denoiser.pack(std::move(frame)));
      last = denoiser.finish();
    }
    return std::move(*last);
  };
  std::vector<LightMethod> lights;
  lights.push_back({Light::Indirect, method("0.01")});
  lights.push_back({Light::Direct, method("0.0")});
  const DenoisedFrame both = run(std::move(lights));
  std::vector<LightMethod> alone;
  alone.push_back({Light::Direct, method("0.0")});
  EXPECT_TRUE(std::ranges::equal(both.direct.values(), run(std::move(alone)).direct.values()));
  EXPECT_NO_THROW(gpu.refuseMessages());
}

TEST(LightDenoisers, LightsWithOtherGuidesAreRefused) {
  const GpuDevice gpu({.device = {}, .validation = false});
  const std::vector<std::pair<const char*, const char*>> settings{{"occlusion.rings", "3"},
                                                                  {"guides.albedo-threshold", "0"},
                                                                  {"scene.sky", "off"},
                                                                  {"scene.object-motion", "off"},
                                                                  {"spatial-only", "on"}};
  for (const auto& [name, value] : settings) {
    std::vector<LightMethod> lights;
    lights.push_back({Light::Indirect, makeDenoiser("walr")});
    lights.push_back({Light::Direct, makeDenoiser("walr")});
    lights[1].method->set(name, value);
    try {
      const LightDenoisers denoiser(gpu, lights, kExtent, projectLayout(), {}, 1, {});
      ADD_FAILURE() << name << ": the lights need other guides";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find("make a denoiser for each light"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace walr::light_denoisers_test
