// Compares skies from maps with quadrature, closed forms and a constant sky.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "samples/errors.h"
#include "samples/image/exr.h"
#include "samples/render/gbuffer.h"
#include "samples/render/load_scene.h"
#include "samples/render/load_sky.h"
#include "samples/render/path_tracer.h"
#include "samples/render/sky.h"
#include "tests/error_text.h"
#include "tests/render/scene_builder.h"
#include "tests/render/statistics.h"
#include "tests/samples/temporary_directory.h"

namespace walr::render::sky_test {
namespace {

using test::kConfidence;
using test::SceneBuilder;
using test::Statistics;

constexpr double kPi = std::numbers::pi;

SkyMap constantMap(const glm::vec3& radiance) {
  return {16, 8, std::vector<glm::vec3>(16 * 8, radiance)};
}

// A dim map with one bright texel, above and to the right of the middle.
SkyMap mapWithASun() {
  SkyMap map = constantMap(glm::vec3(0.1F, 0.2F, 0.3F));
  map.radiance[2 * 16 + 10] = glm::vec3(500.0F, 400.0F, 300.0F);
  return map;
}

// Integral over the sphere by the midpoint rule with cells much smaller than the map's texels.
template <typename Function>
double integrate(Function function) {
  constexpr int kSteps = 1024;
  double sum = 0.0;
  for (int row = 0; row < kSteps; ++row) {
    const double polar = (row + 0.5) * kPi / kSteps;
    for (int column = 0; column < 2 * kSteps; ++column) {
      const double angle = (column + 0.5) * kPi / kSteps;
      const glm::vec3 direction(std::sin(polar) * std::sin(angle), std::cos(polar), std::sin(polar) * std::cos(angle));
      sum += function(direction) * std::sin(polar);
    }
  }
  return sum * (kPi / kSteps) * (kPi / kSteps);
}

Scene sceneUnder(const SkyMap& map) {
  Scene scene;
  scene.skyMap = map;
  return scene;
}

TEST(Sky, MiddleOfTheMapIsMinusZAndItsTopPlusY) {
  SkyMap map{4, 2, {}};
  for (int i = 0; i < 8; ++i) {
    map.radiance.emplace_back(static_cast<float>(i));
  }
  const Scene scene = sceneUnder(map);
  const Sky sky(scene);
  // The centres of the four columns lie at -135, -45, 45 and 135 degrees from -Z towards +X, those of the two rows 45
  // degrees up and down.
  const float s = std::sqrt(0.5F);
  for (int column = 0; column < 4; ++column) {
    const auto angle = static_cast<float>((column - 1.5) * kPi / 2.0);
    const glm::vec3 up(s * std::sin(angle), s, -s * std::cos(angle));
    EXPECT_NEAR(sky.radiance(up).x, static_cast<float>(column), 1e-4F);
    EXPECT_NEAR(sky.radiance({up.x, -up.y, up.z}).x, static_cast<float>(column + 4), 1e-4F);
  }
}

TEST(Sky, DensityIntegratesToOne) {
  const Scene scene = sceneUnder(mapWithASun());
  const Sky sky(scene);
  // No cell straddles a texel's edge, so that the only error of the midpoint rule comes from the curvature of the sine.
  EXPECT_NEAR(integrate([&](const glm::vec3& direction) { return sky.density(direction); }), 1.0, 1e-3);
}

TEST(Sky, SamplesEstimateTheWholeLight) {
  const Scene scene = sceneUnder(mapWithASun());
  const Sky sky(scene);
  const double whole = integrate([&](const glm::vec3& direction) { return sky.radiance(direction).x; });
  Statistics estimate;
  for (std::uint32_t i = 0; i < 200000; ++i) {
    Sampler sampler(Sampler::Kind::Independent, 3, 0, i);
    const SkySample sample = sky.sample(sampler.next2D());
    ASSERT_NEAR(glm::length(sample.direction), 1.0F, 1e-5F);
    ASSERT_GT(sample.density, 0.0F);
    estimate.add(sample.radiance.x / sample.density);
  }
  EXPECT_NEAR(estimate.mean(), whole, kConfidence * estimate.standardError());
}

struct Light {
  Statistics direct;
  Statistics whole;
};

Light gather(const Scene& scene, std::uint32_t camera, std::uint32_t bounces, std::uint32_t paths) {
  const World world(scene);
  const View view = viewFrom(world, camera, 1, 1, glm::vec2(0.0F), glm::vec2(0.0F));
  const Surface surface = tracePrimary(world, view, 0, 0).surface.value();
  Light light;
  for (std::uint32_t i = 0; i < paths; ++i) {
    Sampler sampler(Sampler::Kind::Independent, 1, 0, i);
    const PathSample path = tracePath(world, surface, bounces, sampler);
    light.direct.add(path.direct.x);
    light.whole.add(static_cast<double>(path.direct.x) + path.indirect.x);
  }
  return light;
}

TEST(Sky, WhiteFoldUnderAWhiteMapIsWhite) {
  SceneBuilder builder;
  builder.scene().skyMap = constantMap(glm::vec3(1.0F));
  const std::uint32_t white = builder.material(glm::vec3(1.0F));
  builder.quad(white, glm::vec3(0.0F, 0.0F, -50.0F), glm::vec3(0.0F, 0.0F, 100.0F), glm::vec3(1.0F, 1.0F, 0.0F));
  builder.quad(white, glm::vec3(0.0F, 0.0F, 50.0F), glm::vec3(0.0F, 0.0F, -100.0F), glm::vec3(-1.0F, 1.0F, 0.0F));
  const std::uint32_t camera = builder.camera(glm::vec3(0.0F, 3.0F, 0.0F), glm::vec3(0.3F, 0.3F, 0.0F));
  const Light light = gather(builder.scene(), camera, 64, 40000);
  EXPECT_NEAR(light.whole.mean(), 1.0, kConfidence * light.whole.standardError());
}

TEST(Sky, SunInAMapGivesAFloorTheIntegratedIrradiance) {
  SceneBuilder builder;
  builder.scene().skyMap = mapWithASun();
  builder.quad(builder.material(glm::vec3(0.5F)), glm::vec3(-5.0F, 0.0F, 5.0F), glm::vec3(10.0F, 0.0F, 0.0F),
               glm::vec3(0.0F, 0.0F, -10.0F));
  const std::uint32_t camera = builder.camera(glm::vec3(0.0F, 2.0F, 2.0F), glm::vec3(0.0F));
  const Sky sky(builder.scene());
  const double irradiance = integrate([&](const glm::vec3& direction) {
    return static_cast<double>(sky.radiance(direction).x) * std::max(direction.y, 0.0F);
  });
  const Light light = gather(builder.scene(), camera, 0, 20000);
  EXPECT_NEAR(light.direct.mean(), irradiance / kPi, kConfidence * light.direct.standardError());
  // With cosine sampling alone, one path in 44 would hit the sun: a standard deviation of 6.6 times the mean. With
  // importance sampling only the variation of the interpolated texel remains: for directions uniform over its support,
  // sqrt((4/3)^2 - 1) = 0.88 times the mean.
  EXPECT_LT(std::sqrt(light.direct.variance()), light.direct.mean());
  // A ray that misses the floor sees the map itself.
  const World world(builder.scene());
  EXPECT_EQ(world.sky().radiance({0.0F, 0.0F, -1.0F}), sky.radiance({0.0F, 0.0F, -1.0F}));
}

TEST(Sky, BlackMapIsBlack) {
  const Scene scene = sceneUnder(constantMap(glm::vec3(0.0F)));
  const Sky sky(scene);
  EXPECT_FALSE(sky.isSampled());
  EXPECT_EQ(sky.density({0.0F, 1.0F, 0.0F}), 0.0F);
}

class SkyFile : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path write(const walr::Image& image, const std::string& names = "RGB") const {
    std::vector<ExrChannel> channels;
    for (std::size_t c = 0; c < names.size(); ++c) {
      channels.push_back({std::string(1, names[c]), &image, static_cast<int>(c), ExrType::Float});
    }
    writeExr(folder.path() / "sky.exr", channels);
    return folder.path() / "sky.exr";
  }
  static void expectError(const std::filesystem::path& file, const std::string& text) {
    fg::test::expectError<InputError>([&] { loadSky(file); }, {text, file.string()});
  }

  walr::test::TemporaryDirectory folder;
};

TEST_F(SkyFile, IsReadWithAScene) {
  walr::Image image(4, 2, 3);
  image.at(3, 1, 2) = 7.0F;
  const Scene scene = loadScene(WALR_SCENES "/box.gltf", write(image));
  ASSERT_TRUE(scene.skyMap.has_value());
  EXPECT_EQ(scene.skyMap->radiance[7], glm::vec3(0.0F, 0.0F, 7.0F));
}

TEST_F(SkyFile, RefusesInvalidSkies) {
  walr::Image image(4, 2, 3);
  expectError(folder.path() / "none.exr", "none.exr");
  expectError(write(image, "RG"), "B");
  image.at(2, 1, 0) = -1.0F;
  expectError(write(image), "(2, 1)");
  image.at(2, 1, 0) = std::numeric_limits<float>::quiet_NaN();
  expectError(write(image), "(2, 1)");
}

TEST_F(SkyFile, DamagedFilesNeverCrash) {
  walr::Image image(16, 8, 3);
  std::mt19937 random(5);
  const auto below = [&](std::size_t bound) {
    return std::uniform_int_distribution<std::size_t>(0, bound - 1)(random);
  };
  for (float& value : image.values()) {
    value = static_cast<float>(below(100));
  }
  std::ifstream stream(write(image), std::ios::binary);
  const std::string original{std::istreambuf_iterator<char>(stream), {}};
  const std::filesystem::path damaged = folder.path() / "damaged.exr";
  int read = 0;
  for (int i = 0; i < 500; ++i) {
    std::string bytes = original.substr(0, below(4) == 0 ? below(original.size()) : original.size());
    for (std::size_t changes = 1 + below(3); changes > 0 && !bytes.empty(); --changes) {
      bytes[below(bytes.size())] = static_cast<char>(below(256));
    }
    std::ofstream(damaged, std::ios::binary) << bytes;
    try {
      const SkyMap map = loadSky(damaged);
      EXPECT_EQ(map.radiance.size(), std::size_t{map.width} * map.height);
      ++read;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(damaged.string()), std::string::npos) << error.what();
    }
  }
  // Some damaged files can still be read, because not every byte matters.
  EXPECT_GT(read, 0);
}

}  // namespace
}  // namespace walr::render::sky_test
