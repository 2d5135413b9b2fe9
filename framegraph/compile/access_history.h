#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "framegraph/plan/plan.h"

namespace fg {

/// Consecutive accesses to one subresource that need no barrier among themselves: one write, or any number of reads in
/// one layout. A single barrier before the first of them serves them all.
struct AccessGroup {
  std::uint32_t position = 0;  ///< Of the first of them in `Plan::passes`.
  VkPipelineStageFlags2 stage = VK_PIPELINE_STAGE_2_NONE;
  VkAccessFlags2 readMask = VK_ACCESS_2_NONE;
  VkAccessFlags2 writeMask = VK_ACCESS_2_NONE;
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
};

/// The groups of every subresource in execution order.
///
/// A subresource here is one mip level of one array layer; a buffer has one, and a history counts as one however many
/// it has, because both of its images must be handed from frame to frame in one state.
class AccessHistory {
 public:
  AccessHistory(const GraphDesc& graph, const Plan& plan);

  [[nodiscard]] std::uint32_t subresourceCount(std::uint32_t resource) const {
    return first_[resource + 1] - first_[resource];
  }
  [[nodiscard]] std::span<const AccessGroup> groups(std::uint32_t resource, std::uint32_t subresource) const {
    return groups_[first_[resource] + subresource];
  }
  /// Position of the last pass that leaves some subresource written and not read again; kNone where there is none.
  [[nodiscard]] std::uint32_t lastUnreadWrite(std::uint32_t resource) const;
  /// The part of the resource that a subresource stands for.
  [[nodiscard]] SubresourceRange range(std::uint32_t resource, std::uint32_t subresource) const;

 private:
  void add(std::uint32_t position, const AccessDecl& access);

  const GraphDesc* graph_;
  std::vector<std::uint32_t> first_;
  std::vector<std::vector<AccessGroup>> groups_;
};

/// What a barrier must know of a subresource's past.
struct SubresourceState {
  VkPipelineStageFlags2 stage = VK_PIPELINE_STAGE_2_NONE;  ///< To be waited for: the last writer's, or its readers'.
  VkAccessFlags2 pendingWrite = VK_ACCESS_2_NONE;          ///< Writes not yet made available.
  VkPipelineStageFlags2 visibleStage = VK_PIPELINE_STAGE_2_NONE;  ///< Where the contents can be read as they are
  VkAccessFlags2 visibleAccess = VK_ACCESS_2_NONE;                ///< and how.
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
};

/// The state at the border with the host.
SubresourceState externalState(const ExternalState& state);

/// Go on to the next group: the barrier that it needs, if any, and the state that it leaves.
std::optional<PlannedBarrier> advance(SubresourceState& state, const AccessGroup& next);

}  // namespace fg
