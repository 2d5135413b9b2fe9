// The specular lobe: its density, its albedo and its light, compared with numerical integrals and with a tracer that
// knows neither visible normals nor lamps.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "samples/render/exact/specular.h"
#include "samples/render/film.h"
#include "samples/render/path_tracer.h"
#include "tests/render/ggx.h"
#include "tests/render/scene_builder.h"
#include "tests/render/statistics.h"

namespace walr::render::specular_test {
namespace {

using test::kConfidence;
using test::SceneBuilder;
using test::Statistics;

constexpr double kPi = std::numbers::pi;

std::uint32_t material(SceneBuilder& builder, const glm::vec3& color, float metallic, float roughness,
                       const glm::vec3& emission = glm::vec3(0.0F)) {
  const std::uint32_t index = builder.material(color, emission);
  builder.scene().materials[index].metallic = metallic;
  builder.scene().materials[index].roughness = roughness;
  builder.scene().specular = true;
  return index;
}

void floor(SceneBuilder& builder, std::uint32_t material) {
  builder.quad(material, {-9.0F, 0.0F, 9.0F}, {18.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -18.0F});
}

View viewOf(const World& world, std::uint32_t camera) {
  return viewFrom(world, camera, 1, 1, glm::vec2(0.0F), glm::vec2(0.0F));
}

Statistics gather(const World& world, const Surface& surface, std::uint32_t bounces, Lobe lobe, int paths) {
  Statistics light;
  for (int i = 0; i < paths; ++i) {
    Sampler sampler(Sampler::Kind::Independent, 3, 0, static_cast<std::uint32_t>(i));
    const PathSample path = tracePath(world, surface, bounces, sampler, lobe);
    light.add(path.direct.x + path.indirect.x);
  }
  return light;
}

// What the header states.
TEST(Specular, AlbedoIsNearTheIntegral) {
  for (int i = 0; i <= 20; ++i) {
    for (const double cosine : {0.02, 0.05, 0.1, 0.2, 0.3, 0.45, 0.6, 0.8, 1.0}) {
      const double roughness = std::max(i / 20.0, 0.01);
      SCOPED_TRACE(testing::Message() << "roughness " << roughness << ", cosine " << cosine);
      const auto fit = [&](double reflectance) {
        return double(walrSpecularAlbedo(float(reflectance), float(roughness), float(cosine)));
      };
      const double dark = test::directionalAlbedo(cosine, roughness, 0.0);
      const double bright = test::directionalAlbedo(cosine, roughness, 1.0);
      EXPECT_NEAR(fit(1.0), bright, 0.015);
      for (const double reflectance : {0.04, 0.3}) {
        const double integral = std::max(dark + reflectance * (bright - dark), 0.02);
        EXPECT_NEAR(fit(reflectance), integral, 0.07 * integral) << "reflectance " << reflectance;
      }
    }
  }
  EXPECT_EQ(walrSpecularAlbedo(0.0F, 0.5F, 1.0F), 0.02F);
  for (const float corner : {0.0F, 1.0F}) EXPECT_LE(walrSpecularAlbedo(1.0F, corner, 0.0F), 1.0F);
}

// Counts samples in bins of equal solid angle. By Pearson's test their sum of squares has the mean of the number of
// bins; five standard deviations more are exceeded once in thousands of tests.
TEST(Specular, SamplesFollowTheirDensity) {
  constexpr int kHeights = 12;
  constexpr int kAngles = 16;
  constexpr int kSamples = 40000;
  constexpr int kSteps = 24;  // Of the midpoint rule in a bin, along each axis.
  const glm::vec3 normal = glm::normalize(glm::vec3(0.3F, 0.5F, -0.8F));
  for (const float roughness : {0.4F, 0.7F, 1.0F}) {
    for (const float cosine : {1.0F, 0.6F, 0.05F}) {
      SCOPED_TRACE(testing::Message() << "roughness " << roughness << ", cosine " << cosine);
      const float alpha = exact::alphaOf(roughness);
      const glm::vec3 viewer = exact::fromLocal(normal, {std::sqrt(1.0F - cosine * cosine), 0.0F, cosine});
      std::array<double, kHeights * kAngles> counts{};
      double above = 0.0;
      for (int i = 0; i < kSamples; ++i) {
        Sampler sampler(Sampler::Kind::Independent, 7, 0, static_cast<std::uint32_t>(i));
        const glm::vec3 light =
            exact::toLocal(normal, exact::reflectionDirection(normal, viewer, alpha, sampler.next2D()));
        EXPECT_NEAR(glm::length(light), 1.0F, 1e-5F);
        if (light.z <= 0.0F) continue;
        const int row = std::min(static_cast<int>(light.z * kHeights), kHeights - 1);
        const double turn = std::atan2(light.y, light.x) / (2.0 * kPi) + 0.5;
        counts.at(static_cast<std::size_t>(row * kAngles + std::min(static_cast<int>(turn * kAngles), kAngles - 1))) +=
            1;
        above += 1.0;
      }
      double deviation = 0.0;
      double all = 0.0;
      int bins = 0;
      for (int bin = 0; bin < kHeights * kAngles; ++bin) {
        double mean = 0.0;
        for (int k = 0; k < kSteps * kSteps; ++k) {
          const double z = (bin / kAngles + (k / kSteps + 0.5) / kSteps) / kHeights;
          const double angle = 2.0 * kPi * ((bin % kAngles + (k % kSteps + 0.5) / kSteps) / kAngles - 0.5);
          const double radius = std::sqrt(1.0 - z * z);
          const glm::vec3 light =
              exact::fromLocal(normal, glm::vec3(radius * std::cos(angle), radius * std::sin(angle), z));
          mean += exact::specularLobe(normal, viewer, light, alpha).density;
        }
        mean *= 2.0 * kPi / (kHeights * kAngles) / (kSteps * kSteps) * kSamples;
        all += mean;
        if (mean < 5.0) continue;  // Too few for the test.
        const double difference = counts.at(static_cast<std::size_t>(bin)) - mean;
        deviation += difference * difference / mean;
        ++bins;
      }
      EXPECT_LT(deviation, bins + 5.0 * std::sqrt(2.0 * bins));
      // No binomial's standard deviation is above the first term; the midpoint rule errs by less than the second.
      EXPECT_NEAR(above, all, kConfidence * std::sqrt(double(kSamples)) / 2.0 + 1e-3 * kSamples);
    }
  }
}

// Under a sky of radiance 1, a metal that reflects all reflects what single scattering leaves, which is less than 1.
TEST(Specular, WhiteFurnaceMatchesTheIntegral) {
  for (const float roughness : {0.0F, 0.15F, 0.4F, 0.7F, 1.0F}) {
    for (const float height : {0.3F, 2.0F}) {
      SCOPED_TRACE(testing::Message() << "roughness " << roughness << ", height " << height);
      SceneBuilder builder;
      builder.sky(glm::vec3(1.0F));
      floor(builder, material(builder, glm::vec3(1.0F), 1.0F, roughness));
      const std::uint32_t camera = builder.camera({0.0F, height, 2.0F}, {0.0F, 0.0F, 0.0F});
      const World world(builder.scene());
      const Surface surface = tracePrimary(world, viewOf(world, camera), 0, 0).surface.value();
      const double cosine = glm::dot(surface.shadingNormal, surface.towardsViewer);
      const double integral = test::directionalAlbedo(cosine, std::max(roughness, 0.01F), 1.0);
      const Statistics light = gather(world, surface, 4, Lobe::Specular, 20000);
      // The midpoint rule errs by less than 0.001: eight times the steps change integrals by 0.0002.
      EXPECT_NEAR(light.mean(), integral, kConfidence * light.standardError() + 0.001);
      EXPECT_LT(light.mean(), 1.0 + 1e-6);
    }
  }
}

// A tracer that samples all directions alike, finds lamps by hitting them only, and takes the BRDF from the
// specification: the mix of a dielectric and a metal. The first vertex has one lobe, as in `tracePath`.
double bruteForce(const World& world, const Surface& first, std::uint32_t bounces, Lobe lobe, Sampler& sampler) {
  double light = 0.0;
  double throughput = 1.0;
  Surface surface = first;
  for (std::uint32_t bounce = 0; bounce <= bounces; ++bounce) {
    const glm::vec2 random = sampler.next2D();
    const double z = random.x;
    const double radius = std::sqrt(1.0 - z * z);
    const double angle = 2.0 * kPi * random.y;
    const glm::vec3 direction =
        exact::fromLocal(surface.shadingNormal, glm::vec3(radius * std::cos(angle), radius * std::sin(angle), z));
    if (!(z > 0.0) || glm::dot(direction, surface.geometricNormal) <= 0.0F) return light;
    const glm::dvec3 viewer(surface.towardsViewer);
    const double seen = glm::dot(viewer, glm::normalize(viewer + glm::dvec3(direction)));
    const double specular = test::ggx(surface.shadingNormal, viewer, direction, surface.roughness);
    const double dielectric = test::schlick(0.04, seen);
    const double metallic = surface.metallic;
    const double ofDiffuse = (1.0 - dielectric) / kPi;
    const double ofSpecular =
        (1.0 - metallic) * dielectric * specular + metallic * test::schlick(surface.reflectance.x, seen) * specular;
    const double color = surface.reflectance.x * (1.0 - metallic);
    double brdf = color * ofDiffuse + ofSpecular;
    if (bounce == 0) brdf = lobe == Lobe::Diffuse ? ofDiffuse : ofSpecular;
    throughput *= brdf * z * 2.0 * kPi;
    const Ray ray{rayOrigin(surface, direction), direction};
    const std::optional<Hit> hit = world.rays().closest(ray);
    if (!hit) return light + throughput * world.sky().radiance(direction).x;
    surface = evaluateSurface(world.scene(), world.instances()[hit->instance], *hit, ray);
    light += throughput * surface.emission.x;
  }
  return light;
}

// A floor, and beside it a wall under a wide lamp: light comes straight, over the other surface, and from a lamp that
// both ways of sampling find.
TEST(Specular, AgreesWithASimpleTracer) {
  struct Case {
    float metallic;
    float roughness;
    std::uint32_t bounces;
  };
  for (const Case& test : {Case{0.0F, 0.5F, 2}, Case{1.0F, 0.45F, 2}, Case{0.4F, 0.8F, 3}}) {
    SCOPED_TRACE(testing::Message() << "metallic " << test.metallic << ", roughness " << test.roughness);
    SceneBuilder builder;
    builder.sky(glm::vec3(0.3F));
    floor(builder, material(builder, glm::vec3(0.7F), test.metallic, test.roughness));
    builder.quad(material(builder, glm::vec3(0.8F), 1.0F - test.metallic, 0.6F), {-9.0F, 0.0F, -1.0F},
                 {18.0F, 0.0F, 0.0F}, {0.0F, 9.0F, 0.0F});
    builder.quad(material(builder, glm::vec3(0.5F), 0.0F, 1.0F, glm::vec3(5.0F)), {-1.0F, 2.0F, -0.9F},
                 {2.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.5F});
    const std::uint32_t camera = builder.camera({0.0F, 1.2F, 2.0F}, {0.0F, 0.0F, 0.0F});
    const World world(builder.scene());
    const Surface surface = tracePrimary(world, viewOf(world, camera), 0, 0).surface.value();
    for (const Lobe lobe : {Lobe::Diffuse, Lobe::Specular}) {
      if (lobe == Lobe::Diffuse && test.metallic == 1.0F) continue;
      const Statistics light = gather(world, surface, test.bounces, lobe, 15000);
      Statistics expected;
      for (std::uint32_t i = 0; i < 60000; ++i) {
        Sampler sampler(Sampler::Kind::Independent, 11, 0, i);
        expected.add(bruteForce(world, surface, test.bounces, lobe, sampler));
      }
      EXPECT_NEAR(light.mean(), expected.mean(),
                  kConfidence * std::hypot(light.standardError(), expected.standardError()))
          << (lobe == Lobe::Diffuse ? "diffuse" : "specular");
      EXPECT_GT(light.mean(), 0.05);  // Both are not 0.
    }
  }
}

// The film of a mirror: light without albedo, and distances.
TEST(Specular, FilmOfAMirrorShowsWhatItReflects) {
  SceneBuilder builder;
  floor(builder, material(builder, {0.9F, 0.6F, 0.3F}, 1.0F, 0.0F));
  builder.quad(material(builder, glm::vec3(0.0F), 0.0F, 1.0F, {2.0F, 3.0F, 4.0F}), {-9.0F, 0.0F, -4.0F},
               {18.0F, 0.0F, 0.0F}, {0.0F, 9.0F, 0.0F});
  // At 45 degrees: 1 from the mirror's point to the wall in z, and 1 up.
  const std::uint32_t camera = builder.camera({0.0F, 2.0F, -1.0F}, {0.0F, 0.0F, -3.0F});
  World world(builder.scene());
  SamplingSettings settings;
  settings.samples = 4;
  const Film film = renderFilm(world, viewOf(world, camera), settings);
  ASSERT_EQ(film.specular.size(), 1U);
  const SpecularPixel& pixel = film.specular[0];
  const glm::vec3 color(0.9F, 0.6F, 0.3F);
  const glm::vec3 emission(2.0F, 3.0F, 4.0F);
  const float fresnel = std::pow(1.0F - std::sqrt(0.5F), 5.0F);
  for (int c = 0; c < 3; ++c) {
    // Lobes as narrow as a mirror's lose less than a thousandth of light.
    EXPECT_NEAR(pixel.light[c] * pixel.albedo[c], emission[c] * (color[c] + (1.0F - color[c]) * fresnel), 0.004F);
  }
  EXPECT_NEAR(pixel.distance, std::sqrt(2.0F), 0.002F);
  EXPECT_EQ(pixel.roughness, 0.0F);

  settings.light = {.columns = 2};
  settings.lightOffset = {1, 0};  // The only pixel has no sample.
  const SpecularPixel without = renderFilm(world, viewOf(world, camera), settings).specular[0];
  EXPECT_EQ(without.light, glm::vec3(0.0F));
  EXPECT_EQ(without.distance, 0.0F);
  EXPECT_EQ(without.albedo, pixel.albedo);
}

// A floor that reflects the point (0, 1, -4) of a wall to a camera with one pixel.
struct WallInAMirror {
  explicit WallInAMirror(float roughness = 0.0F) {
    floor(builder, material(builder, glm::vec3(0.9F), 1.0F, roughness));
    wall = builder.quad(material(builder, glm::vec3(0.5F), 0.0F, 1.0F), {-9.0F, -1.0F, -4.0F}, {18.0F, 0.0F, 0.0F},
                        {0.0F, 9.0F, 0.0F});
    camera = builder.camera({0.0F, 2.0F, -1.0F}, {0.0F, 0.0F, -3.0F});
  }
  [[nodiscard]] SpecularPixel render(double seconds, double previousSeconds, const SamplingSettings& settings = {}) {
    World world(builder.scene());
    world.moveTo(seconds, previousSeconds);
    return renderFilm(world, viewOf(world, camera), settings).specular.at(0);
  }

  SceneBuilder builder;
  std::uint32_t wall = 0;
  std::uint32_t camera = 0;
};

TEST(SpecularMotion, IsThatOfWhatAMirrorShows) {
  const glm::vec3 way(0.4F, -0.2F, 0.1F);
  WallInAMirror moving;
  moving.builder.move(moving.wall, -0.5F * way, 0.5F * way);
  EXPECT_LT(glm::distance(moving.render(0.5, 0.25).motion, -0.25F * way), 1e-5F);
  EXPECT_EQ(moving.render(0.5, 0.5).motion, glm::vec3(0.0F));
  EXPECT_EQ(moving.render(3.0, 2.0).motion, glm::vec3(0.0F));  // The animation has ended.

  WallInAMirror still;
  EXPECT_EQ(still.render(0.5, 0.25).motion, glm::vec3(0.0F));
  still.builder.move(still.camera, {0.0F, 2.0F, -1.0F}, {0.0F, 2.1F, -1.0F});
  EXPECT_EQ(still.render(0.5, 0.25).motion, glm::vec3(0.0F));

  // About the wall's normal. The lobe of the mirror is a thousandth wide.
  WallInAMirror turning;
  turning.builder.turn(turning.wall, glm::angleAxis(-0.4F, glm::vec3(0.0F, 0.0F, 1.0F)),
                       glm::angleAxis(0.4F, glm::vec3(0.0F, 0.0F, 1.0F)));
  const glm::vec3 arc(std::sin(0.2F), std::cos(0.2F) - 1.0F, 0.0F);
  EXPECT_LT(glm::distance(turning.render(0.5, 0.25).motion, arc), 1e-3F);

  SamplingSettings unsampled;
  unsampled.light = {.columns = 2};
  unsampled.lightOffset = {1, 0};
  EXPECT_EQ(moving.render(0.5, 0.25, unsampled).motion, glm::vec3(0.0F));
}

// Of a rough floor, some paths meet the wall and some the sky, which does not move.
TEST(SpecularMotion, IsTheMeanOverThePaths) {
  const glm::vec3 way(0.4F, -0.2F, 0.1F);
  WallInAMirror rough(0.6F);
  rough.builder.move(rough.wall, -0.5F * way, 0.5F * way);
  SamplingSettings settings;
  constexpr std::uint32_t kPaths = 32;
  glm::vec3 sum(0.0F);
  std::uint32_t toTheWall = 0;
  for (settings.firstSample = 0; settings.firstSample < kPaths; ++settings.firstSample) {
    const SpecularPixel pixel = rough.render(0.5, 0.25, settings);
    EXPECT_EQ(pixel.motion == glm::vec3(0.0F), pixel.distance >= kBackgroundDepth);
    sum += pixel.motion;
    toTheWall += pixel.distance < kBackgroundDepth ? 1 : 0;
  }
  EXPECT_GT(toTheWall, 4U);
  EXPECT_LT(toTheWall, kPaths - 4U);
  settings.firstSample = 0;
  settings.samples = kPaths;
  EXPECT_LT(glm::distance(rough.render(0.5, 0.25, settings).motion, sum / float{kPaths}), 1e-6F);
}

}  // namespace
}  // namespace walr::render::specular_test
