// Anti-aliasing whose history is shortened where the accumulated light is good (passes/WALR.md, 10).

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "passes/methods/denoiser.h"
#include "shaders/temporal/antilag.h"
#include "tests/passes/antialiasing_run.h"
#include "tests/passes/comparison.h"
#include "tests/passes/denoiser_run.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::antialiasing_shortening_test {
namespace {

using reference::Guide;
using reference::HostFrame;
using reference::Image;

constexpr glm::ivec2 kSize(68, 40);  // Not a multiple of the tiles.
const glm::ivec2 kTiles = (kSize - 1) / kAntilagTile + 1;

class AntialiasingShortening : public fg::test::GpuTest {};

// The result of every frame is the mean h + (y - h) / N with N = min(number of frames, longest history), and the
// longest history lies between 1 and the setting as the tiles say, bilinear between their centres. At rest it may be
// longer. `motion`: by how many pixels the history of all pixels lies to the right of them.
void expectHistoryLengths(const fg::test::TestDevice& device, float shorteningPerTile, bool jittered, int motion) {
  Image<std::uint32_t> shortening(kTiles);
  reference::forEachPixel(
      kTiles, [&](glm::ivec2 t) { shortening[t] = std::bit_cast<std::uint32_t>(shorteningPerTile * float(t.x)); });
  constexpr float kRestFactor = 2.0F;
  TemporalAntialiasingSettings settings{
      .maxHistory = 4.0F, .clipGamma = 1e6F, .edgeClipGamma = 1e6F, .restFactor = kRestFactor};
  settings.filterRadius = 0.5F;  // A frame's light is that of the pixel's own sample.
  AntialiasingRun run(device, kSize, settings, {}, {.shortening = true});
  run.setShortening(shortening);
  HostFrame frame = renderStill(flatWall(), kSize);
  if (jittered) {
    // Samples of a still surface move by as much in the image.
    frame.constants.jitterDelta = {0.25F, 0.0F};
    reference::forEachPixel(kSize, [&](glm::ivec2 p) { frame.motion[p].x += 0.25; });
  }
  const auto before = [motion](glm::ivec2 p) { return p + glm::ivec2(motion, 0); };
  reference::forEachPixel(kSize, [&](glm::ivec2 p) {
    const glm::ivec2 q = before(p);
    frame.motion[p] += glm::dvec3(motion, 0.0, q.x < kSize.x ? frame.depth[q] - frame.depth[p] : 0.0);
  });
  const Image<Guide> guides = reference::prepareGuides(frame, reference::Storage::Quantised);
  // A change of the whole picture, which clipping lets pass because the light differs from pixel to pixel.
  const std::array changes{0.0, 1.0, 0.25, 2.0, 0.5, 1.5, 0.75, 1.25, 0.25, 2.0};
  Image<double> mean(kSize), length(kSize);
  for (std::size_t i = 0; i < changes.size(); ++i) {
    SCOPED_TRACE("frame " + std::to_string(i));
    reference::forEachPixel(kSize, [&](glm::ivec2 p) {
      frame.lighting[p] = glm::dvec3(4.0 + changes.at(i) + ((p.x + p.y) % 2 == 0 ? 1.0 : -1.0));
    });
    const Image<glm::dvec4> result = run.frame(frame, guides, guides);
    const Image<double> previousMean = mean, previousLength = length;
    Comparison comparison("anti-aliasing");
    reference::forEachPixel(kSize, [&](glm::ivec2 p) {
      static_cast<void>(comparison.skips(false));
      const double tile = std::clamp((p.x + 0.5) / kAntilagTile - 0.5, 0.0, kTiles.x - 1.0);
      const double shorter = shorteningPerTile * tile;
      double longest = 4.0;
      if (shorter < 0.0 && motion == 0) longest = 4.0 * (1.0 - shorter);
      if (shorter > 0.0 && !jittered) longest = 4.0 - 3.0 * shorter;
      const glm::ivec2 q = before(p);
      const bool known = q.x < kSize.x;
      length[p] = std::min(known ? previousLength[q] + 1.0 : 1.0, longest);
      const double y = frame.lighting[p].x, h = known ? previousMean[q] : y;
      mean[p] = h + (y - h) / length[p];
      // The history is stored in halves: one rounding for each frame, of a mean below 8 and of its length.
      const double rounding = double(i) * (0x1p-9 + 2.0 * 0x1p-11);
      comparison.colour(p, result[p], glm::dvec3(mean[p]), glm::dvec3(rounding + 0x1p-9));
    });
    comparison.expect(0.0);
  }
}

TEST_F(AntialiasingShortening, TilesSayHowLongHistoryIs) {
  for (const bool jittered : {false, true}) {
    for (const float perTile : {0.125F, -0.125F}) {
      for (const int motion : {0, 2}) {
        SCOPED_TRACE(std::string(jittered ? "jittered" : "not jittered") + ", " + std::to_string(perTile) +
                     " a tile, motion " + std::to_string(motion));
        expectHistoryLengths(device(), perTile, jittered, motion);
      }
    }
  }
}

/// The last of some frames of a moving camera, by `walr`.
Image<glm::dvec4> lastFrame(const fg::test::TestDevice& device, const std::vector<HostFrame>& frames,
                            const std::string& share) {
  const std::unique_ptr<Denoiser> walr = makeDenoiser("walr");
  walr->set("blocks.residual-antialiasing", share);
  DenoiserRun run(device, *walr, kSize);
  Image<glm::dvec4> last(kSize);
  for (const HostFrame& frame : frames) last = run.frame(frame);
  return last;
}

bool equal(const Image<glm::dvec4>& a, const Image<glm::dvec4>& b) {
  return std::ranges::equal(a.pixels(), b.pixels());
}

TEST_F(AntialiasingShortening, LeavesJitteredFramesAsTheyAre) {
  // Light without noise, of which shares are large. Detail that no guide shows has a period of a few pixels.
  const Light detailed = [](glm::dvec3 point, glm::dvec3 normal) {
    return smoothLight(point, normal) * (1.0 + 0.4 * std::sin(11.0 * point.x) * std::sin(9.0 * point.y));
  };
  std::vector<HostFrame> still;
  std::vector<HostFrame> jitter;
  constexpr double kStep = 0.13;  // Of the camera, to the side. More than a pixel.
  for (std::uint32_t i = 0; i < 12; ++i) {
    const FrameDescription camera = cameraAt({kStep * i, 0.0, 0.0}, {kStep * (i == 0 ? 0 : i - 1), 0.0, 0.0}, kSize, i);
    still.push_back(renderFrame(flatWall(), camera, kSize, detailed, Noise::None));
    jitter.push_back(renderFrame(flatWall(), jittered(camera, i), kSize, detailed, Noise::None));
  }
  EXPECT_FALSE(equal(lastFrame(device(), still, "0"), lastFrame(device(), still, "1")));
  EXPECT_TRUE(equal(lastFrame(device(), jitter, "0"), lastFrame(device(), jitter, "1")));
}

}  // namespace
}  // namespace walr::test::antialiasing_shortening_test
