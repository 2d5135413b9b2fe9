// Mirrors that are replaced by what they show are compared with a scene where the mirrored object stands behind the
// mirror's plane.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <tuple>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "samples/render/film.h"
#include "samples/render/gbuffer.h"
#include "samples/render/load_scene.h"
#include "samples/render/view.h"
#include "samples/render/world.h"
#include "tests/render/ggx.h"
#include "tests/render/scene_builder.h"

namespace walr::render::mirrors_test {
namespace {

using test::SceneBuilder;

constexpr std::uint32_t kWidth = 48;
constexpr std::uint32_t kHeight = 32;

std::uint32_t metal(SceneBuilder& builder, const glm::vec3& color, float roughness) {
  const std::uint32_t index = builder.material(color);
  builder.scene().materials[index].metallic = 1.0F;
  builder.scene().materials[index].roughness = roughness;
  return index;
}

/// A point reflected at the plane x = 2.
glm::vec3 imageOf(const glm::vec3& point) {
  return {4.0F - point.x, point.y, point.z};
}
glm::vec3 imageOfDirection(const glm::vec3& direction) {
  return {-direction.x, direction.y, direction.z};
}

/// A moving camera and, to its side, a slanted moving board. Either a mirror shows the board, or the board's mirror
/// image stands behind the plane of the mirror.
struct MirrorScene {
  explicit MirrorScene(bool withMirror) {
    const std::uint32_t paint = builder.material({0.6F, 0.3F, 0.2F});
    const glm::vec3 corner(-1.5F, -1.2F, -1.0F);
    const glm::vec3 u(0.4F, 0.0F, 2.5F);
    const glm::vec3 v(0.2F, 2.4F, 0.3F);
    const glm::vec3 way(0.3F, -0.1F, 0.2F);
    if (withMirror) {
      builder.move(builder.quad(paint, corner, u, v), glm::vec3(0.0F), way);
      // The mirror reflects all light, so that the albedo in it is that of the board.
      builder.quad(metal(builder, glm::vec3(1.0F), 0.0F), {2.0F, -2.0F, -3.0F}, {0.0F, 0.0F, 6.0F}, {0.0F, 4.0F, 0.0F});
    } else {
      builder.move(builder.quad(paint, imageOf(corner), imageOfDirection(v), imageOfDirection(u)), glm::vec3(0.0F),
                   imageOfDirection(way));
    }
    camera = builder.camera({-0.2F, 0.0F, 3.0F}, {2.6F, 0.1F, 0.4F});
    builder.move(camera, {-0.2F, 0.0F, 3.0F}, {-0.1F, 0.2F, 2.9F});
  }

  SceneBuilder builder;
  std::uint32_t camera = 0;
};

TEST(Mirrors, ShowWhatStandsBehindThem) {
  MirrorScene before(true);
  MirrorScene behind(false);
  World mirror(before.builder.scene());
  World image(behind.builder.scene());
  mirror.moveTo(0.5, 0.4);
  image.moveTo(0.5, 0.4);
  const View view = viewFrom(mirror, before.camera, kWidth, kHeight, glm::vec2(0.0F), glm::vec2(0.0F));
  int compared = 0;
  int edges = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const PrimaryHit first = tracePrimary(mirror, view, x, y, GBufferMode::FirstHit);
      if (!first.surface || first.surface->metallic < 1.0F) {
        continue;  // The ray misses the mirror.
      }
      EXPECT_EQ(first.pixel.albedo, glm::vec3(0.0F));
      const PrimaryHit shown = tracePrimary(mirror, view, x, y, GBufferMode::BehindMirrors);
      const PrimaryHit expected = tracePrimary(image, view, x, y, GBufferMode::BehindMirrors);
      if (shown.surface.has_value() != expected.surface.has_value()) {
        ++edges;
        continue;
      }
      if (!shown.surface) {
        continue;
      }
      ++compared;
      // The tolerances allow for some tens of rounding errors of coordinates up to 8 and of pixel positions up to 48.
      EXPECT_LT(glm::distance(shown.pixel.position, expected.pixel.position), 1e-4F);
      EXPECT_LT(glm::distance(shown.pixel.normal, expected.pixel.normal), 1e-5F);
      EXPECT_LT(glm::distance(shown.pixel.motion, expected.pixel.motion), 1e-3F);
      EXPECT_LT(glm::distance(shown.pixel.albedo, expected.pixel.albedo), 1e-6F);
      EXPECT_GT(glm::length(glm::vec2(shown.pixel.motion)), 0.1F);
    }
  }
  EXPECT_GT(compared, 200);
  EXPECT_LE(edges, 2);
}

// Between parallel mirrors, virtual images lie in copies of the corridor, every other one of them mirrored.
TEST(Mirrors, ShowEachOther) {
  const Scene scene = loadScene(WALR_SCENES "/mirrors.gltf");
  const World world(scene);
  const View view = viewFrom(world, findCamera(scene, ""), kWidth, kHeight, glm::vec2(0.0F), glm::vec2(0.0F));
  constexpr float kBetweenMirrors = 2.4F;
  std::map<int, int> pixels;
  for (std::uint32_t y = 0; y < kHeight; ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const PrimaryHit shown = tracePrimary(world, view, x, y, GBufferMode::BehindMirrors);
      ASSERT_TRUE(shown.surface);
      const glm::vec3& position = shown.pixel.position;
      // On the pixel's ray; tolerances as above.
      EXPECT_LT(glm::distance(project(view, position), glm::vec2(x, y) + 0.5F), 1e-3F);
      glm::vec3 point(glm::inverse(view.viewFromWorld) * glm::vec4(position, 1.0F));
      const float copy = std::round(point.x / kBetweenMirrors);
      const float side = std::fmod(copy, 2.0F) == 0.0F ? 1.0F : -1.0F;
      point.x = side * (point.x - copy * kBetweenMirrors);
      EXPECT_LT(glm::distance(point, shown.surface->position), 1e-4F);
      ++pixels[static_cast<int>(std::abs(copy))];
    }
  }
  for (const int mirrors : {0, 1, 2}) EXPECT_GT(pixels[mirrors], 50) << mirrors;
}

// Only smooth metals are replaced. What they show is as dark as they reflect.
TEST(MirrorsInFilms, AreReplacedBelowTheirRoughness) {
  for (const auto& [metallic, roughness, replaced] :
       {std::tuple(1.0F, 0.149F, true), std::tuple(1.0F, 0.151F, false), std::tuple(0.9F, 0.0F, false)}) {
    SceneBuilder builder;
    const std::uint32_t mirror = metal(builder, glm::vec3(0.5F), roughness);
    builder.scene().materials[mirror].metallic = metallic;
    builder.scene().specular = true;
    builder.quad(mirror, {-9.0F, 0.0F, 9.0F}, {18.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -18.0F});
    builder.quad(builder.material(glm::vec3(0.8F)), {-9.0F, 0.0F, -4.0F}, {18.0F, 0.0F, 0.0F}, {0.0F, 9.0F, 0.0F});
    const std::uint32_t camera = builder.camera({0.0F, 2.0F, -1.0F}, {0.0F, 0.0F, -3.0F});  // At 45 degrees.
    const World world(builder.scene());
    SamplingSettings settings;
    settings.gbuffer = GBufferMode::BehindMirrors;
    const View view = viewFrom(world, camera, 1, 1, glm::vec2(0.0F), glm::vec2(0.0F));
    const Film film = renderFilm(world, view, settings);
    EXPECT_EQ(film.gbuffer[0].objectId, replaced ? 1U : 0U);
    EXPECT_EQ(film.specular[0].roughness, replaced ? 1.0F : roughness);
    if (!replaced) continue;
    const double tint = test::schlick(0.5, std::sqrt(0.5));
    EXPECT_NEAR(film.gbuffer[0].albedo.x, tint * 0.8, 1e-5);
    EXPECT_NEAR(film.specular[0].albedo.x, tint * 0.02, 1e-6);                // A rough dielectric's is the least.
    EXPECT_NEAR(film.gbuffer[0].position.z, -3.0F * std::sqrt(2.0F), 1e-4F);  // 2 down, and 1 to the wall.
  }
}

// What a mirror emits is added to what it shows, as dark as the mirrors before it reflect.
TEST(Mirrors, KeepTheirOwnEmission) {
  SceneBuilder builder;
  const glm::vec3 glow(0.25F, 0.5F, 1.0F);
  const std::uint32_t dim = metal(builder, glm::vec3(0.5F), 0.0F);
  builder.scene().materials[dim].emission = glow;
  builder.quad(dim, {-9.0F, 0.0F, 9.0F}, {18.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -18.0F});
  const std::uint32_t wall = metal(builder, glm::vec3(1.0F), 0.0F);
  builder.scene().materials[wall].emission = glow;
  builder.quad(wall, {-9.0F, 0.0F, -4.0F}, {18.0F, 0.0F, 0.0F}, {0.0F, 9.0F, 0.0F});
  builder.sky(glm::vec3(2.0F));
  const std::uint32_t camera = builder.camera({0.0F, 2.0F, -1.0F}, {0.0F, 0.0F, -3.0F});  // At 45 degrees.
  const World world(builder.scene());
  const View view = viewFrom(world, camera, 1, 1, glm::vec2(0.0F), glm::vec2(0.0F));
  EXPECT_EQ(tracePrimary(world, view, 0, 0, GBufferMode::FirstHit).pixel.emission, glow);
  // The floor shows the wall, which shows the sky.
  const glm::vec3 emission = tracePrimary(world, view, 0, 0, GBufferMode::BehindMirrors).pixel.emission;
  const auto tint = static_cast<float>(test::schlick(0.5, std::sqrt(0.5)));
  EXPECT_LT(glm::distance(emission, glow + tint * (glow + 2.0F)), 1e-5F);  // Some roundings of values up to 3.
}

// A mirror shows a smooth wall, which reflects a moving ceiling. In the virtual image, up is down.
TEST(MirrorsInFilms, TurnTheMotionOfWhatIsReflected) {
  SceneBuilder builder;
  builder.scene().specular = true;
  builder.quad(metal(builder, glm::vec3(0.5F), 0.0F), {-9.0F, 0.0F, 9.0F}, {18.0F, 0.0F, 0.0F}, {0.0F, 0.0F, -18.0F});
  const std::uint32_t varnish = builder.material(glm::vec3(0.8F));
  builder.scene().materials[varnish].roughness = 0.0F;
  builder.quad(varnish, {-9.0F, 0.0F, -4.0F}, {18.0F, 0.0F, 0.0F}, {0.0F, 9.0F, 0.0F});
  const std::uint32_t ceiling = builder.quad(varnish, {-9.0F, 4.0F, -9.0F}, {18.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 18.0F});
  builder.move(ceiling, glm::vec3(0.0F), {0.4F, 0.2F, 0.1F});
  const std::uint32_t camera = builder.camera({0.0F, 2.0F, -1.0F}, {0.0F, 0.0F, -3.0F});  // At 45 degrees.
  World world(builder.scene());
  world.moveTo(1.0, 0.0);
  SamplingSettings settings;
  settings.gbuffer = GBufferMode::BehindMirrors;
  const View view = viewFrom(world, camera, 1, 1, glm::vec2(0.0F), glm::vec2(0.0F));
  const glm::vec3 motion = renderFilm(world, view, settings).specular[0].motion;
  EXPECT_LT(glm::distance(motion, {-0.4F, 0.2F, -0.1F}), 1e-5F);
}

}  // namespace
}  // namespace walr::render::mirrors_test
