// The stages of WALR agree with the reference on crops of real path-traced frames, if these are at hand.

#include <filesystem>

#include "passes/conventions/frame.h"
#include "samples/sequence/sequence.h"
#include "tests/passes/reference/storage.h"
#include "tests/passes/stage_checks.h"
#include "tests/shared_data.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test {
namespace {

using reference::HostFrame;

constexpr glm::ivec2 kCrop(98, 66);

glm::dvec3 triple(const Image& image, glm::ivec2 p) {
  glm::dvec3 value(0.0);
  for (int c = 0; c < std::min(3, image.components()); ++c)
    value[c] = reference::roundToHalf(double(image.at(p.x, p.y, c)));
  return value;
}

/// The part of a frame from `origin` on, with the camera's lens shifted accordingly.
HostFrame cropOf(const Frame& frame, const Layout& layout, glm::ivec2 origin) {
  FrameDescription description;
  description.view = frame.camera.view;
  description.previousView = frame.camera.previousView;
  description.projection = frame.camera.projection;
  description.previousProjection = frame.previousProjection;
  description.jitter = frame.camera.jitter;
  description.previousJitter = frame.previousJitter;
  description.motionScale = layout.motionScale;
  description.frameIndex = static_cast<std::uint32_t>(frame.number);
  description.skyDepth = kSkyDepth;

  HostFrame crop;
  crop.conventions = layout.conventions;
  crop.constants = frameConstants(
      description, {static_cast<std::uint32_t>(frame.depth.width()), static_cast<std::uint32_t>(frame.depth.height())});
  for (glm::vec4* ray : {&crop.constants.rayFromPixel, &crop.constants.previousRayFromPixel}) {
    ray->z += static_cast<float>(origin.x) * ray->x;
    ray->w += static_cast<float>(origin.y) * ray->y;
  }
  crop.constants.previousTexel = 1.0F / glm::vec2(kCrop);
  crop.lighting = crop.normal = crop.motion = crop.albedo = reference::Image<glm::dvec3>(kCrop);
  crop.depth = reference::Image<double>(kCrop);
  reference::forEachPixel(kCrop, [&](glm::ivec2 p) {
    const glm::ivec2 q = origin + p;
    crop.lighting[p] = triple(frame.indirect, q);
    crop.normal[p] = triple(frame.normal, q);
    crop.motion[p] = triple(frame.motion, q);
    crop.albedo[p] = triple(frame.albedo, q);
    crop.depth[p] = double(frame.depth.at(q.x, q.y, 0));
  });
  return crop;
}

class SharedDataRealFrames : public fg::test::GpuTest {
 protected:
  void expectCrop(const char* name, FrameRange range, glm::ivec2 origin) const {
    const SharedData folder(std::filesystem::path("sequences") / name);
    if (!folder) GTEST_SKIP() << folder.whyNot();
    SequenceOptions options;
    options.frames = range;
    const Sequence sequence(folder.path(), options);
    std::vector<HostFrame> frames;
    for (std::size_t i = 0; i < sequence.entries().size(); ++i)
      frames.push_back(cropOf(sequence.read(i), *sequence.layout().layout, origin));
    for (const WalrPaperSettings& settings : {robustWalr(), paperWalr()}) expectSequence(device(), frames, settings);
  }
};

TEST_F(SharedDataRealFrames, FenceInABox) {
  expectCrop("cornell_fence", {10, 12}, {140, 90});
}

TEST_F(SharedDataRealFrames, OpenCourt) {
  expectCrop("sponza", {18, 20}, {150, 60});
}

}  // namespace
}  // namespace walr::test
