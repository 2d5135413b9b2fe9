// The C API gives the same pixels and histories as our own executor.
#include <cmath>
#include <cstring>
#include <functional>

#include <glm/packing.hpp>

#include "tests/integration/hosted_run.h"
#include "tests/passes/denoiser_run.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/passes/texel_codec.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::c_api_test {
namespace {

using reference::HostFrame;
using reference::Image;

constexpr glm::ivec2 kSize(45, 37);

/// A camera that moves past a sphere, so that some history is reprojected and some is disoccluded.
FrameDescription walkingCamera(std::uint32_t frame, glm::ivec2 size) {
  const glm::dvec3 step(0.06, 0.02, -0.03);
  return cameraAt(double(frame) * step, (double(frame) - 1.0) * step, size, frame);
}

std::vector<std::byte> bytesOf(const auto& texels) {
  std::vector<std::byte> bytes(texels.size() * sizeof(texels[0]));
  std::memcpy(bytes.data(), texels.data(), bytes.size());
  return bytes;
}

/// The frame's light as that of a specular lobe, with some pixels that have no sample.
HostFrame specularFrame(HostFrame frame) {
  frame.conventions.specular = true;
  frame.lightAlpha = frame.roughness = Image<double>(frame.size());
  frame.specularMotion = Image<glm::dvec3>(frame.size(), {0.25, 0.0, -0.125});
  reference::forEachPixel(frame.size(), [&](glm::ivec2 p) {
    frame.lightAlpha[p] = (p.x + p.y) % 5 == 0 ? 0.0 : 0.5 + 0.25 * (p.x % 4);
    frame.roughness[p] = double(p.x * 255 / frame.size().x) / 255.0;
  });
  return frame;
}

/// Number of pixels that differ in any channel.
int differing(const Image<glm::dvec4>& a, const Image<glm::dvec4>& b) {
  int count = 0;
  reference::forEachPixel(a.size(), [&](glm::ivec2 p) { count += a[p] == b[p] ? 0 : 1; });
  return count;
}

class CApi : public fg::test::GpuTest {};
class CApiMethod : public CApi, public testing::WithParamInterface<std::string> {};

TEST_P(CApiMethod, GivesThePixelsOfOurOwnExecutorThroughResetAndResize) {
  const auto method = makeDenoiser(GetParam());
  HostedRun hosted(device(), GetParam().c_str(), kSize);
  glm::ivec2 size = kSize;
  auto own = std::make_unique<DenoiserRun>(device(), *method, size);
  for (std::uint32_t i = 0; i < 7; ++i) {
    SCOPED_TRACE("frame " + std::to_string(i));
    std::uint32_t flags = 0;
    if (i == 3) {
      own->reset();
      flags = WALR_FRAME_RESET_HISTORY;
    }
    if (i == 5) {
      size = {40, 45};
      own = std::make_unique<DenoiserRun>(device(), *method, size);
      hosted.resize(size);
    }
    const FrameDescription camera = walkingCamera(i, size);
    const HostFrame frame = renderFrame(sphere(), camera, size);
    hosted.fill(frame);
    const Image<glm::dvec4> result = decodeHalves(hosted.frame(camera, flags), size);
    EXPECT_EQ(differing(result, own->frame(frame)), 0);
  }
}

TEST_P(CApiMethod, GivesThePixelsOfOurOwnExecutorOnSpecularLight) {
  const auto method = makeDenoiser(GetParam());
  HostedRun::Options options;
  options.specular = options.specularMotion = true;
  std::unique_ptr<HostedRun> hosted;
  try {
    hosted = std::make_unique<HostedRun>(device(), GetParam().c_str(), kSize, options);
  } catch (const std::runtime_error& refused) {
    EXPECT_NE(std::string_view(refused.what()).find("method '" + GetParam() + "' takes diffuse light only"),
              std::string_view::npos)
        << refused.what();
    EXPECT_THROW(DenoiserRun(device(), *method, kSize, {.specular = true}), std::invalid_argument);
    return;
  }
  DenoiserRun own(device(), *method, kSize, {.specular = true}, true);
  for (std::uint32_t i = 0; i < 4; ++i) {
    SCOPED_TRACE("frame " + std::to_string(i));
    const FrameDescription camera = walkingCamera(i, kSize);
    const HostFrame frame = specularFrame(renderFrame(sphere(), camera, kSize));
    hosted->fill(frame);
    const Image<glm::dvec4> result = decodeHalves(hosted->frame(camera), kSize);
    EXPECT_EQ(differing(result, own.frame(frame)), 0);
  }
}
INSTANTIATE_TEST_SUITE_P(Methods, CApiMethod, testing::ValuesIn(denoiserNames()));

TEST_F(CApi, ResetDropsTheHistoryAndNewSettingsKeepIt) {
  const FrameDescription camera = cameraAt({}, {}, kSize, 0);
  const HostFrame first = renderFrame(flatWall(), camera, kSize);
  const HostFrame second = renderFrame(flatWall(), cameraAt({}, {}, kSize, 7), kSize);
  const auto secondAfterFirst = [&](auto&& between) {
    HostedRun run(device(), "accumulate", kSize);
    run.fill(first);
    run.frame(camera);
    between(run.denoiser());
    run.fill(second);
    return run.frame(camera);
  };
  HostedRun fresh(device(), "accumulate", kSize);
  fresh.fill(second);
  const std::vector<std::uint16_t> alone = fresh.frame(camera);
  const std::vector<std::uint16_t> both = secondAfterFirst([](WalrDenoiser) {});
  EXPECT_NE(both, alone);
  EXPECT_EQ(secondAfterFirst([](WalrDenoiser denoiser) { require(walr_reset_history(denoiser)); }), alone);
  // Two frames are fewer than both history lengths.
  EXPECT_EQ(secondAfterFirst(
                [](WalrDenoiser denoiser) { require(walr_set_setting(denoiser, "accumulation.max-history", "7")); }),
            both);
}

TEST_F(CApi, AResetLastsOneFrame) {
  const FrameDescription camera = cameraAt({}, {}, kSize, 0);
  const HostFrame first = renderFrame(flatWall(), camera, kSize);
  const HostFrame second = renderFrame(flatWall(), cameraAt({}, {}, kSize, 7), kSize);
  const auto lastOf = [&](HostedRun& run) {
    run.fill(second);
    run.frame(camera);
    run.fill(first);
    return run.frame(camera);
  };
  HostedRun fresh(device(), "accumulate", kSize);
  HostedRun resetLater(device(), "accumulate", kSize);
  resetLater.fill(first);
  resetLater.frame(camera);
  require(walr_reset_history(resetLater.denoiser()));
  EXPECT_EQ(lastOf(resetLater), lastOf(fresh));
}

TEST_F(CApi, AcceptsOtherFormatsAndRemembersTheCamera) {
  HostedRun usual(device(), "walr", kSize);
  HostedRun other(device(), "walr", kSize,
                  {.conventions = {},
                   .formats = {VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_R32_SFLOAT, VK_FORMAT_R32G32B32A32_SFLOAT,
                               VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_R16G16B16A16_SFLOAT},
                   .rememberedCamera = true});
  const auto floats = [](const Image<glm::dvec3>& image) {
    std::vector<glm::vec4> texels;
    for (const glm::dvec3& value : image.pixels()) texels.emplace_back(glm::vec3(value), 0.0F);
    return bytesOf(texels);
  };
  for (std::uint32_t i = 0; i < 3; ++i) {
    const FrameDescription camera = walkingCamera(i, kSize);
    const HostFrame frame = renderFrame(thinBars(), camera, kSize);
    usual.fill(frame);
    other.fill(frame);
    other.fill("lighting", floats(frame.lighting));
    other.fill("normal", floats(frame.normal));
    other.fill("motion", floats(frame.motion));
    EXPECT_EQ(usual.frame(camera), other.frame(camera)) << i;
  }
}

void keepWarning(void* user, WalrLogLevel level, const char* text) {
  if (level == WALR_LOG_WARNING) static_cast<std::vector<std::string>*>(user)->emplace_back(text);
}

TEST_F(CApi, LogsEachFindingOnce) {
  using Names = std::vector<std::string>;
  constexpr std::uint32_t kFrames = 5;
  for (const bool good : {true, false}) {
    HostedRun::Options options;
    options.lint = true;
    options.conventions.motion_scale[0] = good ? 1.0F : -1.0F;
    std::vector<std::string> log;
    options.log = keepWarning;
    options.logUser = &log;
    HostedRun run(device(), "walr", kSize, options);
    EXPECT_EQ(findingsOf(run.denoiser()), Names{});
    for (std::uint32_t i = 0; i < kFrames; ++i) {
      const FrameDescription camera = walkingCamera(i, kSize);
      run.fill(renderFrame(sphere(), camera, kSize));
      run.frame(camera);
    }
    EXPECT_EQ(findingsOf(run.denoiser()), good ? Names{} : Names{"motion-x-direction"});
    ASSERT_EQ(log.size(), good ? 0U : 1U);
    if (!good) {
      EXPECT_NE(log[0].find("Way out: negate this axis"), std::string::npos) << log[0];
    }
    // They are of the frames so far until there is one of the new size.
    run.resize({40, 45});
    EXPECT_EQ(findingsOf(run.denoiser()).size(), log.size());
    require(walr_prepare(run.denoiser()));
    EXPECT_EQ(findingsOf(run.denoiser()), Names{});
  }
  // A denoiser without lint has no findings to return.
  HostedRun run(device(), "walr", kSize);
  std::uint32_t count = 0;
  EXPECT_EQ(walr_get_findings(run.denoiser(), &count, nullptr), WALR_ERROR_WRONG_ORDER);
}

TEST_F(CApi, LintsSpecularLight) {
  using Names = std::vector<std::string>;
  for (const bool good : {true, false}) {
    HostedRun::Options options;
    options.lint = options.specular = true;
    HostedRun run(device(), "accumulate", kSize, options);
    for (std::uint32_t i = 0; i < 4; ++i) {
      const FrameDescription camera = walkingCamera(i, kSize);
      HostFrame frame = specularFrame(renderFrame(sphere(), camera, kSize));
      if (!good) frame.lightAlpha = Image<double>(kSize, 0.0);
      run.fill(frame);
      run.frame(camera);
    }
    EXPECT_EQ(findingsOf(run.denoiser()), good ? Names{} : Names{"lighting-empty"});
  }
}

// The first one is the most frequent mistake of engines, which mark no frame or every frame as a cut.
TEST_F(CApi, MistakesAreToldInTenFrames) {
  struct Mistake {
    const char* finding;
    std::function<void(HostFrame&, FrameDescription&)> make;
    std::uint32_t flags = 0;
  };
  const auto previousIsThis = [](HostFrame&, FrameDescription& camera) { camera.previousView = camera.view; };
  const Mistake mistakes[] = {
      {"camera-still", previousIsThis},
      {"camera-still", previousIsThis, WALR_FRAME_RESET_HISTORY},
      {"lighting-zero",
       [](HostFrame& frame, FrameDescription&) {
         frame.lighting = reference::Image<glm::dvec3>(kSize, glm::dvec3(0.0));
       }},
      {"view-position",
       [](HostFrame&, FrameDescription& camera) {
         for (glm::mat4* view : {&camera.view, &camera.previousView}) (*view)[3] = glm::vec4(0.0F, 0.0F, 0.0F, 1.0F);
       }},
  };
  for (const Mistake& mistake : mistakes) {
    HostedRun::Options options;
    options.lint = true;
    HostedRun run(device(), "walr", kSize, options);
    for (std::uint32_t i = 0; i < 10; ++i) {
      FrameDescription camera = walkingCamera(i, kSize);
      HostFrame frame = renderFrame(sphere(), camera, kSize);
      mistake.make(frame, camera);
      run.fill(frame);
      run.frame(camera, mistake.flags);
    }
    EXPECT_EQ(findingsOf(run.denoiser()), std::vector<std::string>{mistake.finding}) << mistake.flags;
  }
}

TEST_F(CApi, MemoryEqualsThePlanAndTheAllocations) {
  HostedRun run(device(), "walr", {640, 360});
  require(walr_prepare(run.denoiser()));
  WalrMemory memory{};
  memory.struct_size = sizeof(memory);
  require(walr_get_memory(run.denoiser(), &memory));
  EXPECT_LT(memory.transient, memory.transient_unaliased);
  EXPECT_GE(memory.transient, memory.transient_least);
  // Histories are placed one after the other, each at its alignment. The upload buffers are small.
  EXPECT_GE(memory.allocated, memory.persistent + memory.transient);
  EXPECT_LT(memory.allocated, memory.persistent + memory.transient + (1U << 16));
}

}  // namespace
}  // namespace walr::test::c_api_test
