// The sample host with the path tracer as a pass of its graph.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "framegraph/vulkan/frame_queue.h"
#include "passes/methods/denoiser.h"
#include "samples/command_line/usage_error.h"
#include "samples/denoise/device_memory.h"
#include "samples/host/headless.h"
#include "samples/host/live_frame.h"
#include "samples/host/renderer.h"
#include "samples/host/tracer.h"
#include "samples/render/scene_error.h"
#include "tests/gpu_render/tracing_fixture.h"

namespace walr::host {
namespace {

constexpr fg::Extent kExtent{40, 24};

Tracer::Options tracing(const std::string& scene) {
  Tracer::Options options;
  options.scene = std::string(WALR_SCENES "/") + scene;
  options.extent = kExtent;
  return options;
}

double meanOf(const Image& image) {
  double sum = 0.0;
  for (const float value : image.values()) sum += value;
  return sum / static_cast<double>(image.values().size());
}

/// A window's frame without the window, which the device traces. At first it shows the turntable.
struct LiveTurntable {
  static constexpr std::uint32_t kFramesInFlight = 2;

  explicit LiveTurntable(const GpuDevice& gpu)
      : tracer(tracing("turntable.gltf"), &gpu),
        picture(gpu, kExtent),
        live(gpu, picture, kFramesInFlight, {}, tracer.gpuScene()),
        queue(gpu.device().context(), gpu.device().queue(), kFramesInFlight) {}

  void record(const Tracer::Request& request) {
    const fg::vk::Frame recorded = queue.begin();
    live.record(recorded, tracer.hostFrame(request), {});
    queue.submit(recorded);
  }

  Tracer tracer;
  ShownPicture picture;
  LiveFrame live;
  fg::vk::FrameQueue queue;
};

}  // namespace

using GpuHost = gpu_render::test::TracingTest;

// Objects and camera of the turntable move all the time from frame 12 on; its 48 frames are played again and again.
TEST_F(GpuHost, RendersThreeHundredMovingFramesWithoutAMessage) {
  Tracer tracer(tracing("turntable.gltf"), &gpu);
  const std::unique_ptr<Denoiser> method = makeDenoiser("walr");
  Renderer renderer(gpu, *method, kExtent, {.readComposite = true, .scene = tracer.gpuScene()});
  constexpr int kFrames = 300;
  int frames = 0;
  const auto take = [&](const RenderedFrame& frame) {
    ++frames;
    for (const float value : frame.composite.values()) ASSERT_TRUE(std::isfinite(value));
  };
  for (int number = 0; number < kFrames; ++number) {
    renderer.submit(tracer.hostFrame({.number = number, .animationFrame = static_cast<double>(number % 48)}));
    if (renderer.full()) take(*renderer.finish());
  }
  while (const auto rest = renderer.finish()) take(*rest);
  EXPECT_EQ(frames, kFrames);
  EXPECT_NO_THROW(gpu.refuseMessages());
}

// As in a window: the size of frames changes while others are in flight, which takes another graph with the histories
// of the one before. Minimised, the window records nothing, and the device comes to rest.
TEST_F(GpuHost, ResizesAndRestsInThreeHundredMovingFramesWithoutAMessage) {
  LiveTurntable window(gpu);
  const std::unique_ptr<Denoiser> method = makeDenoiser("walr");
  constexpr std::array kSizes{kExtent, fg::Extent{37, 22}, fg::Extent{20, 12}, fg::Extent{31, 19}};
  constexpr int kFrames = 300;
  constexpr int kFramesOfASize = 12;
  constexpr int kFramesUntilARest = 50;
  for (int number = 0; number < kFrames; ++number) {
    const fg::Extent extent = kSizes.at(static_cast<std::size_t>(number / kFramesOfASize) % kSizes.size());
    if (number % kFramesOfASize == 0) {
      window.live.setExtent(extent);
      window.live.declare(*method, {}, LiveFrame::Start::FromHistory);
    }
    window.record({.number = number, .animationFrame = static_cast<double>(number % 48), .extent = extent});
    EXPECT_EQ(window.live.shown(), extent);
    if (number % kFramesUntilARest == 0) window.queue.waitAll();
  }
  window.queue.waitAll();
  for (const fg::vk::HistoryStatus& history : window.live.histories()) {
    EXPECT_EQ(history.age, static_cast<std::uint32_t>(kFrames));
  }
}

// The same random numbers lead to the same frames, but for roundings.
TEST_F(GpuHost, ShowsWhatTheTracerOnTheProcessorShows) {
  std::vector<Tracer::Options> cases(2, tracing("turntable.gltf"));
  cases[0].denoiseDirect = false;
  cases.push_back(tracing("gloss.gltf"));
  cases[2].camera = "mirror";
  cases[2].specular = true;
  cases[2].gbuffer = render::GBufferMode::BehindMirrors;
  for (const Tracer::Options& options : cases) {
    std::vector<Image> pictures;
    for (const GpuDevice* const device :
         {static_cast<const GpuDevice*>(nullptr), static_cast<const GpuDevice*>(&gpu)}) {
      Tracer tracer(options, device);
      const std::unique_ptr<Denoiser> method = makeDenoiser(options.specular ? "accumulate" : "walr");
      Renderer renderer(gpu, *method, kExtent,
                        {.readComposite = true, .scene = tracer.gpuScene(), .specular = options.specular});
      Image last;
      renderFrames(tracer, renderer, {12, 19}, {}, [&](const RenderedFrame& frame) { last = frame.composite; });
      pictures.push_back(std::move(last));
    }
    double difference = 0.0;
    for (std::size_t i = 0; i < pictures[0].values().size(); ++i) {
      difference += std::abs(pictures[0].values()[i] - pictures[1].values()[i]);
    }
    difference /= static_cast<double>(pictures[0].values().size());
    std::cout << "mean value " << meanOf(pictures[0]) << ", mean absolute difference " << difference << '\n';
    // One pixel in a hundred may have another path, whose light can differ by as much as light does.
    EXPECT_LE(difference, 0.01 * meanOf(pictures[0]));
  }
}

// What the device counts in half floats is what the processor counts, but for paths that roundings lead elsewhere.
TEST_F(GpuHost, CountsTheRaysThatTheDeviceTraces) {
  for (const fg::Extent extent : {kExtent, fg::Extent{97, 5}}) {
    Tracer::Options options = tracing("turntable.gltf");
    options.extent = extent;
    Tracer onProcessor(options);
    Tracer onDevice(options, &gpu);
    const std::unique_ptr<Denoiser> method = makeDenoiser("none");
    Renderer renderer(gpu, *method, extent, {.scene = onDevice.gpuScene()});
    renderFrames(onDevice, renderer, {12, 14}, {}, [&](const RenderedFrame& frame) {
      const Tracer::Request request{.number = frame.number, .animationFrame = static_cast<double>(frame.number)};
      const auto expected = static_cast<double>(onProcessor.hostFrame(request).traced.rays);
      // One pixel in a hundred may have another path; its number of rays differs by less than twice the mean.
      EXPECT_NEAR(static_cast<double>(frame.traced.rays), expected, 0.02 * expected) << frame.number;
      EXPECT_GT(frame.traced.perSecond().value_or(0.0), 0.0);
    });
  }
}

TEST_F(GpuHost, TellsTheDeviceMemoryThatTheDriverCounts) {
  const std::optional<DeviceMemory> before = deviceMemory(gpu);
  if (!before) GTEST_SKIP() << "the device has no VK_EXT_memory_budget";
  EXPECT_GT(before->budget, 0U);
  EXPECT_LE(before->used, before->budget);
}

// A graph that is declared anew while frames of the old one are in flight, as the window does it.
TEST_F(GpuHost, ChangesItsGraphWhileItTraces) {
  LiveTurntable window(gpu);
  const std::vector<HostView> views{
      {}, {HostView::Kind::Noisy, ""}, {HostView::Kind::Texture, "lighting"}, {HostView::Kind::Texture, "object id"}};
  int number = 12;
  for (const std::string name : {"walr", "svgf"}) {
    const std::unique_ptr<Denoiser> method = makeDenoiser(name);
    for (const HostView& view : views) {
      window.live.declare(*method, view, LiveFrame::Start::FromHistory);
      for (int i = 0; i < 3; ++i, ++number) {
        window.record({.number = number, .animationFrame = static_cast<double>(number)});
      }
    }
  }
  window.queue.waitAll();
}

// As when a user drops a file onto the window.
TEST_F(GpuHost, TracesAnotherScene) {
  LiveTurntable window(gpu);
  const std::unique_ptr<Denoiser> method = makeDenoiser("walr");
  for (const char* const scene : {"box.gltf", "kitchen.gltf", "turntable.gltf"}) {
    window.queue.waitAll();
    window.tracer.show(window.tracer.read(std::string(WALR_SCENES "/") + scene));
    window.live.changeScene(window.tracer.gpuScene());
    window.live.declare(*method, {}, LiveFrame::Start::Anew);
    for (int number = 0; number < 4; ++number) window.record({.number = number});
  }
  window.queue.waitAll();
}

TEST_F(GpuHost, RefusesWhatOnlyTheProcessorTraces) {
  Tracer tracer(tracing("box.gltf"), &gpu);
  EXPECT_NE(tracer.whyNotResampled().find("--tracer cpu"), std::string::npos);
  EXPECT_THROW(tracer.hostFrame({.resampledFrames = 20}), std::invalid_argument);
  const std::unique_ptr<Denoiser> method = makeDenoiser("walr");
  for (const HostView::Kind kind : {HostView::Kind::Reference, HostView::Kind::Split}) {
    EXPECT_THROW(Renderer(gpu, *method, kExtent, {.view = {kind, ""}, .scene = tracer.gpuScene()}), UsageError);
  }
}

}  // namespace walr::host
