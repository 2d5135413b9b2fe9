#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <vulkan/vulkan_core.h>

namespace fg::check {

/// An access to a cell, or a layout transition of it, that later work may have to wait for.
struct Operation {
  VkPipelineStageFlags2 stage =
      VK_PIPELINE_STAGE_2_NONE;  ///< Stages in which it happens; none for a layout transition.
  VkPipelineStageFlags2 ordered = VK_PIPELINE_STAGE_2_NONE;  ///< Stages of later commands that happen after it.
};

/// The execution dependency of a barrier.
struct ExecutionDependency {
  VkPipelineStageFlags2 srcStage = VK_PIPELINE_STAGE_2_NONE;
  VkPipelineStageFlags2 dstStage = VK_PIPELINE_STAGE_2_NONE;
  friend auto operator<=>(const ExecutionDependency&, const ExecutionDependency&) = default;
};

/// True if the operation is in the first synchronization scope of a dependency with these source stages.
bool waitsFor(VkPipelineStageFlags2 srcStage, const Operation& operation);

/// True if the work of later commands in these stages happens after the operation.
bool happensAfter(VkPipelineStageFlags2 stage, const Operation& operation);

/// Operations and what has been ordered after them. A barrier orders all operations before it. Operations with the same
/// stages and the same work after them stay alike from then on, so that they are one state: a barrier costs as much as
/// there are states, not operations.
class OperationOrder {
 public:
  /// Refers to an operation; stays valid.
  using Handle = std::uint32_t;

  Handle add(const Operation& operation);
  [[nodiscard]] const Operation& operator[](Handle handle) const { return states_[find(handle)]; }
  /// Execute the dependencies of one barrier command. They do not order each other.
  void barrier(std::vector<ExecutionDependency> batch);

 private:
  using Key = std::pair<VkPipelineStageFlags2, VkPipelineStageFlags2>;
  [[nodiscard]] Handle find(Handle handle) const;

  std::vector<Operation> states_;        ///< Valid for handles that are their own parents.
  mutable std::vector<Handle> parents_;  ///< The state into which a state was merged; itself if into none.
  std::map<Key, Handle> distinct_;       ///< The states that differ, by stages and by the work after them.
};

}  // namespace fg::check
