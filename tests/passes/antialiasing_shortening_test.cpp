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
// longest history lies between 1 and the setting as the tiles say, bilinear between their centres.
TEST_F(AntialiasingShortening, TilesSayHowLongHistoryIs) {
  Image<std::uint32_t> shortening(kTiles);
  reference::forEachPixel(kTiles,
                          [&](glm::ivec2 t) { shortening[t] = std::bit_cast<std::uint32_t>(0.125F * float(t.x)); });
  for (const bool jittered : {false, true}) {
    SCOPED_TRACE(jittered ? "jittered" : "not jittered");
    TemporalAntialiasingSettings settings{.maxHistory = 4.0F, .clipGamma = 1e6F, .edgeClipGamma = 1e6F};
    settings.filterRadius = 0.5F;  // A frame's light is that of the pixel's own sample.
    AntialiasingRun run(device(), kSize, settings, {}, {.shortening = true});
    run.setShortening(shortening);
    HostFrame frame = renderStill(flatWall(), kSize);
    if (jittered) {
      // Samples of a still surface move by as much in the image.
      frame.constants.jitterDelta = {0.25F, 0.0F};
      reference::forEachPixel(kSize, [&](glm::ivec2 p) { frame.motion[p].x += 0.25; });
    }
    const Image<Guide> guides = reference::prepareGuides(frame, reference::Storage::Quantised);
    // A change of the whole picture, which clipping lets pass because the light differs from pixel to pixel.
    const std::array changes{0.0, 1.0, 0.25, 2.0, 0.5};
    Image<double> mean(kSize);
    for (std::size_t i = 0; i < changes.size(); ++i) {
      SCOPED_TRACE("frame " + std::to_string(i));
      reference::forEachPixel(kSize, [&](glm::ivec2 p) {
        frame.lighting[p] = glm::dvec3(4.0 + changes.at(i) + ((p.x + p.y) % 2 == 0 ? 1.0 : -1.0));
      });
      const Image<glm::dvec4> result = run.frame(frame, guides, guides);
      Comparison comparison("anti-aliasing");
      reference::forEachPixel(kSize, [&](glm::ivec2 p) {
        static_cast<void>(comparison.skips(false));
        const double tile = std::clamp((p.x + 0.5) / kAntilagTile - 0.5, 0.0, kTiles.x - 1.0);
        const double longest = jittered ? 4.0 : 4.0 - 3.0 * 0.125 * tile;
        const double length = std::min(double(i) + 1.0, longest);
        const double y = frame.lighting[p].x;
        mean[p] += (y - mean[p]) / length;
        // The history is stored in halves: one rounding for each frame, of a mean below 8 and of its length.
        const double rounding = double(i) * (0x1p-9 + 2.0 * 0x1p-11);
        comparison.colour(p, result[p], glm::dvec3(mean[p]), glm::dvec3(rounding + 0x1p-9));
      });
      comparison.expect(0.0);
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
