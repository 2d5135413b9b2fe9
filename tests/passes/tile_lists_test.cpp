// Dispatching over the tiles that show a surface leaves every pixel as it is.
#include "passes/tile_lists.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "shaders/constants/tiles.h"
#include "tests/passes/denoiser_run.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test {
namespace {

using reference::HostFrame;
using reference::Image;

// More tiles than a row of workgroups holds, and no multiple of a tile.
constexpr glm::ivec2 kSize(150, 130);
static_assert(150 / kTileSide * (130 / kTileSide) > static_cast<int>(kTileListColumns));

class TileListsTest : public fg::test::GpuTest {
 protected:
  std::unique_ptr<DenoiserRun> runWith(const std::string& skipSky, const std::string& spatialOnly) {
    const std::unique_ptr<Denoiser> denoiser = makeDenoiser("walr");
    denoiser->set("walr.skip-sky", skipSky);
    denoiser->set("spatial-only", spatialOnly);
    return std::make_unique<DenoiserRun>(device(), *denoiser, kSize);
  }
};

// Sky comes and goes, so that what an earlier frame or another texture left in a tile would show.
HostFrame frameWithSky(std::uint32_t number) {
  HostFrame frame = renderStill(number % 3 == 0 ? bumpyWall(0.1) : skyBesideSurface(), kSize, number);
  if (number % 4 == 3) frame.depth = Image<double>(kSize, 1e10);
  // A lone pixel, in the last tile, and one whose light is no number.
  frame.depth[kSize - 1] = 4.0;
  frame.lighting[{3, 5}].x = std::numeric_limits<double>::quiet_NaN();
  return frame;
}

TEST_F(TileListsTest, LeaveEveryPixelAsItIs) {
  for (const std::string spatialOnly : {"off", "on"}) {
    const auto whole = runWith("off", spatialOnly);
    const auto listed = runWith("on", spatialOnly);
    for (std::uint32_t number = 0; number < 8; ++number) {
      const HostFrame frame = frameWithSky(number);
      const Image<glm::dvec4> expected = whole->frame(frame);
      const Image<glm::dvec4> result = listed->frame(frame);
      reference::forEachPixel(kSize, [&](glm::ivec2 p) {
        EXPECT_EQ(result[p], expected[p]) << "frame " << number << ", " << p.x << ' ' << p.y;
      });
    }
  }
}

TEST(TileLists, AreNotInTheGraphOfASceneWithoutSky) {
  const auto passes = [](bool sky) {
    fg::Graph graph;
    DenoiserInputs inputs = importInputs(graph, kSize);
    inputs.scene.sky = sky;
    const std::unique_ptr<Denoiser> denoiser = makeDenoiser("walr");
    denoiser->set("walr.skip-sky", "on");
    static_cast<void>(denoiser->add(graph, inputs, importOutput(graph, kSize)));
    return std::ranges::count(graph.desc().passes, "tile lists", &fg::PassDecl::name);
  };
  EXPECT_EQ(passes(true), 1);
  EXPECT_EQ(passes(false), 0);
}

}  // namespace
}  // namespace walr::test
