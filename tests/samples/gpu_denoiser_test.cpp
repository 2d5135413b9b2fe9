// `GpuDenoiser` with one and with several frames in flight, and the file of compiled pipelines.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

#include "passes/methods/denoiser.h"
#include "samples/denoise/gpu_denoiser.h"
#include "samples/image/half.h"
#include "tests/samples/synthetic_sequence.h"
#include "tests/samples/temporary_directory.h"

namespace walr::gpu_denoiser_test {
namespace {

constexpr int kWidth = 40;
constexpr int kHeight = 36;
constexpr fg::Extent kExtent{kWidth, kHeight};

class GpuDenoiserTest : public testing::Test {
 protected:
  void TearDown() override { EXPECT_NO_THROW(gpu.refuseMessages()); }

  GpuDevice gpu{{.device = {}, .validation = true}};
};

/// Frames of the wall, each with different light, one of them after a camera cut.
std::vector<PackedFrame> frames() {
  std::vector<PackedFrame> frames;
  for (int number = 0; number < 7; ++number) {
    Frame frame = test::projectFrame(number, kWidth, kHeight);
    for (std::size_t i = 0; i < frame.indirect.values().size(); ++i) {
      const auto mixed = static_cast<std::uint32_t>(i * 2654435761U + static_cast<std::uint32_t>(number) * 40503U);
      frame.indirect.values()[i] = toHalf(static_cast<float>(mixed >> 24U) / 64.0F);
    }
    frame.camera.projection = glm::perspective(1.0F, static_cast<float>(kWidth) / kHeight, 0.1F, 100.0F);
    frame.previousProjection = frame.camera.projection;
    frame.resetHistory = number == 0 || number == 4;
    frames.push_back(packFrame(std::move(frame)));
  }
  return frames;
}

std::vector<DenoisedFrame> denoiseAll(const GpuDevice& gpu, std::string_view method, const InspectionWish& wanted,
                                      std::uint32_t framesInFlight) {
  GpuDenoiser denoiser(gpu, *makeDenoiser(method), kExtent, projectLayout(), wanted, framesInFlight);
  std::vector<DenoisedFrame> results;
  for (PackedFrame& frame : frames()) {
    if (denoiser.full()) results.push_back(*denoiser.finish());
    denoiser.submit(std::move(frame));
  }
  while (std::optional<DenoisedFrame> last = denoiser.finish()) results.push_back(std::move(*last));
  return results;
}

// Of `SpecularMotion` in the frames, where they have it: history follows what a mirror shows.
TEST_F(GpuDenoiserTest, HistoryFollowsTheMotionThatFramesTell) {
  Layout layout = projectLayout();
  layout.conventions.specular = true;
  const std::vector<std::string> views{"reflection-motion"};
  const auto motion = [&](float moved, const OptionalImages& given) {
    GpuDenoiser denoiser(gpu, *makeDenoiser("walr"), kExtent, layout, {.views = views}, 1, given);
    DenoisedPicture picture;
    for (PackedFrame& packed : frames()) {
      Frame frame = std::move(packed.frame);
      frame.specular = frame.specularAlbedo = frame.indirect;
      frame.specularDistance = frame.depth;
      frame.roughness = Image(kWidth, kHeight, 1);
      frame.specularMotion = Image(kWidth, kHeight, 3);
      for (std::size_t i = 0; i < frame.specularMotion.pixelCount(); ++i) frame.specularMotion.pixel(i)[0] = moved;
      picture = denoiser.run(packFrame(std::move(frame), Light::Specular));
    }
    return picture.views.front().image.at(kWidth / 2, kHeight / 2, 0);
  };
  EXPECT_EQ(motion(0.0F, {.specularMotion = true}), 0.0F);
  EXPECT_EQ(motion(0.25F, {}), 0.0F);
  EXPECT_GT(motion(0.25F, {.specularMotion = true}), 0.25F);
  EXPECT_LT(motion(-0.25F, {.specularMotion = true}), -0.25F);
}

TEST_F(GpuDenoiserTest, FramesInFlightDoNotChangeABit) {
  const std::vector<std::string> views{"history", "samples"};
  const InspectionWish wanted{.views = views, .counters = true};
  const std::vector<DenoisedFrame> one = denoiseAll(gpu, "walr", wanted, 1);
  ASSERT_EQ(one.size(), frames().size());
  EXPECT_FALSE(std::ranges::equal(one[1].indirect.values(), one[4].indirect.values()));
  for (const std::uint32_t inFlight : {2U, 3U}) {
    const std::vector<DenoisedFrame> several = denoiseAll(gpu, "walr", wanted, inFlight);
    ASSERT_EQ(several.size(), one.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
      SCOPED_TRACE("frame " + std::to_string(i) + ", " + std::to_string(inFlight) + " in flight");
      EXPECT_EQ(several[i].frame.number, one[i].frame.number);
      EXPECT_TRUE(std::ranges::equal(several[i].indirect.values(), one[i].indirect.values()));
      ASSERT_EQ(several[i].views.size(), views.size());
      for (std::size_t v = 0; v < views.size(); ++v)
        EXPECT_TRUE(std::ranges::equal(several[i].views[v].image.values(), one[i].views[v].image.values()));
      ASSERT_FALSE(one[i].counters.empty());
      ASSERT_EQ(several[i].counters.size(), one[i].counters.size());
      for (std::size_t c = 0; c < one[i].counters.size(); ++c)
        EXPECT_EQ(several[i].counters[c].value, one[i].counters[c].value) << one[i].counters[c].name;
    }
  }
}

TEST_F(GpuDenoiserTest, RefusesMoreFramesThanMayBeInFlight) {
  GpuDenoiser denoiser(gpu, *makeDenoiser("none"), kExtent, projectLayout(), {}, 2);
  const std::vector<PackedFrame> all = frames();
  EXPECT_FALSE(denoiser.finish().has_value());
  denoiser.submit(all[0]);
  EXPECT_FALSE(denoiser.full());
  EXPECT_THROW(denoiser.run(all[1]), std::logic_error);
  denoiser.submit(all[1]);
  EXPECT_TRUE(denoiser.full());
  EXPECT_THROW(denoiser.submit(all[2]), std::logic_error);
  EXPECT_EQ(denoiser.finish()->frame.number, 0);
  EXPECT_EQ(denoiser.finish()->frame.number, 1);
  EXPECT_EQ(denoiser.denoise(all[2]).frame.number, 2);
}

// As where a frame cannot be read: the device then still works on those before it.
TEST_F(GpuDenoiserTest, MayBeDestroyedWithFramesInFlight) {
  const std::vector<PackedFrame> all = frames();
  {
    GpuDenoiser denoiser(gpu, *makeDenoiser("svgf"), kExtent, projectLayout(), {}, 2);
    denoiser.submit(all[0]);
    denoiser.submit(all[1]);
  }
  EXPECT_NO_THROW(gpu.refuseMessages());
}

/// Sets an environment variable of this process, and restores it afterwards.
class Environment {
 public:
  Environment(std::string name, const char* value) : name_(std::move(name)) {
    if (const char* const before = std::getenv(name_.c_str())) before_ = before;
    set(value);
  }
  ~Environment() { set(before_ ? before_->c_str() : nullptr); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  void set(const char* value) const { value != nullptr ? setenv(name_.c_str(), value, 1) : unsetenv(name_.c_str()); }
  std::string name_;
  std::optional<std::string> before_;
};

TEST(PipelineCacheFile, LiesInTheUsersCacheFolder) {
  const GpuDevice gpu({.device = {}, .validation = false});
  const fg::vk::DeviceContext& device = gpu.device().context();
  EXPECT_EQ(gpu.pipelineCache(), nullptr);
  const Environment home("HOME", "/home/of/someone");
  const Environment xdg("XDG_CACHE_HOME", "/somewhere/else");
  EXPECT_EQ(pipelineCacheFile(device).parent_path(), "/somewhere/else/walr");
  const Environment relative("XDG_CACHE_HOME", "not/absolute");
  EXPECT_EQ(pipelineCacheFile(device).parent_path(), "/home/of/someone/.cache/walr");
  const Environment none("HOME", nullptr);
  EXPECT_TRUE(pipelineCacheFile(device).empty());
}

TEST(PipelineCacheFile, IsWrittenWhereAskedForAndReadAtTheNextStart) {
  const test::TemporaryDirectory folder;
  const Environment xdg("XDG_CACHE_HOME", folder.path().c_str());
  const auto loadedBytes = [] {
    const GpuDevice gpu({.device = {}, .validation = false, .keepPipelines = true});
    GpuDenoiser denoiser(gpu, *makeDenoiser("accumulate"), kExtent, projectLayout());
    denoiser.run(frames().front());
    return gpu.pipelineCache()->loadedBytes();
  };
  EXPECT_EQ(loadedBytes(), 0U);
  EXPECT_GT(loadedBytes(), 0U);
  std::filesystem::path file;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path() / "walr")) {
    EXPECT_TRUE(file.empty()) << entry.path() << " beside " << file;
    file = entry.path();
  }
  test::writeText(file, "damaged");
  EXPECT_EQ(loadedBytes(), 0U);
  EXPECT_GT(loadedBytes(), 0U);
}

// A cache that cannot be written must not be an error.
TEST(PipelineCacheFile, MayBeImpossible) {
  const Environment xdg("XDG_CACHE_HOME", "/dev/null/no/folder");
  const GpuDevice gpu({.device = {}, .validation = false, .keepPipelines = true});
  GpuDenoiser denoiser(gpu, *makeDenoiser("none"), kExtent, projectLayout());
  EXPECT_NO_THROW(denoiser.run(frames().front()));
}

}  // namespace
}  // namespace walr::gpu_denoiser_test
