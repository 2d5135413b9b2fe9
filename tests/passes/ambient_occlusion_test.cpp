// Ambient occlusion, a guide of the regression over blocks.

#include <algorithm>
#include <limits>

#include "tests/passes/stage_checks.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::ambient_occlusion_test {
namespace {

using reference::Guide;
using reference::HostFrame;
using reference::Image;

constexpr glm::ivec2 kSize(45, 34);

/// The default settings, with a radius as wide as the scenes are in so small an image.
WalrSettings searchingWidely() {
  WalrSettings settings;
  settings.occlusion = {.radius = 0.25F, .rings = 7};
  return settings;
}

class AmbientOcclusion : public fg::test::GpuTest {
 protected:
  Image<Guide> guidesOf(const HostFrame& frame) {
    WalrRun run(device(), kSize, searchingWidely());
    return run.frame(frame).guides;
  }
};

TEST_F(AmbientOcclusion, AgreesWithTheReference) {
  for (const NamedScene& named : allScenes()) {
    SCOPED_TRACE(named.name);
    expectSequence(device(), {renderStill(named.scene, kSize)}, searchingWidely());
  }
}

TEST_F(AmbientOcclusion, APlaneDoesNotOccludeItself) {
  const Image<Guide> guides = guidesOf(renderStill(flatWall(), kSize));
  for (const Guide& guide : guides.pixels()) EXPECT_EQ(guide.occlusion, 0.0);
}

// Pixels that are not denoised, because they are mirrors or have no normal, still block light.
TEST_F(AmbientOcclusion, MirrorsAndSurfacesWithoutNormalsOcclude) {
  const HostFrame diffuse = renderStill(stairs(), kSize);
  HostFrame other = diffuse;
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    if ((p.x / 4) % 3 == 0) other.albedo[p] = glm::dvec3(0.0);
    if ((p.x / 4) % 3 == 1) other.normal[p] = glm::dvec3(p.y % 2 == 0 ? 0.0 : std::numeric_limits<double>::infinity());
  });
  const Image<Guide> expected = guidesOf(diffuse);
  const Image<Guide> actual = guidesOf(other);
  double largest = 0.0;
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    EXPECT_EQ(actual[p].depth > 0.0, (p.x / 4) % 3 == 2) << p.x << " " << p.y;
    if (actual[p].depth == 0.0) return;
    EXPECT_EQ(actual[p].occlusion, expected[p].occlusion) << p.x << " " << p.y;
    largest = std::max(largest, actual[p].occlusion);
  });
  EXPECT_GT(largest, 0.1);
}

}  // namespace
}  // namespace walr::test::ambient_occlusion_test
