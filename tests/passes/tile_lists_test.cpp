// Every tile is in the list that its blocks put it in, and dispatching over lists leaves every pixel as it is.
#include "passes/tile_lists.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "passes/grid_extent.h"
#include "shaders/constants/tiles.h"
#include "tests/passes/denoiser_run.h"
#include "tests/passes/shaders.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test {
namespace {

using reference::HostFrame;
using reference::Image;

// More tiles than a row of workgroups holds, and no multiple of a tile.
constexpr glm::ivec2 kSize(150, 130);
static_assert(150 / kTileSide * (130 / kTileSide) > static_cast<int>(kTileListColumns));

enum class Block : std::uint32_t { Sky, Growing, Converged };

/// As block_storage.glsl has it: a depth whose lowest mantissa bit says whether the fit has converged.
std::uint32_t fitDepthOf(Block block) {
  if (block == Block::Sky) return 0;
  return std::bit_cast<std::uint32_t>(4.0F) | (block == Block::Converged ? 1U : 0U);
}

/// A number of its own for every list, of which no sum of few others is one.
constexpr std::uint32_t markOf(std::uint32_t list) {
  return 1U << (8 * list);
}

class TileListsTest : public fg::test::GpuTest {
 protected:
  std::unique_ptr<DenoiserRun> runWith(const std::string& sortTiles, const std::string& spatialOnly) {
    const std::unique_ptr<Denoiser> denoiser = makeDenoiser("walr");
    denoiser->set("blocks.sort-tiles", sortTiles);
    denoiser->set("spatial-only", spatialOnly);
    denoiser->set("blocks.coarse-samples", "30");  // So that some tiles converge in a picture of this size.
    return std::make_unique<DenoiserRun>(device(), *denoiser, kSize);
  }

  /// What every pixel gets where each list marks its tiles.
  std::vector<std::uint32_t> marks(const std::vector<Block>& blocks, std::uint32_t blockSize) {
    const fg::Extent pixels{static_cast<std::uint32_t>(kSize.x), static_cast<std::uint32_t>(kSize.y)};
    fg::Graph graph;
    const fg::Texture fitDepth =
        graph.import("fit depth", {VK_FORMAT_R32_UINT, gridExtent(pixels, blockSize)}, fg::vk::kUploaded);
    const TileLists lists = addTileLists(graph, pixels, fitDepth, blockSize);
    fg::Texture marked = graph.import("marks", {VK_FORMAT_R32_UINT, pixels}, fg::vk::kOverwritable);
    fg::PassBuilder clear = graph.compute("clear", shaders::markTiles);
    clear.specialize("kMark", 0U).dispatch(pixels);
    marked = clear.store("marks", marked);
    for (std::uint32_t list = 0; list < kTileLists; ++list) {
      fg::PassBuilder pass = graph.compute("mark " + std::to_string(list), shaders::markTilesListed);
      pass.specialize("kMark", markOf(list));
      dispatchTiles(pass, lists, list);
      marked = pass.update("marks", marked);
    }
    graph.exported(marked, fg::vk::kReadable);
    fg::test::GraphRun run(device(), graph);
    std::vector<std::uint32_t> texels;
    for (const Block block : blocks) texels.push_back(fitDepthOf(block));
    run.fill(fitDepth, texels);
    run.frame();
    return run.texels<std::uint32_t>(marked);
  }
};

/// The list of the tile of a pixel, by the definition: what a pixel reads are the blocks whose centres are less than a
/// block away from its own on either axis.
std::uint32_t listAt(glm::ivec2 pixel, const std::vector<Block>& blocks, glm::ivec2 grid, int blockSize) {
  bool surface = false;
  bool growing = false;
  const glm::ivec2 first = pixel / kTileSide * kTileSide;
  for (int y = first.y; y < first.y + kTileSide; ++y) {
    for (int x = first.x; x < first.x + kTileSide; ++x) {
      for (int by = 0; by < grid.y; ++by) {
        for (int bx = 0; bx < grid.x; ++bx) {
          const Block block = blocks[static_cast<std::size_t>(by) * grid.x + bx];
          if (block == Block::Sky) continue;
          const glm::dvec2 way = (glm::dvec2(x, y) + 0.5) / double(blockSize) - (glm::dvec2(bx, by) + 0.5);
          if (std::abs(way.x) >= 1.0 || std::abs(way.y) >= 1.0) continue;
          growing = growing || block == Block::Growing;
          surface = surface || glm::ivec2(x, y) / blockSize == glm::ivec2(bx, by);
        }
      }
    }
  }
  if (!surface) return kTilesOfSky;
  return growing ? kTilesGrowing : kTilesConverged;
}

TEST_F(TileListsTest, HoldEveryTileOnceByWhatItsBlocksAre) {
  for (const int blockSize : {3, 4, 5, 8}) {
    const glm::ivec2 grid = (kSize + blockSize - 1) / blockSize;
    std::vector<Block> blocks;
    for (int y = 0; y < grid.y; ++y) {
      for (int x = 0; x < grid.x; ++x) {
        const bool sky = y < grid.y / 3 || (x > grid.x / 2 && (x * 7 + y * 3) % 5 != 0);
        const bool lone = (x * 13 + y * 29) % 37 == 0;
        const bool converged = x < grid.x / 3 ? !lone : lone;
        blocks.push_back(sky ? Block::Sky : (converged ? Block::Converged : Block::Growing));
      }
    }
    const std::vector<std::uint32_t> marked = marks(blocks, static_cast<std::uint32_t>(blockSize));
    std::vector<int> tiles(kTileLists, 0);
    for (int y = 0; y < kSize.y; y += kTileSide) {
      for (int x = 0; x < kSize.x; x += kTileSide) {
        const std::uint32_t list = listAt({x, y}, blocks, grid, blockSize);
        ++tiles[list];
        for (int py = y; py < std::min(y + kTileSide, kSize.y); ++py)
          for (int px = x; px < std::min(x + kTileSide, kSize.x); ++px)
            ASSERT_EQ(marked[static_cast<std::size_t>(py) * kSize.x + px], markOf(list))
                << "blocks of " << blockSize << ", " << px << ' ' << py;
      }
    }
    for (std::uint32_t list = 0; list < kTileLists; ++list) EXPECT_GT(tiles[list], 0) << blockSize << ", " << list;
  }
}

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
    const auto sorted = runWith("on", spatialOnly);
    for (std::uint32_t number = 0; number < 8; ++number) {
      const HostFrame frame = frameWithSky(number);
      const Image<glm::dvec4> expected = whole->frame(frame);
      const Image<glm::dvec4> result = sorted->frame(frame);
      reference::forEachPixel(kSize, [&](glm::ivec2 p) {
        EXPECT_EQ(result[p], expected[p]) << "frame " << number << ", " << p.x << ' ' << p.y;
      });
    }
  }
}

}  // namespace
}  // namespace walr::test
