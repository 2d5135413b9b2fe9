// Checks that motion leads from the surface point that a pixel shows to the same point in the previous frame.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>

#include "samples/render/gbuffer.h"
#include "samples/render/load_scene.h"
#include "samples/render/view.h"
#include "samples/render/world.h"

namespace walr::render::motion_test {
namespace {

constexpr std::uint32_t kWidth = 160;
constexpr std::uint32_t kHeight = 90;
constexpr double kFramesPerSecond = 24.0;

struct RenderedFrame {
  View view;
  std::vector<PrimaryHit> hits;
};

RenderedFrame renderFrame(World& world, int number, bool jitter) {
  world.moveTo(number / kFramesPerSecond, (number - 1) / kFramesPerSecond);
  RenderedFrame frame;
  const auto offset = [&](int n) { return jitter ? haltonJitter(n) : glm::vec2(0.0F); };
  frame.view = viewFrom(world, findCamera(world.scene(), ""), kWidth, kHeight, offset(number), offset(number - 1));
  for (std::uint32_t y = 0; y < kHeight; ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      frame.hits.push_back(tracePrimary(world, frame.view, x, y));
    }
  }
  return frame;
}

struct Residuals {
  int pixels = 0;        // Number of the objects' pixels whose motion leads to a position inside the previous image.
  int found = 0;         // Number of these where a ray through that position hits the same surface point.
  double longest = 0.0;  // Length of the longest motion in pixels.
};

// Tolerance for positions in metres: a hundredth of a pixel's footprint. It allows for single precision at distances of
// some metres and for rays at grazing angles.
constexpr float kSamePoint = 1e-4F;

// Follows every pixel of some objects to the previous frame. `previousWorld` must be at the time of that frame.
Residuals reproject(const World& previousWorld, const RenderedFrame& now, const View& before,
                    const std::vector<bool>& objects) {
  Residuals result;
  for (std::uint32_t y = 0; y < kHeight; ++y) {
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const PrimaryHit& hit = now.hits[y * kWidth + x];
      if (!hit.surface || !objects[hit.pixel.objectId]) {
        continue;
      }
      const glm::vec2 motion(hit.pixel.motion);
      const glm::vec2 source = glm::vec2(static_cast<float>(x), static_cast<float>(y)) + 0.5F + motion;
      if (source.x < 0.0F || source.y < 0.0F || source.x > kWidth || source.y > kHeight) {
        continue;
      }
      ++result.pixels;
      result.longest = std::max<double>(result.longest, glm::length(motion));
      View through = before;
      through.jitter += motion;
      const PrimaryHit previous = tracePrimary(previousWorld, through, x, y);
      const bool same = previous.surface && previous.pixel.objectId == hit.pixel.objectId &&
                        glm::distance(previous.surface->position, hit.surface->previousPosition) < kSamePoint;
      if (same) {
        EXPECT_NEAR(-previous.pixel.position.z, -hit.pixel.position.z + hit.pixel.motion.z, kSamePoint);
      }
      result.found += same ? 1 : 0;
    }
  }
  return result;
}

class Motion : public testing::TestWithParam<bool> {};

// In frame 9 only objects move; in frame 20 the camera moves, too.
TEST_P(Motion, FindsTheSameSurfacePoint) {
  const Scene scene = loadScene(WALR_SCENES "/turntable.gltf");
  World world(scene);
  for (const int number : {9, 20}) {
    const View before = renderFrame(world, number - 1, GetParam()).view;
    const RenderedFrame now = renderFrame(world, number, GetParam());
    world.moveTo((number - 1) / kFramesPerSecond, (number - 2) / kFramesPerSecond);
    std::vector<bool> moving;
    for (const Instance& instance : world.instances()) {
      moving.push_back(instance.moves);
    }
    std::vector<bool> still = moving;
    still.flip();
    for (const auto& [objects, name] : {std::pair(moving, "moving objects"), std::pair(still, "still objects")}) {
      const Residuals residuals = reproject(world, now, before, objects);
      std::cout << "frame " << number << ", " << name << ": " << residuals.found << " of " << residuals.pixels
                << " points found again; longest motion " << residuals.longest << " pixels\n";
      // The other points were hidden in the previous frame, in a strip at the objects' edges as wide as the motion.
      EXPECT_GT(residuals.found, 19 * residuals.pixels / 20);
      EXPECT_GT(residuals.pixels, 1000);
    }
  }
}

TEST_P(Motion, IncludesTheJitter) {
  const Scene scene = loadScene(WALR_SCENES "/turntable.gltf");
  World world(scene);
  // Camera and room stand still, so that motion is the difference of the jitters.
  constexpr int kFrame = 5;
  const RenderedFrame frame = renderFrame(world, kFrame, GetParam());
  const glm::vec2 expected = GetParam() ? haltonJitter(kFrame) - haltonJitter(kFrame - 1) : glm::vec2(0.0F);
  for (const PrimaryHit& hit : frame.hits) {
    if (!hit.surface || !world.instances()[hit.pixel.objectId].moves) {
      // The rounding error of a projection to 160 pixels.
      EXPECT_LT(glm::distance(glm::vec2(hit.pixel.motion), expected), 2e-4F);
      EXPECT_EQ(hit.pixel.motion.z, 0.0F);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Jitter, Motion, testing::Bool(),
                         [](const auto& info) { return info.param ? "jittered" : "centred"; });

TEST(Projection, MapsAPositionBackToItsPixel) {
  const Scene scene = loadScene(WALR_SCENES "/box.gltf");
  World world(scene);
  const RenderedFrame frame = renderFrame(world, 12, true);
  for (std::uint32_t i = 0; i < frame.hits.size(); ++i) {
    if (frame.hits[i].surface) {
      const glm::vec2 expected = glm::vec2(i % kWidth, i / kWidth) + 0.5F + frame.view.jitter;
      EXPECT_LT(glm::distance(project(frame.view, frame.hits[i].pixel.position), expected), 1e-3F);
    }
  }
}

TEST(GBuffer, NormalsAreUnitAndFaceTheCamera) {
  const Scene scene = loadScene(WALR_SCENES "/box.gltf");
  World world(scene);
  int sky = 0;
  for (const PrimaryHit& hit : renderFrame(world, 12, false).hits) {
    if (!hit.surface) {
      ++sky;
      EXPECT_EQ(hit.pixel.normal, glm::vec3(0.0F));
      EXPECT_EQ(hit.pixel.emission, scene.skyRadiance);
      continue;
    }
    EXPECT_NEAR(glm::length(hit.pixel.normal), 1.0F, 1e-5F);
    EXPECT_LE(glm::dot(hit.pixel.normal, glm::normalize(hit.pixel.position)), 1e-5F);
  }
  EXPECT_GT(sky, 100);
}

}  // namespace
}  // namespace walr::render::motion_test
