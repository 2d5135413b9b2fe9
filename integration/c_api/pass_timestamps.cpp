#include "integration/c_api/pass_timestamps.h"

#include <array>

#include "framegraph/vulkan/timestamps.h"

namespace walr::api {
namespace {

constexpr std::uint32_t kQueriesPerPass = 2;  // Before and after it.

}  // namespace

PassTimestamps::PassTimestamps(const fg::vk::DeviceContext& device, const WalrPassList& list, std::uint32_t slots)
    : device_(&device), list_(&list), recorded_(slots, std::vector<bool>(list.pass_count)) {
  VkQueryPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
  info.queryType = VK_QUERY_TYPE_TIMESTAMP;
  info.queryCount = kQueriesPerPass * list.pass_count;
  for (std::uint32_t slot = 0; slot < slots; ++slot) {
    pools_.push_back(
        fg::vk::create<VkQueryPool>(device, device.functions.vkCreateQueryPool, info, "creating a pool of timestamps"));
  }
}

void PassTimestamps::beginFrame(std::uint32_t slot) {
  recorded_[slot].assign(list_->pass_count, false);
}

void PassTimestamps::beginPass(VkCommandBuffer commandBuffer, std::uint32_t slot, std::uint32_t pass) {
  device_->functions.vkCmdResetQueryPool(commandBuffer, pools_[slot].get(), kQueriesPerPass * pass, kQueriesPerPass);
  write(commandBuffer, slot, kQueriesPerPass * pass);
}

void PassTimestamps::endPass(VkCommandBuffer commandBuffer, std::uint32_t slot, std::uint32_t pass) {
  write(commandBuffer, slot, kQueriesPerPass * pass + 1);
  recorded_[slot][pass] = true;
}

void PassTimestamps::write(VkCommandBuffer commandBuffer, std::uint32_t slot, std::uint32_t query) const {
  device_->functions.vkCmdWriteTimestamp2(commandBuffer, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, pools_[slot].get(),
                                          query);
}

std::vector<WalrPassTime> PassTimestamps::read(std::uint32_t slot) const {
  std::vector<WalrPassTime> times;
  for (std::uint32_t pass = 0; pass < list_->pass_count; ++pass) {
    if (!recorded_[slot][pass]) continue;
    std::array<std::uint64_t, kQueriesPerPass> ticks{};
    const VkResult result = device_->functions.vkGetQueryPoolResults(
        device_->view.device, pools_[slot].get(), kQueriesPerPass * pass, kQueriesPerPass, sizeof(ticks), ticks.data(),
        sizeof(std::uint64_t), VK_QUERY_RESULT_64_BIT);
    if (result == VK_NOT_READY) return {};
    fg::vk::check(result, "reading timestamps");
    times.push_back({list_->passes[pass]->name, fg::vk::millisecondsBetween(*device_, ticks[0], ticks[1])});
  }
  return times;
}

}  // namespace walr::api
