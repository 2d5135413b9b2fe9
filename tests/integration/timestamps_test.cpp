// GPU times that the host reads.
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <walr/walr_passes.h>

#include "tests/integration/hosted_run.h"
#include "tests/integration/replaced_function.h"
#include "tests/passes/synthetic_scene.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test::timestamps_test {
namespace {

void familiesWithoutTimestamps(VkPhysicalDevice device, std::uint32_t* count, VkQueueFamilyProperties* families) {
  realFunction<PFN_vkGetPhysicalDeviceQueueFamilyProperties>()(device, count, families);
  for (std::uint32_t i = 0; families != nullptr && i < *count; ++i) families[i].timestampValidBits = 0;
}

void keepWarning(void* user, WalrLogLevel level, const char* text) {
  if (level == WALR_LOG_WARNING) static_cast<std::vector<std::string>*>(user)->emplace_back(text);
}

std::uint32_t timeCount(WalrDenoiser denoiser) {
  std::uint32_t count = 0;
  require(walr_get_timings(denoiser, &count, nullptr));
  return count;
}

class Timings : public fg::test::GpuTest {};

// A frame's queries may be read once the host has waited for it, and that is certain when its slot is used again.
TEST_F(Timings, OfAFrameAreKnownWhenItsSlotIsUsedAgain) {
  constexpr glm::ivec2 kSize(45, 37);
  HostedRun run(device(), "walr", kSize, {.timestamps = true, .framesInFlight = 2});
  std::uint32_t recorded = 0;
  const auto frame = [&] {
    const FrameDescription camera = cameraAt({}, {}, kSize, recorded++);
    run.fill(renderFrame(sphere(), camera, kSize));
    run.frame(camera);
  };
  for (int i = 0; i < 2; ++i) {
    frame();
    EXPECT_EQ(timeCount(run.denoiser()), 0U);
  }
  frame();
  EXPECT_GT(timeCount(run.denoiser()), 3U);
  // Times and memory are those of the frames so far until the next one, even if the host asks what that will need.
  require(walr_set_setting(run.denoiser(), "blocks.iterations", "1"));
  WalrImageRequirements needs{};
  needs.struct_size = sizeof(needs);
  require(walr_get_image_requirements(run.denoiser(), "depth", &needs));
  EXPECT_GT(timeCount(run.denoiser()), 3U);
  WalrMemory memory{};
  memory.struct_size = sizeof(memory);
  require(walr_get_memory(run.denoiser(), &memory));
  EXPECT_GT(memory.allocated, 0U);
  EXPECT_EQ(memory.retired, 0U);
  frame();
  EXPECT_EQ(timeCount(run.denoiser()), 0U);
  require(walr_get_memory(run.denoiser(), &memory));
  EXPECT_GT(memory.retired, 0U);
}

// The host is warned, and everything else works.
class QueueWithoutTimestamps : public fg::test::GpuTest {};

TEST_F(QueueWithoutTimestamps, IsAWarningInBothWays) {
  WalrDevice host = hostDevice(device());
  host.get_instance_proc_addr =
      replaceFunction(context(), "vkGetPhysicalDeviceQueueFamilyProperties", familiesWithoutTimestamps);
  std::vector<std::string> log;
  WalrDenoiserInfo info = denoiserInfo(&host);
  info.timestamps = VK_TRUE;
  info.log = keepWarning;
  info.log_user = &log;
  std::uint32_t count = 1;
  WalrDenoiser denoiser = nullptr;
  require(walr_create_denoiser(&info, &denoiser));
  require(walr_get_timings(denoiser, &count, nullptr));
  EXPECT_EQ(count, 0U);
  require(walr_destroy_denoiser(denoiser));

  WalrPasses passes = nullptr;
  require(createPasses(info, passes));
  count = 1;
  require(walr_get_pass_timings(passes, &count, nullptr));
  EXPECT_EQ(count, 0U);
  require(walr_destroy_passes(passes));

  const std::string text = "queue family " + std::to_string(host.queue_family) + " has no timestamps: no times are ";
  ASSERT_EQ(log.size(), 2U);
  EXPECT_EQ(log[0].substr(0, text.size()), text);
  EXPECT_EQ(log[0], log[1]);
}

}  // namespace
}  // namespace walr::test::timestamps_test
