#include "integration/c_api/hosted_lint.h"

#include <algorithm>
#include <utility>

namespace walr::api {

HostedLint::HostedLint(const fg::vk::DeviceContext& device, VkBufferUsageFlags usage,
                       const InputConventions& conventions, std::uint32_t slots)
    : buffer_(device, kLintBytes, usage, slots, "lint counters"), linter_(conventions), pending_(slots) {}

std::vector<LintFinding> HostedLint::collect(std::uint32_t slot) {
  const std::optional<Frame> frame = std::exchange(pending_[slot], std::nullopt);
  if (!frame) return {};
  const std::vector<std::uint32_t> words = buffer_.take(slot);
  // Each frame counts all of its pixels. Other sums are those of a frame that was recorded but never executed.
  const std::uint64_t pixels = std::uint64_t(frame->extent.width) * frame->extent.height;
  if (words[kLintPixels] != pixels) return {};
  counts_.clear();
  for (const LintCount& count : kLintCounts) counts_.push_back({count.name.data(), words[count.word]});
  linter_.add(words, frame->camera, frame->extent, frame->continues);
  findings_ = linter_.findings();
  std::vector<LintFinding> fresh;
  std::ranges::copy_if(findings_, std::back_inserter(fresh),
                       [&](const LintFinding& finding) { return known_.insert(finding.name).second; });
  return fresh;
}

void HostedLint::recordAfter(VkCommandBuffer commandBuffer, std::uint32_t slot, const Frame& frame) {
  buffer_.recordAfter(commandBuffer, slot);
  pending_[slot] = frame;
}

}  // namespace walr::api
