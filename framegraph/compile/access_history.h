#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "framegraph/plan/plan.h"

namespace fg {

/// Consecutive accesses to one subresource that need no barrier among themselves: one write, or any number of reads in
/// one layout. One barrier before the first access is enough for all of them.
struct AccessGroup {
  std::uint32_t batch = 0;  ///< Batch of the first access.
  VkPipelineStageFlags2 stage = VK_PIPELINE_STAGE_2_NONE;
  VkAccessFlags2 readMask = VK_ACCESS_2_NONE;
  VkAccessFlags2 writeMask = VK_ACCESS_2_NONE;
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
};

/// The groups of every subresource in execution order.
///
/// A subresource here is one mip level of one array layer. A buffer has one. A history counts as one whatever its mip
/// levels and layers, because the plan carries each of its images to the next frame in a single state.
class AccessHistory {
 public:
  AccessHistory(const GraphDesc& graph, const Plan& plan);

  [[nodiscard]] std::uint32_t subresourceCount(std::uint32_t resource) const {
    return first_[resource + 1] - first_[resource];
  }
  [[nodiscard]] std::span<const AccessGroup> groups(std::uint32_t resource, std::uint32_t subresource) const {
    return groups_[first_[resource] + subresource];
  }
  /// Batch of the last write to some subresource that no later pass reads; kNone if there is none.
  [[nodiscard]] std::uint32_t lastUnreadWrite(std::uint32_t resource) const;
  /// Mip level and layer of a subresource; the whole resource if it has only one.
  [[nodiscard]] SubresourceRange range(std::uint32_t resource, std::uint32_t subresource) const;

 private:
  void add(std::uint32_t batch, const AccessDecl& access);

  const GraphDesc* graph_;
  std::vector<std::uint32_t> first_;
  std::vector<std::vector<AccessGroup>> groups_;
};

/// Synchronization state of a subresource: what the next barrier depends on.
struct SubresourceState {
  VkPipelineStageFlags2 stage = VK_PIPELINE_STAGE_2_NONE;         ///< Stages of the last write, or of the reads since.
  VkAccessFlags2 pendingWrite = VK_ACCESS_2_NONE;                 ///< Writes not yet made available.
  VkPipelineStageFlags2 visibleStage = VK_PIPELINE_STAGE_2_NONE;  ///< Stages that can read without a barrier,
  VkAccessFlags2 visibleAccess = VK_ACCESS_2_NONE;                ///< and the accesses with which they can.
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
};

/// The state of a resource as the host leaves it.
SubresourceState externalState(const ExternalState& state);

/// Advance to the next group: returns the barrier that it needs, if any, and updates the state.
std::optional<PlannedBarrier> advance(SubresourceState& state, const AccessGroup& next);

}  // namespace fg
