// Compares the path tracer with scenes whose light is known in closed form, and with an independent, simpler tracer.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "samples/render/film.h"
#include "samples/render/gbuffer.h"
#include "samples/render/path_tracer.h"
#include "samples/render/view.h"
#include "samples/render/world.h"
#include "tests/render/scene_builder.h"
#include "tests/render/statistics.h"

namespace walr::render::light_test {
namespace {

using test::kConfidence;
using test::SceneBuilder;
using test::Statistics;

constexpr double kPi = std::numbers::pi;

// The surface that a camera sees in the middle of its image.
Surface surfaceSeen(const World& world, std::uint32_t camera) {
  const View view = viewFrom(world, camera, 1, 1, glm::vec2(0.0F), glm::vec2(0.0F));
  return tracePrimary(world, view, 0, 0).surface.value();
}

struct Light {
  Statistics direct;
  Statistics indirect;
};

// The red channel of the light at a surface, from many independent paths.
Light gather(const World& world, const Surface& surface, std::uint32_t bounces, int paths, std::uint32_t seed = 1) {
  Light light;
  for (int i = 0; i < paths; ++i) {
    Sampler sampler(Sampler::Kind::Independent, seed, 0, static_cast<std::uint32_t>(i));
    const PathSample path = tracePath(world, surface, bounces, sampler);
    light.direct.add(path.direct.x);
    light.indirect.add(path.indirect.x);
  }
  return light;
}

// Furnace test: all walls emit e and have the albedo rho, so that n reflections add the radiance e rho^n everywhere.
TEST(Light, FurnaceMatchesTheGeometricSeries) {
  constexpr float kEmission = 0.5F;
  constexpr float kAlbedo = 0.8F;
  constexpr std::uint32_t kBounces = 4;
  SceneBuilder builder;
  builder.room(builder.material(glm::vec3(kAlbedo), glm::vec3(kEmission)), glm::vec3(-1.0F, -2.0F, -3.0F),
               glm::vec3(1.0F));
  const std::uint32_t camera = builder.camera(glm::vec3(0.2F, -0.3F, 0.0F), glm::vec3(0.1F, -2.0F, -1.0F));
  const World world(builder.scene());
  const Light light = gather(world, surfaceSeen(world, camera), kBounces, 40000);
  double reflected = 0.0;
  for (std::uint32_t n = 1; n <= kBounces; ++n) {
    reflected += kEmission * std::pow(kAlbedo, n);
  }
  EXPECT_NEAR(light.direct.mean(), kEmission, kConfidence * light.direct.standardError());
  EXPECT_NEAR(light.indirect.mean(), reflected, kConfidence * light.indirect.standardError());
}

// Under a sky of radiance 1, a white folded surface has radiance 1: each side of the fold reflects as much light to the
// other as it hides from it.
TEST(Light, WhiteFoldUnderAWhiteSkyIsWhite) {
  SceneBuilder builder;
  builder.sky(glm::vec3(1.0F));
  const std::uint32_t white = builder.material(glm::vec3(1.0F));
  builder.quad(white, glm::vec3(0.0F, 0.0F, -50.0F), glm::vec3(0.0F, 0.0F, 100.0F), glm::vec3(1.0F, 1.0F, 0.0F));
  builder.quad(white, glm::vec3(0.0F, 0.0F, 50.0F), glm::vec3(0.0F, 0.0F, -100.0F), glm::vec3(-1.0F, 1.0F, 0.0F));
  const std::uint32_t camera = builder.camera(glm::vec3(0.0F, 3.0F, 0.0F), glm::vec3(0.3F, 0.3F, 0.0F));
  const World world(builder.scene());
  constexpr std::uint32_t kManyBounces = 64;
  const Light light = gather(world, surfaceSeen(world, camera), kManyBounces, 40000);
  const double error = std::hypot(light.direct.standardError(), light.indirect.standardError());
  EXPECT_NEAR(light.direct.mean() + light.indirect.mean(), 1.0, kConfidence * error);
  EXPECT_GT(light.indirect.mean(), 0.1);
}

TEST(Light, SunOnAFloorIsIrradianceOverPi) {
  SceneBuilder builder;
  builder.quad(builder.material(glm::vec3(0.5F)), glm::vec3(-5.0F, 0.0F, 5.0F), glm::vec3(10.0F, 0.0F, 0.0F),
               glm::vec3(0.0F, 0.0F, -10.0F));
  Transform transform;
  const glm::vec3 shining = glm::normalize(glm::vec3(0.3F, -1.0F, -0.4F));
  transform.rotation = glm::quatLookAtRH(shining, glm::vec3(0.0F, 0.0F, 1.0F));
  PunctualLight sun;
  sun.kind = PunctualLight::Kind::Directional;
  sun.intensity = glm::vec3(14.0F);
  builder.light(sun, transform);
  const std::uint32_t camera = builder.camera(glm::vec3(0.0F, 2.0F, 2.0F), glm::vec3(0.0F));
  const World world(builder.scene());
  const Light light = gather(world, surfaceSeen(world, camera), 4, 100);
  // There is no noise, only the rounding errors of some tens of single-precision operations.
  EXPECT_NEAR(light.direct.mean(), 14.0 * -shining.y / kPi, 1e-5 * 14.0);
  EXPECT_EQ(light.direct.variance(), 0.0);
  EXPECT_EQ(light.indirect.mean(), 0.0);
}

TEST(Light, PointAndSpotFallOffWithTheSquaredDistance) {
  SceneBuilder builder;
  builder.quad(builder.material(glm::vec3(0.5F)), glm::vec3(-5.0F, 0.0F, 5.0F), glm::vec3(10.0F, 0.0F, 0.0F),
               glm::vec3(0.0F, 0.0F, -10.0F));
  Transform transform;
  transform.translation = glm::vec3(0.0F, 2.0F, 0.0F);
  transform.rotation = glm::quatLookAtRH(glm::vec3(0.0F, -1.0F, 0.0F), glm::vec3(0.0F, 0.0F, 1.0F));
  PunctualLight light;
  light.intensity = glm::vec3(3.0F);
  const std::uint32_t node = builder.light(light, transform);
  const std::uint32_t camera = builder.camera(glm::vec3(1.0F, 2.0F, 2.0F), glm::vec3(1.0F, 0.0F, 0.0F));
  PunctualLight& placed = builder.scene().lights[*builder.scene().nodes[node].light];
  const auto direct = [&] {
    const World world(builder.scene());
    return gather(world, surfaceSeen(world, camera), 0, 1000).direct.mean();
  };
  // At (1, 0, 0) below a light at height 2: distance squared 5, cosine 2 / sqrt(5).
  const double cosine = 2.0 / std::sqrt(5.0);
  const double expected = 3.0 / 5.0 * cosine / kPi;
  EXPECT_NEAR(direct(), expected, 1e-5);
  placed.kind = PunctualLight::Kind::Spot;
  placed.cosInnerCone = static_cast<float>(cosine) - 0.01F;
  placed.cosOuterCone = 0.1F;
  EXPECT_NEAR(direct(), expected, 1e-5);
  placed.cosInnerCone = 0.95F;
  placed.cosOuterCone = 0.75F;
  const double fade = (cosine - 0.75) / (0.95 - 0.75);
  EXPECT_NEAR(direct(), expected * fade * fade, 1e-5);
  placed.cosOuterCone = static_cast<float>(cosine) + 0.01F;
  EXPECT_EQ(direct(), 0.0);
}

// Form factor from an element to a parallel square of side 2a at height h above it: four times B-3 of Howell, A Catalog
// of Radiation Heat Transfer Configuration Factors.
TEST(Light, SquareLampMatchesItsFormFactor) {
  constexpr float kHalf = 0.5F;
  constexpr float kHeight = 1.5F;
  SceneBuilder builder;
  builder.quad(builder.material(glm::vec3(0.5F)), glm::vec3(-5.0F, 0.0F, 5.0F), glm::vec3(10.0F, 0.0F, 0.0F),
               glm::vec3(0.0F, 0.0F, -10.0F));
  builder.quad(builder.material(glm::vec3(0.0F), glm::vec3(7.0F)), glm::vec3(-kHalf, kHeight, -kHalf),
               glm::vec3(2.0F * kHalf, 0.0F, 0.0F), glm::vec3(0.0F, 0.0F, 2.0F * kHalf));
  const std::uint32_t camera = builder.camera(glm::vec3(2.0F, 1.0F, 0.0F), glm::vec3(0.0F));
  const World world(builder.scene());
  const Light light = gather(world, surfaceSeen(world, camera), 0, 40000);
  const double x = kHalf / kHeight;
  const double s = std::sqrt(1.0 + x * x);
  const double formFactor = 4.0 * (2.0 * x / s * std::atan(x / s)) / (2.0 * kPi);
  EXPECT_NEAR(light.direct.mean(), 7.0 * formFactor, kConfidence * light.direct.standardError());
  EXPECT_LT(light.direct.standardError(), 0.01 * light.direct.mean());
}

TEST(Light, OneSidedLampIsDarkFromBehind) {
  SceneBuilder builder;
  builder.quad(builder.material(glm::vec3(0.5F)), glm::vec3(-5.0F, 0.0F, 5.0F), glm::vec3(10.0F, 0.0F, 0.0F),
               glm::vec3(0.0F, 0.0F, -10.0F));
  const std::uint32_t lamp = builder.material(glm::vec3(0.0F), glm::vec3(7.0F));
  builder.quad(lamp, glm::vec3(-0.5F, 1.5F, 0.5F), glm::vec3(1.0F, 0.0F, 0.0F), glm::vec3(0.0F, 0.0F, -1.0F));
  const std::uint32_t camera = builder.camera(glm::vec3(2.0F, 1.0F, 0.0F), glm::vec3(0.0F));
  {
    const World world(builder.scene());
    EXPECT_EQ(gather(world, surfaceSeen(world, camera), 0, 1000).direct.mean(), 0.0);
  }
  builder.scene().materials[lamp].doubleSided = true;
  const World world(builder.scene());
  EXPECT_GT(gather(world, surfaceSeen(world, camera), 0, 1000).direct.mean(), 0.1);
}

// A room with two colours, a lamp and an opening to the sky.
std::uint32_t buildBox(SceneBuilder& builder) {
  builder.sky(glm::vec3(0.4F, 0.5F, 0.7F));
  const std::uint32_t white = builder.material(glm::vec3(0.7F));
  const std::uint32_t red = builder.material(glm::vec3(0.6F, 0.1F, 0.1F));
  const std::uint32_t lamp = builder.material(glm::vec3(0.3F), glm::vec3(6.0F));
  builder.quad(white, glm::vec3(-1.0F, -1.0F, 1.0F), glm::vec3(2.0F, 0.0F, 0.0F), glm::vec3(0.0F, 0.0F, -2.0F));
  builder.quad(white, glm::vec3(-1.0F, -1.0F, -1.0F), glm::vec3(2.0F, 0.0F, 0.0F), glm::vec3(0.0F, 2.0F, 0.0F));
  builder.quad(red, glm::vec3(-1.0F, -1.0F, 1.0F), glm::vec3(0.0F, 0.0F, -2.0F), glm::vec3(0.0F, 2.0F, 0.0F));
  builder.quad(white, glm::vec3(1.0F, -1.0F, -1.0F), glm::vec3(0.0F, 0.0F, 2.0F), glm::vec3(0.0F, 2.0F, 0.0F));
  builder.quad(lamp, glm::vec3(-0.4F, 0.9F, -0.4F), glm::vec3(0.8F, 0.0F, 0.0F), glm::vec3(0.0F, 0.0F, 0.8F));
  return builder.camera(glm::vec3(0.0F, 0.0F, 3.0F), glm::vec3(0.3F, -0.9F, -0.2F));
}

// A reference tracer: light is found by cosine-distributed directions only. There is no next-event estimation, no
// weighting, and no split into direct and indirect light.
double oneWalk(const World& world, const Surface& first, std::uint32_t bounces, Sampler& sampler) {
  glm::vec3 throughput(1.0F);
  glm::vec3 sum(0.0F);
  Surface surface = first;
  for (std::uint32_t bounce = 0; bounce <= bounces; ++bounce) {
    // The direction to a uniform point on the unit sphere around the normal's tip is cosine-distributed.
    const glm::vec2 random = sampler.next2D();
    const float z = 1.0F - 2.0F * random.x;
    const float angle = 2.0F * static_cast<float>(kPi) * random.y;
    const float radius = std::sqrt(1.0F - z * z);
    const glm::vec3 direction = glm::normalize(
        surface.shadingNormal + glm::vec3(radius * std::cos(angle), radius * std::sin(angle), z) * 0.99999F);
    const Ray ray{rayOrigin(surface, direction), direction};
    const auto hit = world.rays().closest(ray);
    if (!hit) {
      return (sum + throughput * world.scene().skyRadiance).x;
    }
    surface = evaluateSurface(world.scene(), world.instances()[hit->instance], *hit, ray);
    sum += throughput * surface.emission;
    throughput *= surface.albedo;
  }
  return sum.x;
}

TEST(Light, DirectPlusIndirectMatchesTheReferenceTracer) {
  SceneBuilder builder;
  const std::uint32_t camera = buildBox(builder);
  const World world(builder.scene());
  const Surface surface = surfaceSeen(world, camera);
  constexpr int kPaths = 100000;
  const Light light = gather(world, surface, 4, kPaths);
  Statistics whole;
  for (int i = 0; i < kPaths; ++i) {
    Sampler sampler(Sampler::Kind::Independent, 2, 0, static_cast<std::uint32_t>(i));
    whole.add(oneWalk(world, surface, 4, sampler));
  }
  // Direct and indirect light of one path are correlated: at worst their errors add up.
  const double error = std::hypot(whole.standardError(), light.direct.standardError() + light.indirect.standardError());
  EXPECT_NEAR(light.direct.mean() + light.indirect.mean(), whole.mean(), kConfidence * error);
  EXPECT_LT(error, 0.01 * whole.mean());
}

// Mean squared difference of two renders over the lit pixels.
double meanSquaredDifference(const Film& a, const Film& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.indirect.size(); ++i) {
    const glm::vec3 difference = a.indirect[i] - b.indirect[i];
    sum += glm::dot(difference, difference);
  }
  return sum / static_cast<double>(a.indirect.size());
}

Film renderBox(const World& world, std::uint32_t camera, std::uint32_t samples, std::uint32_t seed,
               Sampler::Kind kind) {
  SamplingSettings settings;
  settings.samples = samples;
  settings.seed = seed;
  settings.sampler = kind;
  return renderFilm(world, viewFrom(world, camera, 48, 32, glm::vec2(0.0F), glm::vec2(0.0F)), settings);
}

TEST(Light, ErrorFallsWithTheSquareRootOfTheSamples) {
  SceneBuilder builder;
  const std::uint32_t camera = buildBox(builder);
  const World world(builder.scene());
  const auto difference = [&](std::uint32_t samples, Sampler::Kind kind) {
    return meanSquaredDifference(renderBox(world, camera, samples, 1, kind),
                                 renderBox(world, camera, samples, 2, kind));
  };
  const double few = difference(4, Sampler::Kind::Independent);
  const double many = difference(64, Sampler::Kind::Independent);
  // Each value is a mean of about 1200 squared differences with heavy tails. Its relative standard deviation is below
  // 10 %, that of the ratio below 14 %. The ratio is 16 in theory; the tolerance is four standard deviations.
  EXPECT_NEAR(few / many, 16.0, 0.56 * 16.0);
  // On average, scrambled Sobol points are never worse than independent ones; in smooth parts of the image they are
  // better.
  const double sobol = difference(64, Sampler::Kind::Sobol);
  std::cout << "mean squared error at 64 samples: independent " << many << ", Sobol " << sobol << '\n';
  EXPECT_LT(sobol, many);
}

TEST(Light, IndependentReferencesAgreeWithinTheirNoise) {
  SceneBuilder builder;
  const std::uint32_t camera = buildBox(builder);
  const World world(builder.scene());
  const Film a = renderBox(world, camera, 256, 1, Sampler::Kind::Independent);
  const Film b = renderBox(world, camera, 256, 2, Sampler::Kind::Independent);
  Statistics difference;
  for (std::size_t i = 0; i < a.indirect.size(); ++i) {
    difference.add(static_cast<double>(a.indirect[i].x) - b.indirect[i].x);
  }
  EXPECT_NEAR(difference.mean(), 0.0, kConfidence * difference.standardError());
  // The relative error of one path is about 2, that of 256 paths 1/8, that of the difference of two renders 0.18.
  Statistics light;
  for (const glm::vec3& value : a.indirect) {
    light.add(value.x);
  }
  EXPECT_LT(std::sqrt(difference.variance()), 0.18 * light.mean());
}

TEST(Light, ResultDoesNotDependOnTheNumberOfThreads) {
  SceneBuilder builder;
  const std::uint32_t camera = buildBox(builder);
  const World world(builder.scene());
  const View view = viewFrom(world, camera, 33, 17, glm::vec2(0.0F), glm::vec2(0.0F));
  SamplingSettings settings;
  settings.threads = 1;
  const Film one = renderFilm(world, view, settings);
  settings.threads = 3;
  const Film three = renderFilm(world, view, settings);
  EXPECT_EQ(one.indirect, three.indirect);
  EXPECT_EQ(one.direct, three.direct);
  EXPECT_EQ(one.rays, three.rays);
}

}  // namespace
}  // namespace walr::render::light_test
