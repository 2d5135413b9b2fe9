#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "framegraph/declare/graph.h"

/// The result of compiling a graph. A plan is a plain value; the executor records a frame by walking through it.
///
/// Passes form batches, which are executed one after the other. The passes of one batch need nothing from each other:
/// the GPU may execute them side by side. All barriers of a batch are recorded together before its first pass.
///
/// Every frame replays the same plan on one queue. Frames are executed in the order in which they are submitted, and
/// share the heaps even while several are in flight:
/// - A transient's first use waits for the last owner of its bytes, which may be in the previous frame, and starts from
///   UNDEFINED. If the owner is another resource, an execution dependency is enough: the owner's writes are available
///   already, because of a barrier before a read of them or a barrier of their own (`BarrierReason::Retire`) in an
///   earlier batch.
/// - A history has two images that swap roles every frame (`PlannedHistory`). An image holds nothing between the last
///   read of it as `previous` and the next write to it as `current`. Transients may alias its bytes meanwhile. For this
///   reason histories lie in two heaps that also swap roles every frame (`PlannedHeap::partner`). A transient in such a
///   heap exists twice, at the same offset of both allocations. Even frames use one copy and odd frames the other.
/// - Upload buffers have one copy per frame in flight and need no barrier: submission makes host writes visible.
/// - Imports arrive in their declared state. Stage NONE means that the host has waited by other means: for a fence, or
///   for a semaphore in an earlier submission. A host that waits in the same submission names the stage that waits.
///   Exports are released into their declared state. Imports that are not exported are returned in the state in which
///   they arrived, except that a layout of UNDEFINED does not return. Exported resources never share memory.
///
/// Indices refer to `GraphDesc`. Lists that have no order of their own are ordered by name. Hence two graphs that
/// differ only in the order of registration have the same plan except for these indices. `toText` and `toJson`
/// (inspect.h) write names in place of indices: compare such plans through them.
namespace fg {

/// Why a barrier is in the plan.
enum class BarrierReason : std::uint8_t {
  ReadAfterWrite,
  WriteAfterWrite,
  WriteAfterRead,  ///< Only an execution dependency, unless the layout changes.
  LayoutChange,    ///< Between two reads.
  FirstUse,        ///< The contents may be discarded: from UNDEFINED.
  Retire,          ///< Makes a write that no pass reads available, before the memory gets another owner.
  AliasHandOver,   ///< Waits for the previous owner of the memory (`aliasOf`), in this frame or the last.
  HistoryCarry,    ///< From last frame's use of the same image, if no transient has used its memory since.
  Acquire,         ///< From the state in which an import arrives.
  Release,         ///< Into the state in which the host gets a resource back.
};

/// One VkImageMemoryBarrier2 or VkBufferMemoryBarrier2.
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

/// One pass in execution order.
struct PlannedPass {
  std::uint32_t pass = kNone;  ///< Index into `GraphDesc::passes`.
  std::uint32_t batch = 0;     ///< Number of its batch: 0 for the first pass, the same or one more for the next.
  std::vector<PlannedBarrier> barriers;  ///< Recorded before the pass: those of its batch if it is the first in it.
  friend bool operator==(const PlannedPass&, const PlannedPass&) = default;
};

/// One resource and all that is needed to create it. Indexed like `GraphDesc::resources`.
struct PlannedResource {
  bool used = false;                 ///< False if every pass that uses it is culled.
  VkImageUsageFlags imageUsage = 0;  ///< Union over all accesses; textures only.
  VkBufferUsageFlags bufferUsage = 0;
  std::uint32_t firstUse = kNone;  ///< Position in `Plan::passes`.
  std::uint32_t lastUse = kNone;
  std::uint32_t heap = kNone;  ///< Index into `Plan::heaps`, for transients and for histories that they may alias.
  std::uint64_t offset = 0;    ///< Bytes from the start of the heap.
  std::uint64_t size = 0;      ///< Bytes that the driver requires.
  std::uint64_t alignment = 1;
  std::uint32_t memoryTypeBits = ~0U;  ///< Memory types that the driver allows.
  friend bool operator==(const PlannedResource&, const PlannedResource&) = default;
};

/// One allocation that resources share.
struct PlannedHeap {
  std::uint32_t memoryTypeBits = ~0u;
  std::uint64_t size = 0;
  /// For heaps with histories, the heap with which this one exchanges allocations every frame; kNone for heaps that
  /// hold only transients. The `current` of a history lies in one of the two and `previous` at the same offset of the
  /// other.
  std::uint32_t partner = kNone;
  friend bool operator==(const PlannedHeap&, const PlannedHeap&) = default;
};

/// The allocation that a heap uses in frames of one parity. Allocations are numbered by the heaps that use them in even
/// frames.
inline std::uint32_t allocationOf(const std::vector<PlannedHeap>& heaps, std::uint32_t heap, std::uint32_t parity) {
  return parity % 2 == 0 || heaps[heap].partner == kNone ? heap : heaps[heap].partner;
}

/// A pass that is not executed.
struct CulledPass {
  std::uint32_t pass = kNone;
  std::string reason;
  friend bool operator==(const CulledPass&, const CulledPass&) = default;
};

/// One history: two images, of which one is `current` and the other `previous`, in turn from frame to frame. Indexed
/// like `GraphDesc::histories`.
struct PlannedHistory {
  bool used = false;  ///< False if nothing reads `previous` or needs `current`. Then there are no images.
  /// State in which a frame leaves `current`: the last stages that used it, the writes that are not yet available
  /// (often none), and the layout. The plan's HistoryCarry barrier for `previous` starts from this state. If there is
  /// no valid previous frame, the executor clears `previous` instead: it waits for this stage and access, discards the
  /// contents, and leaves the image in this layout with the clear made available to this stage.
  ExternalState carry;
  friend bool operator==(const PlannedHistory&, const PlannedHistory&) = default;
};

struct MemoryReport {
  std::uint64_t persistentBytes = 0;          ///< Both images of every history, and exported transients.
  std::uint64_t transientUnaliasedBytes = 0;  ///< Sum over all transients.
  std::uint64_t transientPeakBytes = 0;       ///< Sum of the heaps that hold only transients.
  /// Lower bound of `transientPeakBytes`: most bytes alive in one batch that do not fit into the memory of histories.
  std::uint64_t transientLowerBoundBytes = 0;
  friend bool operator==(const MemoryReport&, const MemoryReport&) = default;
};

/// Declared memory traffic. Every texel or byte of an accessed resource counts once per pass and direction.
struct TrafficReport {
  std::uint64_t bytesRead = 0;
  std::uint64_t bytesWritten = 0;
  std::uint64_t pixels = 0;  ///< Pixels of the largest exported texture.
  /// 0 if no texture is exported.
  [[nodiscard]] double bytesPerPixel() const {
    return pixels == 0 ? 0.0 : static_cast<double>(bytesRead + bytesWritten) / static_cast<double>(pixels);
  }
  friend bool operator==(const TrafficReport&, const TrafficReport&) = default;
};

struct Plan {
  std::vector<PlannedPass> passes;       ///< In execution order.
  std::vector<PlannedBarrier> releases;  ///< Barriers after the last pass.
  std::vector<PlannedResource> resources;
  std::vector<PlannedHeap> heaps;
  std::vector<PlannedHistory> histories;
  std::vector<CulledPass> culled;  ///< Ordered by name.
  MemoryReport memory;
  TrafficReport traffic;
  friend bool operator==(const Plan&, const Plan&) = default;
};

inline std::uint32_t batchCount(const Plan& plan) {
  return plan.passes.empty() ? 0 : plan.passes.back().batch + 1;
}

}  // namespace fg
