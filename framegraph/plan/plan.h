#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "framegraph/declare/graph.h"

/// The result of compiling a graph: a plain value. Recording a frame is interpreting it.
///
/// Every frame is recorded by replaying the same plan on one queue, so that frames are executed in the order in which
/// they are submitted, and share the heaps even while several are in flight:
/// - A transient's first use waits for whoever owned its bytes last, be it in the frame before, and starts from
///   UNDEFINED. For another owner this is an execution dependency only: writes have been made available to readers, or
///   by a barrier of their own (`BarrierReason::Retire`) in an earlier batch.
/// - A history has two images that swap roles every frame (`PlannedHistory`). An image holds nothing between the last
///   read of it as `previous` and the next write to it as `current`. Transients may alias its bytes meanwhile. To this
///   end histories lie in two heaps that swap roles every frame, too (`PlannedHeap::partner`). A transient in such a
///   heap is therefore made twice, at the same offset of both allocations, and every frame uses the other one.
/// - Upload buffers have one copy per frame in flight and need no barrier: submission makes host writes visible.
/// - Imports arrive in the state that was declared (stage NONE: the host has waited otherwise, for instance by a
///   semaphore). Exports are released into theirs. Imports that are not exported are given back in the state in which
///   they came. Exported resources never share memory.
///
/// Indices refer to `GraphDesc`. Everything that has an order of its own is ordered by name, so that the same
/// description gives the same plan, but for these indices, however its parts are registered: compare plans of differing
/// registration by `toText` or `toJson` (inspect.h), which write names.
namespace fg {

/// Why a barrier is in the plan.
enum class BarrierReason : std::uint8_t {
  ReadAfterWrite,
  WriteAfterWrite,
  WriteAfterRead,  ///< Execution only, unless the layout changes.
  LayoutChange,    ///< Between two reads.
  FirstUse,        ///< Contents are not needed: from UNDEFINED.
  Retire,          ///< Makes a last write that nobody reads available, before the memory has another owner.
  AliasHandOver,   ///< The memory had another owner before (`aliasOf`), in this frame or the last.
  HistoryCarry,    ///< From last frame's use of the same history slot, where no transient had its memory in between.
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
  std::uint32_t heap = kNone;  ///< Index into `Plan::heaps`; transients, and histories that transients may alias.
  std::uint64_t offset = 0;    ///< Bytes from the start of the heap.
  std::uint64_t size = 0;      ///< Bytes that the driver asks for.
  std::uint64_t alignment = 1;
  std::uint32_t memoryTypeBits = ~0U;  ///< Memory types that the driver allows.
  friend bool operator==(const PlannedResource&, const PlannedResource&) = default;
};

/// One allocation that resources share.
struct PlannedHeap {
  std::uint32_t memoryTypeBits = ~0u;
  std::uint64_t size = 0;
  /// Histories: the heap with which this one changes places every frame, that is, whose allocation stands for it in
  /// every other frame; kNone for heaps of transients alone. The `current` of a history lies in the one and `previous`
  /// at the same offset of the other.
  std::uint32_t partner = kNone;
  friend bool operator==(const PlannedHeap&, const PlannedHeap&) = default;
};

/// The allocation that stands for a heap in frames of one parity, as the index of the heap for which it stands in even
/// ones.
inline std::uint32_t allocationOf(const std::vector<PlannedHeap>& heaps, std::uint32_t heap, std::uint32_t parity) {
  return parity % 2 == 0 || heaps[heap].partner == kNone ? heap : heaps[heap].partner;
}

/// A pass that is not executed.
struct CulledPass {
  std::uint32_t pass = kNone;
  std::string reason;
  friend bool operator==(const CulledPass&, const CulledPass&) = default;
};

/// What the executor keeps for one history: two images, of which frame by frame one is `current` and the other
/// `previous`. Same index as `GraphDesc::histories`.
struct PlannedHistory {
  bool used = false;  ///< False when nobody reads `previous` or needs `current`; there are no images then.
  /// State in which a frame leaves `current`: the last stages that touched it, the writes not yet made available
  /// (often none), the layout. The plan's HistoryCarry barrier for `previous` starts from it. Who clears `previous`
  /// instead, because no valid frame lies behind, waits for this stage and access, discards the contents, and leaves
  /// the image in this layout with the clear made available to this stage.
  ExternalState carry;
  friend bool operator==(const PlannedHistory&, const PlannedHistory&) = default;
};

struct MemoryReport {
  std::uint64_t persistentBytes = 0;          ///< Both slots of every history, and exported transients.
  std::uint64_t transientUnaliasedBytes = 0;  ///< Sum over all transients.
  std::uint64_t transientPeakBytes = 0;       ///< Sum of the heaps of transients alone.
  /// Most bytes that are alive at any one pass and for which the memory of histories has no room.
  std::uint64_t transientLowerBoundBytes = 0;
  friend bool operator==(const MemoryReport&, const MemoryReport&) = default;
};

/// Declared traffic: every texel or byte of every accessed resource counted once per pass and direction.
struct TrafficReport {
  std::uint64_t bytesRead = 0;
  std::uint64_t bytesWritten = 0;
  std::uint64_t pixels = 0;  ///< Of the largest exported texture: what traffic is divided by.
  /// 0 where no texture is exported.
  [[nodiscard]] double bytesPerPixel() const {
    return pixels == 0 ? 0.0 : static_cast<double>(bytesRead + bytesWritten) / static_cast<double>(pixels);
  }
  friend bool operator==(const TrafficReport&, const TrafficReport&) = default;
};

struct Plan {
  std::vector<PlannedPass> passes;       ///< In execution order.
  std::vector<PlannedBarrier> releases;  ///< After the last pass.
  std::vector<PlannedResource> resources;
  std::vector<PlannedHeap> heaps;
  std::vector<PlannedHistory> histories;
  std::vector<CulledPass> culled;  ///< By name.
  MemoryReport memory;
  TrafficReport traffic;
  friend bool operator==(const Plan&, const Plan&) = default;
};

}  // namespace fg
