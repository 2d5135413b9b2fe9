#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "framegraph/graph.h"

/// The result of compiling a graph: a plain value. Recording a frame is interpreting it.
namespace fg {

/// Why a barrier is in the plan.
enum class BarrierReason : std::uint8_t {
  ReadAfterWrite,
  WriteAfterWrite,
  WriteAfterRead,  ///< Execution only, unless the layout changes.
  LayoutChange,    ///< Between two reads.
  FirstUse,        ///< Contents are not needed: from UNDEFINED.
  AliasHandOver,   ///< The memory had another owner before (`aliasOf`), in this frame or the last.
  HistoryCarry,    ///< From last frame's use of the same history slot.
  Acquire,         ///< From the state in which the host hands an import over.
  Release,         ///< Into the state in which the host takes an export back.
};

/// One memory dependency at VkImageMemoryBarrier2 / VkBufferMemoryBarrier2 level.
struct PlannedBarrier {
  std::uint32_t resource = kNone;  ///< Index into `Plan::resources`.
  BarrierReason reason = BarrierReason::ReadAfterWrite;
  VkPipelineStageFlags2 srcStage = VK_PIPELINE_STAGE_2_NONE;
  VkAccessFlags2 srcAccess = VK_ACCESS_2_NONE;
  VkPipelineStageFlags2 dstStage = VK_PIPELINE_STAGE_2_NONE;
  VkAccessFlags2 dstAccess = VK_ACCESS_2_NONE;
  VkImageLayout oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;  ///< Textures only.
  VkImageLayout newLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  SubresourceRange range;
  std::uint32_t aliasOf = kNone;  ///< AliasHandOver: the resource that owned the memory before.
  friend bool operator==(const PlannedBarrier&, const PlannedBarrier&) = default;
};

/// One pass in execution order with the single batch of barriers recorded before it.
struct PlannedPass {
  std::uint32_t pass = kNone;  ///< Index into `GraphDesc::passes`.
  std::vector<PlannedBarrier> barriers;
  friend bool operator==(const PlannedPass&, const PlannedPass&) = default;
};

/// One resource with everything that is needed to make it. Same index as `GraphDesc::resources`.
struct PlannedResource {
  bool used = false;                 ///< False when every pass that touches it was culled.
  VkImageUsageFlags imageUsage = 0;  ///< Union over all accesses; textures only.
  VkBufferUsageFlags bufferUsage = 0;
  std::uint32_t firstUse = kNone;  ///< Position in `Plan::passes`.
  std::uint32_t lastUse = kNone;
  std::uint32_t heap = kNone;  ///< Index into `Plan::heaps`; transients only.
  std::uint64_t offset = 0;    ///< Bytes from the start of the heap.
  std::uint64_t size = 0;      ///< Bytes that the driver asks for.
  std::uint64_t alignment = 1;
  friend bool operator==(const PlannedResource&, const PlannedResource&) = default;
};

/// One allocation that transients share.
struct PlannedHeap {
  std::uint32_t memoryTypeBits = ~0u;
  std::uint64_t size = 0;
  friend bool operator==(const PlannedHeap&, const PlannedHeap&) = default;
};

/// A pass that is not executed.
struct CulledPass {
  std::uint32_t pass = kNone;
  std::string reason;
  friend bool operator==(const CulledPass&, const CulledPass&) = default;
};

struct MemoryReport {
  std::uint64_t persistentBytes = 0;           ///< Both slots of every history.
  std::uint64_t transientUnaliasedBytes = 0;   ///< Sum over all transients.
  std::uint64_t transientPeakBytes = 0;        ///< Sum of the heaps.
  std::uint64_t transientLowerBoundBytes = 0;  ///< Most bytes alive at any one pass.
  friend bool operator==(const MemoryReport&, const MemoryReport&) = default;
};

/// Declared traffic: every texel or byte of every accessed resource counted once per pass and direction.
struct TrafficReport {
  std::uint64_t bytesRead = 0;
  std::uint64_t bytesWritten = 0;
  friend bool operator==(const TrafficReport&, const TrafficReport&) = default;
};

struct Plan {
  std::vector<PlannedPass> passes;       ///< In execution order.
  std::vector<PlannedBarrier> releases;  ///< After the last pass.
  std::vector<PlannedResource> resources;
  std::vector<PlannedHeap> heaps;
  std::vector<CulledPass> culled;
  MemoryReport memory;
  TrafficReport traffic;
  friend bool operator==(const Plan&, const Plan&) = default;
};

}  // namespace fg
