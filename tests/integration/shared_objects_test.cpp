// Several views a frame: denoisers that share pipelines and the memory of transients give the pictures of separate
// ones.
#include <array>
#include <memory>
#include <string>
#include <vector>

#include <walr/walr_passes.h>

#include "framegraph/vulkan/physical_device.h"
#include "tests/error_text.h"
#include "tests/integration/device_calls.h"
#include "tests/integration/hosted_run.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::shared_objects_test {
namespace {

using fg::test::expectContains;
using fg::test::expectError;
using Bytes = std::vector<std::byte>;

constexpr glm::ivec2 kSize(45, 37);

/// A view of a walk past a sphere: its own camera beside that of the others.
struct View {
  glm::ivec2 size;
  double beside = 0.0;
  double brightness = 1.0;  ///< Of its lighting.

  [[nodiscard]] FrameDescription camera(std::uint32_t frame) const {
    const auto at = [&](double time) { return glm::dvec3(0.06 * time + beside, 0.02 * time, -0.03 * time); };
    return cameraAt(at(frame), at(double(frame) - 1.0), size, frame);
  }
  void fill(HostedRun& run, std::uint32_t frame) const {
    reference::HostFrame rendered = renderFrame(sphere(), camera(frame), size);
    for (glm::dvec3& radiance : rendered.lighting.pixels()) radiance *= brightness;
    run.fill(rendered);
  }
};

WalrMemory memoryOf(const HostedRun& run) {
  WalrMemory memory{};
  memory.struct_size = sizeof(memory);
  require(walr_get_memory(run.denoiser(), &memory));
  return memory;
}

class SharedObjects : public fg::test::GpuTest {
 protected:
  [[nodiscard]] std::unique_ptr<HostedRun> run(const View& view, WalrDenoiser sharedWith = nullptr) const {
    HostedRun::Options options;
    options.sharedWith = sharedWith;
    options.alone = sharedWith == nullptr;
    return std::make_unique<HostedRun>(device(), "walr", view.size, options);
  }
  /// Results of a view's frames in a denoiser of its own.
  [[nodiscard]] std::vector<Bytes> alone(const View& view, std::uint32_t frames) const {
    const auto separate = run(view);
    std::vector<Bytes> results;
    for (std::uint32_t i = 0; i < frames; ++i) {
      view.fill(*separate, i);
      results.push_back(separate->frameBytes(view.camera(i)));
    }
    return results;
  }
};

TEST_F(SharedObjects, InterleavedViewsGiveThePicturesOfSeparateDenoisers) {
  constexpr std::uint32_t kFrames = 5;
  const std::vector<Bytes> expectedFirst = alone(View{kSize}, kFrames);
  // The second view's transients fit into the memory of the first's, or need more.
  for (const glm::ivec2 size : {kSize, glm::ivec2(40, 30), glm::ivec2(96, 80)}) {
    SCOPED_TRACE(std::to_string(size.x) + " pixels wide");
    const std::array<View, 2> views{View{kSize}, View{size, 0.3}};
    const auto first = run(views[0]);
    const auto second = run(views[1], first->denoiser());
    const std::array<HostedRun*, 2> runs{first.get(), second.get()};
    std::array<std::vector<Bytes>, 2> results;
    {
      fg::vk::FrameQueue queue(context(), device().queue(), 2);
      for (std::uint32_t i = 0; i < kFrames; ++i) {
        const fg::vk::Frame frame = queue.begin();
        for (std::size_t v = 0; v < views.size(); ++v) {
          views[v].fill(*runs[v], i);
          runs[v]->record(frame, views[v].camera(i));
        }
        queue.submit(frame);
        // Frames are in flight two at a time, except where results are read.
        if (i + 2 < kFrames) continue;
        queue.wait(frame.slot);
        for (std::size_t v = 0; v < views.size(); ++v) results[v].push_back(runs[v]->resultOf(frame.slot));
      }
    }
    for (std::size_t v = 0; v < views.size(); ++v) {
      const std::vector<Bytes> expected = v == 0 ? expectedFirst : alone(views[v], kFrames);
      ASSERT_EQ(results[v].size(), 2U);
      EXPECT_EQ(results[v][0], expected[kFrames - 2]) << v;
      EXPECT_EQ(results[v][1], expected[kFrames - 1]) << v;
    }
  }
}

// Direct and indirect light, say, of one view: each has its own lighting, and both read the same guides.
TEST_F(SharedObjects, TwoLightsOfAViewReadOneSetOfGuides) {
  constexpr std::uint32_t kFrames = 4;
  const std::array<View, 2> lights{View{kSize}, View{kSize, 0.0, 0.25}};
  HostedRun::Options options;
  const auto first = run(lights[0]);
  options.sharedWith = first->denoiser();
  options.guidesOf = first.get();
  const auto second = std::make_unique<HostedRun>(device(), "walr", kSize, options);
  const std::array<HostedRun*, 2> runs{first.get(), second.get()};
  std::array<Bytes, 2> results;
  {
    fg::vk::FrameQueue queue(context(), device().queue(), 2);
    for (std::uint32_t i = 0; i < kFrames; ++i) {
      const fg::vk::Frame frame = queue.begin();
      for (std::size_t l = 0; l < lights.size(); ++l) {
        lights[l].fill(*runs[l], i);
        runs[l]->record(frame, lights[l].camera(i));
      }
      queue.submit(frame);
      if (i + 1 < kFrames) continue;
      queue.wait(frame.slot);
      for (std::size_t l = 0; l < lights.size(); ++l) results[l] = runs[l]->resultOf(frame.slot);
    }
  }
  EXPECT_NE(results[0], results[1]);
  for (std::size_t l = 0; l < lights.size(); ++l) EXPECT_EQ(results[l], alone(lights[l], kFrames).back()) << l;
}

TEST_F(SharedObjects, ASecondViewCreatesNoPipelineAndNoMemoryForTransients) {
  HostedRun::Options options;
  options.getInstanceProcAddr = countDeviceCalls(context().view.getInstanceProcAddr);
  HostedRun first(device(), "walr", kSize, options);
  require(walr_prepare(first.denoiser()));
  EXPECT_GT(deviceCalls.pipelines, 0U) << "the calls must be seen";
  const WalrMemory alone = memoryOf(first);
  EXPECT_EQ(deviceCalls.bytes, alone.allocated);
  EXPECT_EQ(alone.shared, 0U);

  deviceCalls = {};
  options.sharedWith = first.denoiser();
  HostedRun second(device(), "walr", kSize, options);
  require(walr_prepare(second.denoiser()));
  EXPECT_EQ(deviceCalls.pipelines, 0U);
  EXPECT_GT(deviceCalls.objects, 0U) << "its histories";
  const WalrMemory memory = memoryOf(second);
  EXPECT_GT(memory.shared, 0U);
  EXPECT_EQ(memory.shared, memoryOf(first).shared);
  EXPECT_GE(memory.shared, memory.transient);
  EXPECT_EQ(deviceCalls.bytes, memory.allocated - memory.shared);
  EXPECT_EQ(memory.allocated, alone.allocated);

  // Settings of one are not those of the other, and a pipeline is created once for both.
  require(walr_set_setting(first.denoiser(), "walr.fit-window", "off"));
  require(walr_set_setting(first.denoiser(), "blocks.size", "5"));
  require(walr_prepare(first.denoiser()));
  deviceCalls = {};
  require(walr_set_setting(second.denoiser(), "walr.fit-window", "off"));
  require(walr_set_setting(second.denoiser(), "blocks.size", "5"));
  require(walr_prepare(second.denoiser()));
  EXPECT_GT(deviceCalls.objects, 0U);
  EXPECT_EQ(deviceCalls.pipelines, 0U);
}

TEST_F(SharedObjects, OneMayBeDestroyedWhileTheOtherGoesOn) {
  constexpr std::uint32_t kFrames = 4;
  const std::array<View, 2> views{View{kSize}, View{kSize, 0.3}};
  for (const std::size_t kept : {0U, 1U}) {
    std::array<std::unique_ptr<HostedRun>, 2> runs;
    runs[0] = run(views[0]);
    runs[1] = run(views[1], runs[0]->denoiser());
    Bytes last;
    for (std::uint32_t i = 0; i < kFrames; ++i) {
      if (i == 2) runs[1 - kept].reset();
      for (std::size_t v = 0; v < views.size(); ++v) {
        if (runs[v] == nullptr) continue;
        views[v].fill(*runs[v], i);
        last = runs[v]->frameBytes(views[v].camera(i));
      }
    }
    EXPECT_EQ(last, alone(views[kept], kFrames).back()) << kept;
    EXPECT_EQ(memoryOf(*runs[kept]).shared, 0U);
  }
}

/// Calls the denoiser that shares with the one that logs.
struct Intruder {
  WalrDenoiser other = nullptr;
  WalrResult result = WALR_SUCCESS;

  static void call(void* user, WalrLogLevel /*level*/, const char* /*text*/) {
    auto* self = static_cast<Intruder*>(user);
    self->result = walr_prepare(self->other);
  }
};

TEST_F(SharedObjects, OnlyOneMayBeUsedAtATime) {
  Intruder intruder;
  HostedRun::Options options;
  options.log = Intruder::call;
  options.logUser = &intruder;
  options.alone = true;
  HostedRun first(device(), "accumulate", kSize, options);
  const auto second = run({kSize}, first.denoiser());
  const auto separate = run({kSize});
  intruder.other = second->denoiser();
  require(walr_prepare(first.denoiser()));
  EXPECT_EQ(intruder.result, WALR_ERROR_CONCURRENT_USE);
  intruder.other = separate->denoiser();
  require(walr_set_setting(first.denoiser(), "accumulation.rejection", "depth"));
  require(walr_prepare(first.denoiser()));
  EXPECT_EQ(intruder.result, WALR_SUCCESS);
  require(walr_prepare(second->denoiser()));
}

TEST_F(SharedObjects, AnotherDeviceADestroyedDenoiserAndSinglePassesAreRefused) {
  WalrDenoiser gone = nullptr;
  {
    const auto first = run({kSize});
    gone = first->denoiser();
    const fg::test::TestDevice other(instance(), fg::vk::physicalDevices(instance()).front());
    HostedRun::Options options;
    options.sharedWith = first->denoiser();
    expectError<std::runtime_error>([&] { const HostedRun elsewhere(other, "walr", kSize, options); },
                                    {"WALR_ERROR_INVALID_ARGUMENT", "another device or queue family"});
    const WalrDevice host = hostDevice(device());
    WalrDenoiserInfo info = denoiserInfo(&host);
    info.shared_with = first->denoiser();
    WalrPasses passes = nullptr;
    EXPECT_EQ(createPasses(info, passes), WALR_ERROR_INVALID_ARGUMENT);
    expectContains(walr_last_error(), {"shared_with is for walr_create_denoiser"});
  }
  expectError<std::runtime_error>([&] { (void)run({kSize}, gone); }, {"WALR_ERROR_INVALID_HANDLE"});
}

}  // namespace
}  // namespace walr::test::shared_objects_test
