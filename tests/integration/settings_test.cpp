// Settings and sizes that change between two frames: when they take effect, what is created, and whether history is
// kept.
#include <functional>

#include "framegraph/vulkan/pipelines.h"
#include "tests/integration/device_calls.h"
#include "tests/integration/hosted_run.h"
#include "tests/passes/reference/storage.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/passes/texel_codec.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::settings_test {
namespace {

using reference::HostFrame;

constexpr glm::ivec2 kSize(45, 37);
constexpr std::uint32_t kFrames = 6;
constexpr std::uint32_t kLastFrame = kFrames - 1;

using Texels = std::vector<std::uint16_t>;
using Change = std::function<void(WalrDenoiser)>;

void set(WalrDenoiser denoiser, const char* name, const char* value) {
  require(walr_set_setting(denoiser, name, value));
}

/// A frame of a sequence in which a camera moves past a sphere.
Texels walk(HostedRun& run, std::uint32_t frame, glm::ivec2 size = kSize) {
  const glm::dvec3 step(0.06, 0.02, -0.03);
  const FrameDescription camera = cameraAt(double(frame) * step, (double(frame) - 1.0) * step, size, frame);
  run.fill(renderFrame(sphere(), camera, size));
  return run.frame(camera);
}

bool finite(const Texels& texels) {
  constexpr unsigned kExponent = 0x7c00U;
  return std::ranges::all_of(texels, [](std::uint16_t half) { return (half & kExponent) != kExponent; });
}

std::uint64_t allocated(WalrDenoiser denoiser) {
  WalrMemory memory{};
  memory.struct_size = sizeof(memory);
  require(walr_get_memory(denoiser, &memory));
  return memory.allocated + memory.retired;
}

class Settings : public fg::test::GpuTest {
 protected:
  [[nodiscard]] HostedRun::Options counted() const {
    HostedRun::Options options;
    options.getInstanceProcAddr = countDeviceCalls(context().view.getInstanceProcAddr);
    return options;
  }
  /// The last frame of a sequence. A host makes some change before it.
  [[nodiscard]] Texels lastAfter(const char* method, const Change& change) const {
    HostedRun run(device(), method, kSize);
    for (std::uint32_t i = 0; i < kLastFrame; ++i) walk(run, i);
    change(run.denoiser());
    return walk(run, kLastFrame);
  }
};

/// A setting that changes only numbers, and one that changes the passes.
struct Adjustable {
  const char* method;
  const char* constant;
  const char* value;
  const char* usual;
  const char* topology;
  const char* other;
  const char* back;
};
constexpr Adjustable kAdjustables[] = {
    {"walr", "blocks.growth-errors", "1", "6", "antialiasing.enabled", "off", "on"},
    {"svgf", "svgf.sigma-normal", "2", "24", "svgf.iterations", "3", "4"},
    {"accumulate", "accumulation.normal-threshold", "0.99", "0.5", "accumulation.rejection", "depth", "plane"},
};

TEST_F(Settings, AConstantTakesEffectInTheNextFrameAndCreatesNothing) {
  for (const Adjustable& each : kAdjustables) {
    SCOPED_TRACE(each.method);
    HostedRun run(device(), each.method, kSize, counted());
    for (std::uint32_t i = 0; i < kLastFrame; ++i) walk(run, i);
    EXPECT_GT(deviceCalls.objects, 0U) << "the calls must be seen";
    EXPECT_GT(deviceCalls.pipelines, 0U);
    EXPECT_GT(deviceCalls.bytes, 0U);
    const std::uint64_t before = allocated(run.denoiser());
    deviceCalls = {};
    set(run.denoiser(), each.constant, each.value);
    require(walr_prepare(run.denoiser()));
    const Texels changed = walk(run, kLastFrame);
    EXPECT_EQ(deviceCalls.objects, 0U);
    EXPECT_EQ(deviceCalls.pipelines, 0U);
    EXPECT_EQ(deviceCalls.bytes, 0U);
    EXPECT_EQ(deviceCalls.waits, 0U);
    EXPECT_EQ(allocated(run.denoiser()), before);

    EXPECT_TRUE(finite(changed));
    const Texels unchanged = lastAfter(each.method, [](WalrDenoiser) {});
    EXPECT_NE(changed, unchanged);
    // The same in an executor that is created for the new setting and inherits the history.
    const Texels made = lastAfter(each.method, [&](WalrDenoiser denoiser) {
      set(denoiser, each.topology, each.other);
      require(walr_prepare(denoiser));
      set(denoiser, each.topology, each.back);
      set(denoiser, each.constant, each.value);
    });
    EXPECT_EQ(changed, made);
    EXPECT_EQ(lastAfter(each.method, [&](WalrDenoiser denoiser) { set(denoiser, each.constant, each.usual); }),
              unchanged);
  }
}

/// Light is constant and changes in the last frame. This shows the history length of a pixel: with length `n`, the mean
/// covers 1 / (n + 1) of the way from the old value to the new one.
class HistoryLength : public Settings {
 protected:
  static constexpr double kAfter = 1.875;
  static constexpr std::uint32_t kLast = 6;

  /// @param change called before each frame except the first
  [[nodiscard]] Texels lastPicture(const char* method,
                                   const std::function<void(HostedRun&, std::uint32_t)>& change) const {
    HostedRun run(device(), method, kSize, counted());
    if (std::string_view(method) == "walr") {
      // Else the result is no mean of frames, but has a share of the last one.
      set(run.denoiser(), "blocks.residual", "off");
      ignoreChangesOfLight(run.denoiser());
    }
    Texels last;
    for (std::uint32_t i = 0; i <= kLast; ++i) {
      if (i > 0) change(run, i);
      const FrameDescription camera = cameraAt({}, {}, kSize, i);
      const Light light = [i](glm::dvec3, glm::dvec3) { return glm::dvec3(i < kLast ? 1.0 : kAfter); };
      run.fill(renderFrame(flatWall(), camera, kSize, light, Noise::None));
      last = run.frame(camera);
    }
    return last;
  }
  static void expectSamplesBehind(const Texels& texels, std::uint32_t samples) {
    const double expected = 1.0 + (kAfter - 1.0) / (samples + 1.0);
    // For packed light: rounding of the mean, and the least size of anti-aliasing's clipping box.
    const double reach = reference::packedStep(expected, reference::kFilteredBits) + 2.0 / 3.0 * 0x1p-6 * expected;
    const reference::Image<glm::dvec4> picture = decodeHalves(texels, kSize);
    reference::forEachPixel(kSize, [&](glm::ivec2 p) { ASSERT_NEAR(picture[p].x, expected, reach + 0x1p-8); });
  }
};

TEST_F(HistoryLength, GrowsThroughConstantsThatChangeInEveryFrame) {
  for (const Adjustable& each : kAdjustables) {
    SCOPED_TRACE(each.method);
    expectSamplesBehind(lastPicture(each.method,
                                    [&](HostedRun& run, std::uint32_t frame) {
                                      set(run.denoiser(), each.constant, frame % 2 == 0 ? each.usual : each.value);
                                    }),
                        kLast);
  }
}

TEST_F(HistoryLength, GrowsThroughOtherPassesAndTheirPipelinesAreCreatedOnce) {
  for (const Adjustable& each : kAdjustables) {
    // The other passes test history against the previous frame's normals, which these passes do not keep.
    if (std::string_view(each.method) == "accumulate") continue;
    SCOPED_TRACE(each.method);
    expectSamplesBehind(lastPicture(each.method,
                                    [&](HostedRun& run, std::uint32_t frame) {
                                      deviceCalls = {};
                                      set(run.denoiser(), each.topology, frame % 2 == 0 ? each.back : each.other);
                                      require(walr_prepare(run.denoiser()));
                                      EXPECT_GT(deviceCalls.objects, 0U);
                                      EXPECT_EQ(deviceCalls.waits, 0U);
                                      if (frame > 1) {
                                        EXPECT_EQ(deviceCalls.pipelines, 0U) << frame;
                                      }
                                    }),
                        kLast);
  }
}

TEST_F(HistoryLength, RestartsIfTheFormatDiffers) {
  const Texels texels = lastPicture("walr", [](HostedRun& run, std::uint32_t frame) {
    if (frame == 1) set(run.denoiser(), "antialiasing.enabled", "off");
    if (frame == kLast) set(run.denoiser(), "accumulation.storage", "half");
  });
  expectSamplesBehind(texels, 0);
}

TEST_F(Settings, ANewSizeCreatesNoPipelinesAndDoesNotWait) {
  constexpr glm::ivec2 kOther(40, 45);
  HostedRun run(device(), "walr", kSize, counted());
  for (std::uint32_t i = 0; i < 3; ++i) walk(run, i);
  deviceCalls = {};
  run.resize(kOther);
  const Texels resized = walk(run, 3, kOther);
  EXPECT_GT(deviceCalls.bytes, 0U);
  EXPECT_EQ(deviceCalls.pipelines, 0U);
  EXPECT_EQ(deviceCalls.waits, 0U);
  EXPECT_TRUE(finite(resized));
}

TEST_F(Settings, UsesTheHostsPipelineCache) {
  fg::vk::PipelineCache cache(context());
  HostedRun::Options options = counted();
  options.pipelineCache = cache.handle();
  HostedRun run(device(), "accumulate", kSize, options);
  walk(run, 0);
  EXPECT_EQ(deviceCalls.caches, std::set{cache.handle()});
  deviceCalls.caches.clear();
  set(run.denoiser(), "accumulation.rejection", "depth");  // Takes other pipelines.
  walk(run, 1);
  EXPECT_EQ(deviceCalls.caches, std::set{cache.handle()});
  HostedRun without(device(), "accumulate", kSize, counted());
  walk(without, 0);
  EXPECT_EQ(deviceCalls.caches, std::set<VkPipelineCache>{VK_NULL_HANDLE});
}

}  // namespace
}  // namespace walr::test::settings_test
