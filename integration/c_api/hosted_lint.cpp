#include "integration/c_api/hosted_lint.h"

#include <algorithm>
#include <utility>

#include "framegraph/vulkan/memory_barrier.h"
#include "passes/inspection.h"

namespace walr::api {

HostedLint::HostedLint(const fg::vk::DeviceContext& device, VkBufferUsageFlags usage,
                       const InputConventions& conventions, std::uint32_t slots)
    : device_(&device),
      counters_(device, fg::BufferDesc{kCounterBytes}, usage, slots, "lint counters"),
      linter_(conventions),
      pending_(slots) {}

std::vector<LintFinding> HostedLint::collect(std::uint32_t slot) {
  const std::optional<Pending> pending = std::exchange(pending_[slot], std::nullopt);
  if (!pending) return {};
  std::vector<std::uint32_t> words(kCounterWords);
  std::ranges::copy(counters_.staging(slot), std::as_writable_bytes(std::span(words)).begin());
  linter_.add(words, pending->camera.has_value());
  if (pending->camera) linter_.add(*pending->camera, pending->extent);
  findings_ = linter_.findings();
  std::vector<LintFinding> fresh;
  std::ranges::copy_if(findings_, std::back_inserter(fresh),
                       [&](const LintFinding& finding) { return known_.insert(finding.name).second; });
  return fresh;
}

void HostedLint::recordBefore(VkCommandBuffer commandBuffer) const {
  fg::vk::recordMemoryBarrier(*device_, commandBuffer, {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_NONE},
                              {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT});
}

void HostedLint::recordAfter(VkCommandBuffer commandBuffer, std::uint32_t slot,
                             const std::optional<FrameDescription>& camera, fg::Extent extent) {
  fg::vk::recordMemoryBarrier(*device_, commandBuffer,
                              {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT},
                              {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT});
  counters_.recordReadback(commandBuffer, slot);
  pending_[slot] = {camera, extent};
}

}  // namespace walr::api
