#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "framegraph/vulkan/executor.h"
#include "framegraph/vulkan/staged_buffer.h"
#include "passes/input_linter.h"

namespace walr::api {

/// The check of a host's inputs while it renders: reads the counts of each frame once the GPU has finished it.
class HostedLint {
 public:
  /// @param usage  usage flags of the graph's import that receives the counts
  /// @param device must outlive the object
  HostedLint(const fg::vk::DeviceContext& device, VkBufferUsageFlags usage, const InputConventions& conventions,
             std::uint32_t slots);

  /// The buffer that receives the counts.
  [[nodiscard]] VkBuffer counters() const { return counters_.handle(); }

  /// Evaluate the counts of the frame recorded last with a slot. The GPU must have finished it.
  /// @returns findings with names that were not found before
  std::vector<LintFinding> collect(std::uint32_t slot);
  /// Record before the graph.
  void recordBefore(VkCommandBuffer commandBuffer) const;
  /// Record after the graph.
  /// @param camera nothing for a frame without a previous frame
  void recordAfter(VkCommandBuffer commandBuffer, std::uint32_t slot, const std::optional<FrameDescription>& camera,
                   fg::Extent extent);

  [[nodiscard]] const std::vector<LintFinding>& findings() const { return findings_; }

 private:
  struct Pending {
    std::optional<FrameDescription> camera;
    fg::Extent extent;
  };

  const fg::vk::DeviceContext* device_;
  fg::vk::StagedBuffer counters_;
  InputLinter linter_;
  std::vector<std::optional<Pending>> pending_;  ///< By slot.
  std::vector<LintFinding> findings_;
  std::set<std::string_view> known_;
};

}  // namespace walr::api
