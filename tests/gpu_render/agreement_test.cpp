// The path tracer on the GPU against the one on the processor: the same sample at the same pixel, and the same means.
//
// The environment variable WALR_MEAN_FRAMES sets the number of frames of every mean, at least 2; without it the tests
// take few, so that they are fast. 1000 frames of all scenes take an hour on a software driver.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "samples/gpu_render/film_tracer.h"
#include "samples/render/load_scene.h"
#include "tests/gpu_render/tracing_fixture.h"
#include "tests/render/scene_builder.h"
#include "tests/shared_data.h"

namespace walr::gpu_render::test {
namespace {

using render::Film;
using render::SamplingSettings;

constexpr std::uint32_t kWidth = 96;
constexpr std::uint32_t kHeight = 54;
constexpr double kFramesPerSecond = 24.0;

// The denoiser takes light as half floats. Values that differ by less than one rounding of each, 2^-11, are the same to
// it.
constexpr float kRoundingOfHalf = 0x1p-10F;

bool agree(const glm::vec3& a, const glm::vec3& b) {
  return glm::all(glm::lessThanEqual(glm::abs(a - b), kRoundingOfHalf * glm::max(glm::abs(a), glm::abs(b))));
}

// Both tracers show the same point of the same object: at most a thousandth of the depth apart, which is far below the
// size of a pixel, so that a silhouette that falls between two roundings of a ray does not count as a surface.
bool sameSurface(const render::GBufferPixel& a, const render::GBufferPixel& b) {
  return a.objectId == b.objectId && glm::distance(a.position, b.position) <= 1e-3F * glm::length(a.position);
}

struct Agreement {
  std::uint32_t pixels = 0;        // That show the same surface.
  std::uint32_t otherSurface = 0;  // The others.
  std::uint32_t guides = 0;        // Pixels of the first kind where the G-buffers agree.
  std::uint32_t direct = 0;        // The same for light.
  std::uint32_t indirect = 0;
  std::uint32_t specular = 0;  // Light, distance, albedo and roughness.
  std::uint32_t moving = 0;    // Pixels whose specular lobe shows something that moves, in one of both films.
  std::uint32_t motion = 0;    // Those of them where this motion agrees.
};

Agreement compare(const Film& a, const Film& b) {
  Agreement result;
  // Unit vectors and pixels: the rounding of half floats relative to 1 pixel, because motion may be 0.
  const auto near = [](const glm::vec3& x, const glm::vec3& y) {
    return glm::all(glm::lessThanEqual(glm::abs(x - y), kRoundingOfHalf * (1.0F + glm::max(glm::abs(x), glm::abs(y)))));
  };
  for (std::size_t i = 0; i < a.gbuffer.size(); ++i) {
    const render::GBufferPixel& left = a.gbuffer[i];
    const render::GBufferPixel& right = b.gbuffer[i];
    if (!sameSurface(left, right)) {
      ++result.otherSurface;
      continue;
    }
    ++result.pixels;
    result.guides += agree(left.albedo, right.albedo) && agree(left.emission, right.emission) &&
                             near(left.normal, right.normal) && near(left.motion, right.motion)
                         ? 1
                         : 0;
    result.direct += agree(a.direct[i], b.direct[i]) ? 1 : 0;
    result.indirect += agree(a.indirect[i], b.indirect[i]) ? 1 : 0;
    if (a.specular.empty()) continue;
    const render::SpecularPixel& first = a.specular[i];
    const render::SpecularPixel& second = b.specular[i];
    result.specular += agree(first.light, second.light) && agree(first.albedo, second.albedo) &&
                               agree({first.distance, first.roughness, 0.0F}, {second.distance, second.roughness, 0.0F})
                           ? 1
                           : 0;
    // Motion is a difference of positions, whose roundings are small next to it, but not next to each component.
    const float length = std::max(glm::length(first.motion), glm::length(second.motion));
    result.moving += length > 0.0F ? 1 : 0;
    result.motion += length > 0.0F && glm::distance(first.motion, second.motion) <= kRoundingOfHalf * length ? 1 : 0;
  }
  return result;
}

void expectAgreement(const Film& cpu, const Film& gpu) {
  const Agreement found = compare(cpu, gpu);
  const auto share = [&](std::uint32_t count) { return static_cast<double>(count) / std::max(found.pixels, 1U); };
  std::cout << "other surface: " << found.otherSurface << " pixels; of the others agree: guides "
            << 100.0 * share(found.guides) << " %, direct " << 100.0 * share(found.direct) << " %, indirect "
            << 100.0 * share(found.indirect) << " %\n";
  constexpr double kLeast = 0.99;
  EXPECT_GE(static_cast<double>(found.pixels), kLeast * static_cast<double>(cpu.gbuffer.size()));
  EXPECT_GE(share(found.guides), kLeast);
  EXPECT_GE(share(found.direct), kLeast);
  EXPECT_GE(share(found.indirect), kLeast);
  ASSERT_EQ(gpu.specular.size(), cpu.specular.size());
  if (cpu.specular.empty()) return;
  std::cout << "specular " << 100.0 * share(found.specular) << " %, motion " << found.motion << " of " << found.moving
            << " pixels\n";
  EXPECT_GE(share(found.specular), kLeast);
  EXPECT_GT(found.moving, 0U);
  EXPECT_GE(found.motion, kLeast * found.moving);
}

// A scene with both tracers.
class Pair {
 public:
  Pair(const GpuDevice& gpu, render::Scene scene, const std::string& camera = {})
      : scene_(std::move(scene)), camera_(render::findCamera(scene_, camera)), world_(scene_), tracer_(gpu, world_) {}

  void moveTo(int frame) {
    world_.moveTo(frame / kFramesPerSecond, (frame - 1) / kFramesPerSecond);
    view_ = render::viewFrom(world_, camera_, kWidth, kHeight, render::haltonJitter(frame),
                             render::haltonJitter(frame - 1));
  }
  [[nodiscard]] Film onProcessor(const SamplingSettings& settings) const { return renderFilm(world_, view_, settings); }
  [[nodiscard]] Film onDevice(const SamplingSettings& settings) { return tracer_.film(view_, settings); }
  [[nodiscard]] const render::World& world() const { return world_; }
  [[nodiscard]] const render::View& view() const { return view_; }
  [[nodiscard]] FilmTracer& tracer() { return tracer_; }

 private:
  render::Scene scene_;
  std::uint32_t camera_;
  render::World world_;
  FilmTracer tracer_;
  render::View view_;
};

SamplingSettings settingsOf(render::Sampler::Kind sampler, std::uint32_t seed, std::uint32_t firstSample) {
  SamplingSettings settings;
  settings.sampler = sampler;
  settings.seed = seed;
  settings.firstSample = firstSample;
  return settings;
}

// Mean over the image of all light, in each of some frames.
std::vector<double> meansOf(const std::function<Film(const SamplingSettings&)>& render, std::uint32_t seed,
                            std::uint32_t frames) {
  std::vector<double> means;
  for (std::uint32_t i = 0; i < frames; ++i) {
    const Film film = render(settingsOf(render::Sampler::Kind::BlueNoise, seed, i));
    double sum = 0.0;
    for (std::size_t p = 0; p < film.direct.size(); ++p) {
      sum += glm::dot(glm::dvec3(film.direct[p]) + glm::dvec3(film.indirect[p]), glm::dvec3(1.0));
    }
    means.push_back(sum / static_cast<double>(film.direct.size()));
  }
  return means;
}

struct Estimate {
  double mean = 0.0;
  double variance = 0.0;  // Of the mean.
};

Estimate estimate(const std::vector<double>& values) {
  Estimate result;
  const auto count = static_cast<double>(values.size());
  for (const double value : values) result.mean += value / count;
  for (const double value : values) {
    result.variance += (value - result.mean) * (value - result.mean) / (count * (count - 1.0));
  }
  return result;
}

// Number of frames of a mean: that of the environment, or else a few.
std::uint32_t meanFrames(std::uint32_t few) {
  const char* const set = std::getenv("WALR_MEAN_FRAMES");
  return set != nullptr ? static_cast<std::uint32_t>(std::stoul(set)) : few;
}

// Frames of different seeds are independent, so that the difference of two means is normally distributed with the sum
// of their variances. Five standard deviations are exceeded once in two million cases.
void expectSameMeans(Pair& pair, std::uint32_t few) {
  const std::uint32_t frames = meanFrames(few);
  const Estimate cpu =
      estimate(meansOf([&](const SamplingSettings& settings) { return pair.onProcessor(settings); }, 1, frames));
  const Estimate gpu =
      estimate(meansOf([&](const SamplingSettings& settings) { return pair.onDevice(settings); }, 2, frames));
  const double deviation = std::sqrt(cpu.variance + gpu.variance);
  std::cout << "means of " << frames << " frames: " << cpu.mean << " and " << gpu.mean << ", standard deviation "
            << deviation << '\n';
  EXPECT_GT(cpu.mean, 0.0);
  EXPECT_LE(std::abs(cpu.mean - gpu.mean), 5.0 * deviation);
}

class SceneAgreement : public TracingTest, public testing::WithParamInterface<const char*> {};

TEST_P(SceneAgreement, OfSamplesAndMeans) {
  Pair pair(gpu, render::loadScene(std::string(WALR_SCENES "/") + GetParam(), {}));
  for (const int frame : {5, 30}) {  // In 5 the camera of the box moves; in 30 the lamp of the stair is off.
    pair.moveTo(frame);
    const SamplingSettings settings =
        settingsOf(render::Sampler::Kind::BlueNoise, 4, static_cast<std::uint32_t>(frame));
    expectAgreement(pair.onProcessor(settings), pair.onDevice(settings));
  }
  pair.moveTo(5);
  constexpr std::uint32_t kFewFrames = 24;
  expectSameMeans(pair, kFewFrames);
}

INSTANTIATE_TEST_SUITE_P(BuiltIn, SceneAgreement,
                         testing::Values("box.gltf", "turntable.gltf", "kitchen.gltf", "stair.gltf", "garden.gltf"),
                         [](const auto& test) {
                           const std::string name = test.param;
                           return name.substr(0, name.find('.'));
                         });

class SharedDataAgreement : public TracingTest, public testing::WithParamInterface<const char*> {};

// In Sponza, normal maps would turn a rounding of a hit into another direction, more so at every bounce: with four
// bounces, light agrees only because paths have no roundings that differ (samples/render/exact/arithmetic.h).
TEST_P(SharedDataAgreement, OfSamplesAndMeans) {
  const walr::test::SharedData scene(std::filesystem::path("scenes") / GetParam());
  if (!scene) GTEST_SKIP() << scene.whyNot();
  Pair pair(gpu, render::loadScene(scene.path(), {}));
  pair.moveTo(5);
  const SamplingSettings settings = settingsOf(render::Sampler::Kind::BlueNoise, 4, 5);
  expectAgreement(pair.onProcessor(settings), pair.onDevice(settings));
  constexpr std::uint32_t kFewFrames = 12;
  expectSameMeans(pair, kFewFrames);
}

INSTANTIATE_TEST_SUITE_P(Shared, SharedDataAgreement,
                         testing::Values("cornell_fence.glb", "sponza.glb", "living_room.glb"), [](const auto& test) {
                           const std::string name = test.param;
                           return name.substr(0, name.find('.'));
                         });

// A room with everything that the built-in scenes lack: punctual lights of all kinds, a sky map, a mirrored object,
// vertex colours, and textures at coordinates of their own.
render::Scene everything() {
  render::test::SceneBuilder builder;
  const std::uint32_t grey = builder.material({0.7F, 0.6F, 0.5F});
  const std::uint32_t lamp = builder.material({0.2F, 0.2F, 0.2F}, {3.0F, 2.0F, 1.0F});
  builder.quad(grey, {-4.0F, 0.0F, 4.0F}, {8.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -8.0F});
  builder.quad(grey, {-4.0F, 0.0F, -4.0F}, {8.0F, 0.0F, 0.0F}, {0.0F, 5.0F, 0.0F});
  const std::uint32_t moving = builder.quad(lamp, {-1.0F, 1.0F, -2.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.5F});
  builder.move(moving, {0.0F, 0.0F, 0.0F}, {2.0F, 0.5F, 0.0F});
  const std::uint32_t mirrored = builder.quad(lamp, {1.0F, 1.0F, -2.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.5F});
  builder.scene().nodes[mirrored].transform.scale = {-1.0F, 1.0F, 1.0F};
  render::Transform above;
  above.translation = {2.0F, 3.0F, 1.0F};
  above.rotation = glm::quatLookAtRH(glm::normalize(glm::vec3(-1.0F, -3.0F, -1.0F)), {0.0F, 1.0F, 0.0F});
  using Kind = render::PunctualLight::Kind;
  builder.light({.kind = Kind::Spot, .intensity = {9.0F, 9.0F, 4.0F}, .cosInnerCone = 0.9F, .cosOuterCone = 0.7F},
                above);
  builder.light({.kind = Kind::Point, .intensity = {2.0F, 4.0F, 2.0F}}, {{-2.0F, 2.0F, 1.0F}});
  builder.light({.kind = Kind::Directional, .intensity = {0.5F, 0.4F, 0.3F}}, above);
  builder.camera({0.0F, 2.0F, 6.0F}, {0.0F, 1.0F, 0.0F});
  render::Scene& scene = builder.scene();
  scene.materials[grey].roughness = 0.8F;
  scene.images.push_back({"", 2, 1, {255, 128, 64, 255, 32, 64, 255, 255}});
  scene.textures = {{}, {.coordinates = 1}};
  scene.materials[grey].baseColorTexture = 1;
  scene.materials[lamp].emissiveTexture = 1;
  for (render::Mesh& mesh : scene.meshes) {  // All have four corners.
    mesh.colors = {{1.0F, 0.5F, 1.0F, 1.0F}, {0.5F, 1.0F, 1.0F, 1.0F}, {1.0F, 1.0F, 0.2F, 1.0F}, glm::vec4(1.0F)};
    mesh.uvs.assign(4, glm::vec2(0.25F));  // Of the first coordinates, which no texture takes.
    mesh.uvs.insert(mesh.uvs.end(), {{0.0F, 0.0F}, {3.0F, 0.0F}, {3.0F, 1.0F}, {0.0F, 1.0F}});
  }
  scene.skyMap.emplace();
  scene.skyMap->width = 16;
  scene.skyMap->height = 8;
  for (int i = 0; i < 16 * 8; ++i) scene.skyMap->radiance.emplace_back(0.1F + 0.01F * static_cast<float>(i % 16));
  scene.skyMap->radiance[2 * 16 + 5] = glm::vec3(40.0F, 30.0F, 20.0F);
  return scene;
}

}  // namespace

using Agreements = TracingTest;

TEST_F(Agreements, OfAllLightsAndBothDiffuseLobes) {
  for (const render::DiffuseModel model : {render::DiffuseModel::Lambert, render::DiffuseModel::Disney}) {
    render::Scene scene = everything();
    scene.diffuseModel = model;
    Pair pair(gpu, std::move(scene));
    pair.moveTo(9);
    const SamplingSettings settings = settingsOf(render::Sampler::Kind::BlueNoise, 0, 9);
    expectAgreement(pair.onProcessor(settings), pair.onDevice(settings));
    constexpr std::uint32_t kFewFrames = 24;
    expectSameMeans(pair, kFewFrames);
  }
}

TEST_F(Agreements, OfAllRandomNumbersAndOfSparseLight) {
  Pair pair(gpu, everything());
  pair.moveTo(3);
  for (const render::Sampler::Kind kind :
       {render::Sampler::Kind::Sobol, render::Sampler::Kind::BlueNoise, render::Sampler::Kind::Independent}) {
    SamplingSettings settings = settingsOf(kind, 77, 1000);
    expectAgreement(pair.onProcessor(settings), pair.onDevice(settings));
    settings.light = {.columns = 2};
    settings.lightOffset = {1, 0};
    expectAgreement(pair.onProcessor(settings), pair.onDevice(settings));
  }
}

TEST_F(Agreements, OfSpecularLight) {
  render::Scene scene = everything();
  scene.specular = true;
  scene.materials[0].metallic = 0.5F;
  scene.materials[0].roughness = 0.35F;
  scene.materials[1].metallic = 1.0F;  // Without diffuse light.
  scene.materials[1].roughness = 0.0F;
  Pair pair(gpu, std::move(scene));
  pair.moveTo(3);
  SamplingSettings settings = settingsOf(render::Sampler::Kind::BlueNoise, 4, 3);
  expectAgreement(pair.onProcessor(settings), pair.onDevice(settings));
  settings.light = {.columns = 2};
  settings.gbuffer = render::GBufferMode::BehindMirrors;
  expectAgreement(pair.onProcessor(settings), pair.onDevice(settings));
  settings = settingsOf(render::Sampler::Kind::Sobol, 5, 0);
  settings.samples = 4;
  expectAgreement(pair.onProcessor(settings), pair.onDevice(settings));
  settings.gbuffer = render::GBufferMode::BehindMirrors;
  std::uint64_t rays = 0;
  const Reference cpu = renderReference(pair.world(), pair.view(), settings, {true, 2}, rays);
  const Reference gpu = pair.tracer().reference(pair.view(), settings, {true, 2}, rays);
  std::size_t agreeing = 0;
  for (std::size_t i = 0; i < cpu.specular.pixelCount(); ++i) {
    const auto same = [&](const Image& a, const Image& b) {
      const auto at = [&](const Image& image) {
        return glm::vec3(image.pixel(i)[0], image.pixel(i)[1], image.pixel(i)[2]);
      };
      return std::isnan(at(a).x) ? std::isnan(at(b).x) : agree(at(a), at(b));
    };
    agreeing += same(cpu.specular, gpu.specular) && same(cpu.specularHalf, gpu.specularHalf) ? 1 : 0;
  }
  // See `OfReferences`.
  EXPECT_GE(static_cast<double>(agreeing), 0.96 * static_cast<double>(cpu.specular.pixelCount()));
}

// A mirror shows a wall, which reflects a moving ceiling: in the virtual image, it moves the other way up.
TEST_F(Agreements, OfMotionBehindMirrors) {
  render::test::SceneBuilder builder;
  builder.sky({0.5F, 0.6F, 0.7F}).scene().specular = true;
  const std::uint32_t mirror = builder.material({0.9F, 0.8F, 0.7F}, {0.1F, 0.2F, 0.3F});
  const std::uint32_t wall = builder.material({0.5F, 0.4F, 0.3F});
  builder.scene().materials[mirror].metallic = 1.0F;
  builder.scene().materials[mirror].roughness = 0.0F;
  builder.scene().materials[wall].roughness = 0.3F;
  builder.quad(mirror, {-9.0F, 0.0F, 9.0F}, {18.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -18.0F});
  builder.quad(wall, {-9.0F, 0.0F, -4.0F}, {18.0F, 0.0F, 0.0F}, {0.0F, 9.0F, 0.0F});
  builder.move(builder.quad(wall, {-9.0F, 4.0F, -9.0F}, {18.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 12.0F}), glm::vec3(0.0F),
               {0.4F, 0.9F, 0.1F});
  builder.camera({0.0F, 2.0F, 2.0F}, {0.0F, 0.0F, -2.0F});
  Pair pair(gpu, std::move(builder.scene()));
  pair.moveTo(3);
  SamplingSettings settings = settingsOf(render::Sampler::Kind::BlueNoise, 4, 3);
  settings.gbuffer = render::GBufferMode::BehindMirrors;
  expectAgreement(pair.onProcessor(settings), pair.onDevice(settings));
}

// A reference of an odd and of an even number of samples, with all its options.
TEST_F(Agreements, OfReferences) {
  Pair pair(gpu, everything());
  pair.moveTo(3);
  for (const std::uint32_t samples : {3U, 8U}) {
    for (const render::ReferenceCoverage coverage : {render::ReferenceCoverage{}, render::ReferenceCoverage{true, 2}}) {
      SamplingSettings settings = settingsOf(render::Sampler::Kind::Sobol, 5, 0);
      settings.samples = samples;
      std::uint64_t cpuRays = 0;
      std::uint64_t gpuRays = 0;
      const Reference cpu = renderReference(pair.world(), pair.view(), settings, coverage, cpuRays);
      const Reference gpu = pair.tracer().reference(pair.view(), settings, coverage, gpuRays);
      ASSERT_EQ(gpu.indirectHalf.pixelCount(), cpu.indirectHalf.pixelCount());
      std::size_t agreeing = 0;
      std::size_t missing = 0;
      for (std::size_t i = 0; i < cpu.direct.pixelCount(); ++i) {
        const auto at = [&](const Image& image) {
          return glm::vec3(image.pixel(i)[0], image.pixel(i)[1], image.pixel(i)[2]);
        };
        const bool absent = std::isnan(at(cpu.direct).x);
        ASSERT_EQ(std::isnan(at(gpu.direct).x), absent);
        missing += absent ? 1 : 0;
        const bool halves = samples % 2 != 0 || absent || agree(at(cpu.indirectHalf), at(gpu.indirectHalf));
        agreeing +=
            absent || (halves && agree(at(cpu.direct), at(gpu.direct)) && agree(at(cpu.indirect), at(gpu.indirect)))
                ? 1
                : 0;
      }
      const auto pixels = static_cast<double>(cpu.direct.pixelCount());
      EXPECT_EQ(missing > 0, coverage.oneSquareIn > 1);
      // One of several samples that goes another way makes a pixel differ, so that each sample may take its hundredth.
      EXPECT_GE(static_cast<double>(agreeing), (1.0 - 0.01 * samples) * pixels);
      EXPECT_NEAR(static_cast<double>(gpuRays), static_cast<double>(cpuRays), 0.02 * static_cast<double>(cpuRays));
    }
  }
}

}  // namespace walr::gpu_render::test
