#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "framegraph/compile/heap_packing.h"
#include "framegraph/plan/plan.h"

namespace fg {

/// The two heaps of some histories, and the positions (numbers of batches) in a frame at which each image holds
/// nothing: `current` before it is first written, `previous` after it is last read. The heap `incoming` holds every
/// history's `current`, and the heap `outgoing` holds every `previous` at the same offset. The heaps swap roles every
/// frame.
class HistoryHeaps {
 public:
  struct Member {
    std::uint32_t history = kNone;  ///< Index into `GraphDesc::histories`.
    std::uint64_t size = 0;         ///< Size of one image.
    std::uint64_t alignment = 1;
    std::uint32_t written = 0;   ///< First position that uses `current`.
    std::uint32_t lastRead = 0;  ///< Last position that uses `previous`.
  };

  /// Lay histories out in the order of their last reads, so that the bytes which are free at a position form one gap.
  /// @param members in an order that does not depend on registration
  /// @param positions number of batches
  HistoryHeaps(std::vector<Member> members, std::uint32_t positions);

  [[nodiscard]] std::span<const Member> members() const { return members_; }
  /// Offset of a member in each of the two heaps.
  [[nodiscard]] std::uint64_t offset(std::size_t member) const { return offsets_[member]; }
  /// Size of each of the two heaps.
  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// Bytes that a transient cannot have: those of histories that hold something during its lifetime, and those past
  /// the end of each heap. Both heaps are in one address space: `incoming` starts at 0 and `outgoing` at `stride`.
  /// @param stride at least `size()`
  [[nodiscard]] std::vector<ByteSpan> taken(const HeapRequest& transient, std::uint64_t stride) const;

  /// Indexed by position: a lower bound of the bytes of transients that do not fit into the two heaps.
  /// @param requests transients, from first to last use
  /// @param heldUntil indexed by request: the last position at which it holds its bytes (see alias.h)
  [[nodiscard]] std::vector<std::uint64_t> excess(const std::vector<HeapRequest>& requests,
                                                  const std::vector<std::uint32_t>& heldUntil) const;

 private:
  std::vector<Member> members_;
  std::vector<std::uint64_t> offsets_;
  std::uint64_t size_ = 0;
  // Indexed by position: bytes of the heap that hold nothing.
  std::vector<std::uint64_t> freeIncoming_;
  std::vector<std::uint64_t> freeOutgoing_;
};

}  // namespace fg
