// A host that tells the library when its frames are finished gets an error if it records a frame too early.
#include <string>
#include <string_view>
#include <vector>

#include <walr/walr_passes.h>

#include "tests/error_text.h"
#include "tests/integration/hosted_run.h"
#include "tests/integration/replaced_function.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"
#include "tests/vulkan/timeline.h"

namespace walr::test::completion_test {
namespace {

using fg::test::expectContains;
using fg::test::expectError;
using fg::test::Timeline;

constexpr glm::ivec2 kSize(45, 37);

FrameDescription walkingCamera(std::uint32_t frame) {
  const glm::dvec3 step(0.06, 0.02, -0.03);
  return cameraAt(double(frame) * step, (double(frame) - 1.0) * step, kSize, frame);
}

/// A host with more command buffers than the denoiser has frames in flight: only the timeline tells of a misuse.
HostedRun::Options careless() {
  HostedRun::Options options;
  options.hostSlots = 8;
  return options;
}

class Completion : public fg::test::GpuTest {};

TEST_F(Completion, RecordingAFrameBeforeItsSlotIsFreeIsAnErrorThatChangesNothing) {
  const Timeline finished(context());
  const Timeline gate(context());
  HostedRun misused(device(), "walr", kSize, careless());
  HostedRun usual(device(), "walr", kSize);
  const auto submit = [&](std::uint32_t frame) {
    const FrameDescription camera = walkingCamera(frame);
    misused.fill(renderFrame(sphere(), camera, kSize));
    misused.submit(camera, 0, 0.0F, {.after = gate.at(1), .finished = finished.at(100 + frame)});
  };
  submit(0);
  submit(1);
  for (int attempt = 0; attempt < 2; ++attempt) {
    expectError<std::runtime_error>([&] { submit(2); }, {"WALR_ERROR_WRONG_ORDER", "frame 2 uses slot 0 of 2 again",
                                                         "not finished frame 0", "must be at 100 and is at 0"});
  }
  gate.signal(1);
  finished.wait(100);
  submit(2);
  finished.wait(101);
  for (std::uint32_t i = 0; i < 4; ++i) {
    const FrameDescription camera = walkingCamera(i);
    const reference::HostFrame frame = renderFrame(sphere(), camera, kSize);
    usual.fill(frame);
    const std::vector<std::uint16_t> expected = usual.frame(camera);
    if (i < 3) continue;
    misused.fill(frame);
    EXPECT_EQ(misused.frame(camera), expected);
  }
}

TEST_F(Completion, AHostThatWaitsNeverFails) {
  const Timeline finished(context());
  HostedRun run(device(), "walr", kSize, careless());
  for (std::uint32_t i = 0; i < 6; ++i) {
    if (i >= 2) finished.wait(i - 1);
    const FrameDescription camera = walkingCamera(i);
    run.fill(renderFrame(sphere(), camera, kSize));
    EXPECT_NO_THROW(run.submit(camera, 0, 0.0F, {.finished = finished.at(i + 1)})) << i;
  }
  finished.wait(6);
}

TEST_F(Completion, PassByPassBeginningAFrameTooEarlyIsAnError) {
  const Timeline finished(context());
  const WalrDevice host = hostDevice(device());
  WalrDenoiserInfo info = denoiserInfo(&host);
  WalrPasses passes = nullptr;
  require(createPasses(info, passes));
  const FrameDescription still = cameraAt({}, {}, kSize, 0);
  const WalrCamera camera = cameraOf(still.view, still.projection, {});
  const auto begin = [&](std::uint64_t value) {
    WalrPassFrame frame{};
    frame.struct_size = sizeof(frame);
    frame.camera = &camera;
    frame.finished = finished.at(value).semaphore;
    frame.finished_value = value;
    return walr_begin_frame(passes, &frame);
  };
  require(begin(1));
  require(begin(2));
  EXPECT_EQ(begin(3), WALR_ERROR_WRONG_ORDER);
  expectContains(walr_last_error(), {"frame 2 uses slot 0 of 2", "not finished frame 0", "must be at 1 and is at 0"});
  finished.signal(1);
  require(begin(3));
  EXPECT_EQ(begin(4), WALR_ERROR_WRONG_ORDER);
  expectContains(walr_last_error(), {"frame 3 uses slot 1 of 2", "must be at 2 and is at 1"});
  finished.signal(2);
  EXPECT_EQ(begin(1), WALR_ERROR_INVALID_ARGUMENT);
  expectContains(walr_last_error(), {"is 1, but frame 2 had 3"});
  require(begin(4));
  require(walr_destroy_passes(passes));
}

PFN_vkGetDeviceProcAddr realDeviceFunctions = nullptr;
PFN_vkVoidFunction withoutTimelines(VkDevice device, const char* name) {
  const bool timelines = std::string_view(name).substr(0, 26) == "vkGetSemaphoreCounterValue";
  return timelines ? nullptr : realDeviceFunctions(device, name);
}

TEST_F(Completion, ADeviceWithoutTimelineSemaphoresIsNamedOnlyIfTheyAreUsed) {
  const Timeline finished(context());
  HostedRun::Options options = careless();
  options.getInstanceProcAddr = replaceFunction(context(), "vkGetDeviceProcAddr", withoutTimelines);
  realDeviceFunctions = realFunction<PFN_vkGetDeviceProcAddr>();
  HostedRun run(device(), "walr", kSize, options);
  const FrameDescription camera = walkingCamera(0);
  run.fill(renderFrame(sphere(), camera, kSize));
  EXPECT_NO_THROW(run.frame(camera));
  expectError<std::runtime_error>([&] { run.submit(camera, 0, 0.0F, {.finished = finished.at(1)}); },
                                  {"WALR_ERROR_UNSUPPORTED", "feature timelineSemaphore"});
}

}  // namespace
}  // namespace walr::test::completion_test
