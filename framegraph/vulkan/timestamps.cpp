#include "framegraph/vulkan/timestamps.h"

namespace fg::vk {

double millisecondsBetween(const DeviceContext& device, std::uint64_t firstTick, std::uint64_t lastTick) {
  const std::uint64_t mask = device.timestampBits >= 64 ? ~0ull : (1ull << device.timestampBits) - 1;
  constexpr double kMillisecondsPerNanosecond = 1e-6;
  return static_cast<double>((lastTick - firstTick) & mask) *
         static_cast<double>(device.properties.limits.timestampPeriod) * kMillisecondsPerNanosecond;
}

Timestamps::Timestamps(const DeviceContext& device, const GraphDesc& graph, const Plan& plan, std::uint32_t slots)
    : device_(&device),
      queryCount_(static_cast<std::uint32_t>(plan.passes.size()) + 1),
      recorded_(slots),
      ticks_(queryCount_) {
  if (device.timestampBits == 0) {
    throw Unsupported("queue family " + std::to_string(device.view.queueFamily) +
                          " has no timestamps: run without them or choose another queue family",
                      VK_ERROR_FEATURE_NOT_PRESENT);
  }
  VkQueryPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
  info.queryType = VK_QUERY_TYPE_TIMESTAMP;
  info.queryCount = queryCount_;
  for (std::uint32_t slot = 0; slot < slots; ++slot) {
    pools_.push_back(
        create<VkQueryPool>(device, device.functions.vkCreateQueryPool, info, "creating a pool of timestamps"));
  }
  for (const PlannedPass& pass : plan.passes) times_.push_back({graph.passes[pass.pass].name, 0.0});
}

void Timestamps::begin(VkCommandBuffer commandBuffer, std::uint32_t slot) {
  device_->functions.vkCmdResetQueryPool(commandBuffer, pools_[slot].get(), 0, queryCount_);
  write(commandBuffer, slot, 0);
  recorded_[slot] = true;
}

void Timestamps::endPass(VkCommandBuffer commandBuffer, std::uint32_t slot, std::uint32_t plannedPass) {
  write(commandBuffer, slot, plannedPass + 1);
}

void Timestamps::write(VkCommandBuffer commandBuffer, std::uint32_t slot, std::uint32_t query) {
  device_->functions.vkCmdWriteTimestamp2(commandBuffer, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, pools_[slot].get(),
                                          query);
}

std::span<const PassTime> Timestamps::read(std::uint32_t slot) {
  if (!recorded_[slot]) return {};
  const VkResult result = device_->functions.vkGetQueryPoolResults(
      device_->view.device, pools_[slot].get(), 0, queryCount_, ticks_.size() * sizeof(std::uint64_t), ticks_.data(),
      sizeof(std::uint64_t), VK_QUERY_RESULT_64_BIT);
  if (result == VK_NOT_READY) return {};
  check(result, "reading timestamps");
  for (std::size_t i = 0; i < times_.size(); ++i) {
    times_[i].milliseconds = millisecondsBetween(*device_, ticks_[i], ticks_[i + 1]);
  }
  return times_;
}

}  // namespace fg::vk
