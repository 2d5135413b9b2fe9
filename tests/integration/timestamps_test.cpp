// A queue without timestamps: the host is warned, and everything else works.
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <walr/walr_passes.h>

#include "tests/integration/hosted_run.h"
#include "tests/integration/replaced_function.h"
#include "tests/vulkan/gpu_fixture.h"

namespace walr::test {
namespace {

void familiesWithoutTimestamps(VkPhysicalDevice device, std::uint32_t* count, VkQueueFamilyProperties* families) {
  realFunction<PFN_vkGetPhysicalDeviceQueueFamilyProperties>()(device, count, families);
  for (std::uint32_t i = 0; families != nullptr && i < *count; ++i) families[i].timestampValidBits = 0;
}

void keepWarning(void* user, WalrLogLevel level, const char* text) {
  if (level == WALR_LOG_WARNING) static_cast<std::vector<std::string>*>(user)->emplace_back(text);
}

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
}  // namespace walr::test
