// Temporal resampling against what theory says of it: in a still picture, luminance is the running mean of that of the
// paths; with a moving camera, the expected value is that of the paths.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>

#include "samples/image/luminance.h"
#include "samples/render/film.h"
#include "samples/render/resampling.h"
#include "tests/render/scene_builder.h"
#include "tests/render/statistics.h"

namespace walr::render::resampling_test {
namespace {

using test::kConfidence;
using test::SceneBuilder;
using test::Statistics;

constexpr std::uint32_t kWidth = 24;
constexpr std::uint32_t kHeight = 16;
constexpr float kManyFrames = 1000.0F;

double luminanceOf(const glm::vec3& colour) {
  return luminance(std::span<const float>(&colour.x, 3));
}

// A room with two blocks, lit by a point light near the ceiling; its camera moves towards a corner.
struct Room {
  SceneBuilder builder;
  std::uint32_t camera = 0;

  Room() {
    const glm::vec3 target(-0.9F, 0.2F, -1.9F);
    builder.room(builder.material({0.8F, 0.6F, 0.5F}), {-1.0F, 0.0F, -2.0F}, {1.0F, 2.0F, 1.0F});
    builder.quad(builder.material({0.3F, 0.7F, 0.9F}), {-0.6F, 0.0F, -1.5F}, {0.5F, 0.0F, 0.0F}, {0.0F, 0.8F, 0.0F});
    PunctualLight light;
    light.intensity = glm::vec3(2.0F);
    Transform place;
    place.translation = {0.4F, 1.8F, -0.8F};
    builder.light(light, place);
    const glm::vec3 from(0.5F, 1.0F, 0.5F);
    camera = builder.camera(from, target);
    builder.move(camera, from, glm::mix(from, target, 0.8F));
  }
};

// Frames of a sequence in which the camera is at the time frame x step.
std::vector<Film> renderFrames(World& world, std::uint32_t camera, double step, int frames, std::uint32_t seed,
                               Reservoirs* reservoirs, std::uint32_t samples = 1) {
  std::vector<Film> films;
  for (int frame = 0; frame < frames; ++frame) {
    world.moveTo(frame * step, (frame - 1) * step);
    SamplingSettings settings;
    settings.samples = samples;
    settings.seed = seed;
    settings.firstSample = static_cast<std::uint32_t>(frame) * samples;
    settings.sampler = Sampler::Kind::Independent;
    settings.reservoirs = reservoirs;
    const View view = viewFrom(world, camera, kWidth, kHeight, glm::vec2(0.0F), glm::vec2(0.0F));
    films.push_back(renderFilm(world, view, settings));
  }
  return films;
}

TEST(Resampling, KeepsTheFirstFrameAndDirectLight) {
  Room room;
  World world(room.builder.scene());
  Reservoirs reservoirs(kWidth, kHeight, kManyFrames);
  const std::vector<Film> plain = renderFrames(world, room.camera, 0.0, 2, 1, nullptr);
  const std::vector<Film> resampled = renderFrames(world, room.camera, 0.0, 2, 1, &reservoirs);
  EXPECT_EQ(resampled[1].direct, plain[1].direct);
  for (std::size_t i = 0; i < plain[0].indirect.size(); ++i) {
    // The contribution is computed again from the source's position: single precision, relative to a distance of 3.
    EXPECT_NEAR(glm::length(resampled[0].indirect[i] - plain[0].indirect[i]), 0.0,
                1e-4 * glm::length(plain[0].indirect[i]))
        << "pixel " << i;
  }
}

// A source is chosen with a probability proportional to its luminance, so that the luminance of the result is the mean
// over all samples, whichever is chosen.
TEST(Resampling, OfAStillPictureHasTheRunningMeanOfLuminance) {
  Room room;
  World world(room.builder.scene());
  constexpr int kFrames = 8;
  Reservoirs reservoirs(kWidth, kHeight, kManyFrames);
  const std::vector<Film> plain = renderFrames(world, room.camera, 0.0, kFrames, 3, nullptr, 2);
  const std::vector<Film> resampled = renderFrames(world, room.camera, 0.0, kFrames, 3, &reservoirs, 2);
  std::size_t differing = 0;
  for (std::size_t i = 0; i < plain[0].indirect.size(); ++i) {
    double sum = 0.0;
    for (const Film& film : plain) sum += luminanceOf(film.indirect[i]);
    const double mean = sum / kFrames;
    differing += std::abs(luminanceOf(resampled.back().indirect[i]) - mean) > 1e-3 * mean ? 1 : 0;
  }
  // A source right beside an edge may be found hidden: the test's ray starts beside the surface.
  EXPECT_LE(differing, plain[0].indirect.size() / 100);
}

TEST(Resampling, HasTheMeanOfPlainPathsWhileTheCameraMoves) {
  Room room;
  World world(room.builder.scene());
  constexpr int kFrames = 6;
  constexpr std::uint32_t kSeeds = 500;
  constexpr double kStep = 0.05;
  Statistics plain;
  Statistics resampled;
  const auto mean = [](const Film& film) {
    double sum = 0.0;
    for (const glm::vec3& light : film.indirect) sum += luminanceOf(light);
    return sum / static_cast<double>(film.indirect.size());
  };
  for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
    Reservoirs reservoirs(kWidth, kHeight, kManyFrames);
    plain.add(mean(renderFrames(world, room.camera, kStep, kFrames, 2 * seed, nullptr).back()));
    resampled.add(mean(renderFrames(world, room.camera, kStep, kFrames, 2 * seed + 1, &reservoirs).back()));
  }
  const double error = std::hypot(plain.standardError(), resampled.standardError());
  std::cout << "plain " << plain.mean() << ", resampled " << resampled.mean() << ", standard error " << error << '\n';
  EXPECT_NEAR(resampled.mean(), plain.mean(), kConfidence * error);
  EXPECT_LT(error, 0.01 * plain.mean());
  EXPECT_LT(resampled.variance(), 0.7 * plain.variance()) << "nothing was reused";
}

// A source one unit above the previous surface point, seen from a point beside it: the density of its direction per
// solid angle is larger there by the ratio of the solid angles, cosine / distance^2.
TEST(Resampling, ConvertsTheDensityToTheNewSurfacePoint) {
  SceneBuilder builder;
  const std::uint32_t material = builder.material(glm::vec3(0.5F));
  builder.quad(material, {-5.0F, -1.0F, -5.0F}, {0.0F, 0.0F, 10.0F}, {10.0F, 0.0F, 0.0F});
  const World world(builder.scene());
  PrimaryHit hit;
  hit.surface.emplace();
  hit.surface->position = {1.0F, 0.0F, 0.0F};
  hit.surface->geometricNormal = hit.surface->shadingNormal = {0.0F, 1.0F, 0.0F};
  Reservoir previous;
  previous.normal = {0.0F, 1.0F, 0.0F};
  previous.source = {{0.0F, 1.0F, 0.0F}, {0.0F, -1.0F, 0.0F}, glm::vec3(2.0F)};
  previous.weight = 3.0F;
  previous.samples = 4.0F;
  const std::vector<PathSample> unlit(1);
  Sampler sampler(Sampler::Kind::Independent, 1, 0, 0);
  const ResampledLight result = resample(world, hit, unlit, previous, kManyFrames, sampler);
  const double cosine = std::sqrt(0.5);
  const double solidAngleRatio = cosine / 2.0;
  const double expected = 2.0 * cosine / std::numbers::pi * 3.0 * solidAngleRatio * 4.0 / 5.0;
  EXPECT_NEAR(result.indirect.x, expected, 1e-6 * expected + 1e-7);
  EXPECT_EQ(result.reservoir.samples, 5.0F);
}

TEST(Resampling, CountsAsManyFramesAsItIsTold) {
  Room room;
  World world(room.builder.scene());
  Reservoirs reservoirs(kWidth, kHeight, 3.0F);
  renderFrames(world, room.camera, 0.0, 6, 1, &reservoirs, 2);
  PrimaryHit hit = tracePrimary(world, viewFrom(world, room.camera, kWidth, kHeight, {}, {}), 5, 7);
  EXPECT_EQ(reservoirs.previous(5, 7, hit).samples, 2.0F * (3.0F + 1.0F));
}

TEST(Resampling, ReusesNothingOfOtherSurfaces) {
  Room room;
  World world(room.builder.scene());
  Reservoirs reservoirs(kWidth, kHeight, kManyFrames);
  renderFrames(world, room.camera, 0.0, 1, 1, &reservoirs);
  const PrimaryHit hit = tracePrimary(world, viewFrom(world, room.camera, kWidth, kHeight, {}, {}), 5, 7);
  ASSERT_EQ(reservoirs.previous(5, 7, hit).samples, 1.0F);

  PrimaryHit other = hit;
  ++other.pixel.objectId;
  EXPECT_EQ(reservoirs.previous(5, 7, other).samples, 0.0F);
  other = hit;
  other.surface->geometricNormal = -hit.surface->geometricNormal;
  EXPECT_EQ(reservoirs.previous(5, 7, other).samples, 0.0F);
  other = hit;
  other.surface->previousPosition += 0.5F * hit.surface->geometricNormal;
  EXPECT_EQ(reservoirs.previous(5, 7, other).samples, 0.0F);
  for (const float motion : {-6.0F, 1e9F, std::numeric_limits<float>::quiet_NaN()}) {
    other = hit;
    other.pixel.motion.x = motion;
    EXPECT_EQ(reservoirs.previous(5, 7, other).samples, 0.0F) << "motion " << motion;
  }
}

}  // namespace
}  // namespace walr::render::resampling_test
