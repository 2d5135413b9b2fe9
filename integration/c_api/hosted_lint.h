#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include <walr/walr.h>

#include "integration/c_api/count_buffer.h"
#include "passes/lint/input_linter.h"

namespace walr::api {

/// A finding for the caller. Its texts are valid as long as `finding`.
inline WalrFinding toC(const LintFinding& finding) {
  return {finding.name.data(), finding.what.c_str(), finding.cause.data(), finding.wayOut.data()};
}

/// The check of a host's inputs while it renders: reads the counts of each frame once the GPU has finished it.
class HostedLint {
 public:
  /// @param usage  usage flags of the graph's import that receives the counts
  /// @param device must outlive the object
  HostedLint(const fg::vk::DeviceContext& device, VkBufferUsageFlags usage, const InputConventions& conventions,
             std::uint32_t slots);

  /// The buffer that receives the counts.
  [[nodiscard]] const CountBuffer& buffer() const { return buffer_; }

  /// Evaluate the counts of the frame recorded last with a slot. The GPU must have finished it.
  /// @returns findings with names that were not found before
  std::vector<LintFinding> collect(std::uint32_t slot);
  /// A recorded frame.
  struct Frame {
    FrameDescription camera;
    fg::Extent extent;
    bool continues = false;  ///< Whether its history was not reset.
  };
  /// Record after the graph, or after the pass that counts.
  void recordAfter(VkCommandBuffer commandBuffer, std::uint32_t slot, const Frame& frame);

  [[nodiscard]] const std::vector<LintFinding>& findings() const { return findings_; }
  /// Counts of the frame that was evaluated last; empty if none was.
  [[nodiscard]] const std::vector<WalrCounter>& counts() const { return counts_; }

 private:
  CountBuffer buffer_;
  InputLinter linter_;
  std::vector<std::optional<Frame>> pending_;  ///< By slot.
  std::vector<LintFinding> findings_;
  std::vector<WalrCounter> counts_;
  std::set<std::string_view> known_;
};

}  // namespace walr::api
