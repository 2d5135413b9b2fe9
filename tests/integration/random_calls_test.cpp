// Random sequences of calls of the C API, in right and wrong order and with right and wrong arguments. No call may
// crash, every result must be the one that a model of the API allows, and every error must have a text that names what
// is wrong.
//
// The environment chooses how much is tried, and another first seed:
//   WALR_SEQUENCES=100000        without a device
//   WALR_DEVICE_SEQUENCES=300    with a device and frames
//   WALR_SEED=1
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <iostream>
#include <thread>

#include "tests/integration/random_calls.h"
#include "tests/integration/random_frames.h"

namespace walr::test {
namespace {

std::uint64_t fromEnvironment(const char* variable, std::uint64_t otherwise) {
  const char* const text = std::getenv(variable);
  return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

const std::uint64_t kFirstSeed = fromEnvironment("WALR_SEED", 1);
const std::uint64_t kSequences = fromEnvironment("WALR_SEQUENCES", 10'000);
const std::uint64_t kDeviceSequences = fromEnvironment("WALR_DEVICE_SEQUENCES", 4);
constexpr std::uint32_t kCalls = 16;
constexpr std::uint32_t kDeviceCalls = 48;  ///< More, because creating pipelines takes most of the time.

struct Totals {
  std::uint64_t calls = 0;
  std::uint64_t failures = 0;
  std::string faults;
};

/// Runs a sequence of its own and adds what it found.
void runSequence(std::uint64_t seed, const RandomCalls::Host& host, Totals& totals) {
  RandomCalls sequence(seed, host);
  sequence.run(host.vulkan.device != nullptr ? kDeviceCalls : kCalls);
  totals.calls += sequence.check().calls();
  totals.failures += sequence.check().failures();
  for (const std::string& fault : sequence.check().faults()) {
    totals.faults += "seed " + std::to_string(seed) + ": " + fault + "\n";
  }
}

void report(const Totals& totals) {
  EXPECT_EQ(totals.faults, "");
  std::cout << totals.calls << " calls, " << totals.failures << " of them refused\n";
}

TEST(RandomCalls, WithoutADevice) {
  Totals totals;
  for (std::uint64_t i = 0; i < kSequences && totals.faults.empty(); ++i) runSequence(kFirstSeed + i, {}, totals);
  report(totals);
  // Both outcomes are tried.
  EXPECT_GT(totals.failures, totals.calls / 4);
  EXPECT_LT(totals.failures, totals.calls * 3 / 4);
}

TEST(RandomCalls, WithADeviceAndFrames) {
  Host host;
  host_open(&host);
  const WalrDevice device{.struct_size = sizeof(WalrDevice),
                          .queue_family = host.queue_family,
                          .instance = host.instance,
                          .physical_device = host.physical_device,
                          .device = host.device,
                          .get_instance_proc_addr = vkGetInstanceProcAddr,
                          .allocator = nullptr,
                          .create_info = nullptr,
                          .device_memory = nullptr};
  VkDeviceCreateInfo createInfo{};
  createInfo.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  createInfo.pNext = &host.features;
  VkPipelineCacheCreateInfo cacheInfo{};
  cacheInfo.sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO;
  VkPipelineCache cache = VK_NULL_HANDLE;
  ASSERT_EQ(vkCreatePipelineCache(host.device, &cacheInfo, nullptr, &cache), VK_SUCCESS);
  Totals totals;
  std::uint64_t frames = 0;
  std::uint64_t passes = 0;
  for (std::uint64_t i = 0; i < kDeviceSequences && totals.faults.empty(); ++i) {
    RandomFrames recorder(host);
    RandomMemory memory(device, kFirstSeed + i);
    const RandomHost vulkan{.device = &device, .createInfo = &createInfo, .pipelineCache = cache, .memory = &memory};
    runSequence(kFirstSeed + i, {.vulkan = vulkan, .recorder = &recorder, .shared = {}}, totals);
    frames += recorder.recorded();
    passes += recorder.recordedPasses();
    EXPECT_EQ(memory.blocks(), 0U) << "not freed, seed " << kFirstSeed + i;
    EXPECT_EQ(memory.wronglyFreed(), 0U) << "seed " << kFirstSeed + i;
  }
  report(totals);
  std::cout << frames << " frames and " << passes << " single passes recorded\n";
  EXPECT_GT(frames, 0U);
  EXPECT_GT(passes, 0U);
  vkDestroyPipelineCache(host.device, cache, nullptr);
  EXPECT_EQ(host_close(&host), 0);
}

/// Each thread has objects of its own, and both use the same few passes.
TEST(RandomCalls, FromTwoThreads) {
  std::array<WalrPasses, 6> shared{};
  WalrDenoiserInfo denoiser{};
  denoiser.struct_size = sizeof(denoiser);
  denoiser.width = 16;
  denoiser.height = 16;
  WalrPassesInfo info{};
  info.struct_size = sizeof(info);
  info.denoiser = &denoiser;
  const auto work = [&](std::uint64_t firstSeed, Totals& totals) {
    for (std::uint64_t i = 0; i < 20; ++i)
      runSequence(firstSeed + i, {.vulkan = {}, .recorder = nullptr, .shared = shared}, totals);
  };
  std::array<Totals, 2> totals;
  for (std::uint64_t round = 0; round < kSequences / 200 && totals[0].faults.empty() && totals[1].faults.empty();
       ++round) {
    for (WalrPasses& passes : shared) ASSERT_EQ(walr_create_passes(&info, &passes), WALR_SUCCESS);
    std::thread other(work, kFirstSeed + 40 * round, std::ref(totals[0]));
    work(kFirstSeed + 40 * round + 20, totals[1]);
    other.join();
    for (const WalrPasses passes : shared) walr_destroy_passes(passes);  // Some are destroyed already.
  }
  for (const Totals& one : totals) report(one);
}

}  // namespace
}  // namespace walr::test
