#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "framegraph/compile/heap_packing.h"
#include "framegraph/plan/plan.h"

namespace fg {

/// The images of some histories and when in a frame they hold nothing: `current` until it is first written, `previous`
/// once it has been read for the last time. They lie in two heaps that swap roles every frame, `incoming`, with every
/// history's `current`, and `outgoing`, with every `previous` at the same offset.
class HistoryHeaps {
 public:
  struct Member {
    std::uint32_t history = kNone;  ///< Index into `GraphDesc::histories`.
    std::uint64_t size = 0;         ///< Of one image.
    std::uint64_t alignment = 1;
    std::uint32_t written = 0;   ///< First position that uses `current`.
    std::uint32_t lastRead = 0;  ///< Last position that uses `previous`.
  };

  /// Lay histories out in the order of their last reads, so that those read by a position leave one gap.
  /// @param members in an order that is a function of the description alone
  /// @param positions number of passes
  HistoryHeaps(std::vector<Member> members, std::uint32_t positions);

  [[nodiscard]] std::span<const Member> members() const { return members_; }
  /// By member.
  [[nodiscard]] std::uint64_t offset(std::size_t member) const { return offsets_[member]; }
  /// Of each of the two heaps.
  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// Bytes that a transient cannot have: those of histories that hold something during its lifetime, and what lies
  /// beyond the end of each heap.
  /// @param stride address of `outgoing` in one address space in which `incoming` begins at 0; at least `size()`. The
  ///               space ends at twice the stride
  [[nodiscard]] std::vector<ByteSpan> taken(const HeapRequest& transient, std::uint64_t stride) const;

  /// By position, a lower bound of the bytes of transients that the two heaps cannot hold in any arrangement.
  /// @param requests from first to last use
  /// @param heldUntil by request, the last position at which others may not have its bytes
  [[nodiscard]] std::vector<std::uint64_t> excess(const std::vector<HeapRequest>& requests,
                                                  const std::vector<std::uint32_t>& heldUntil) const;

 private:
  std::vector<Member> members_;
  std::vector<std::uint64_t> offsets_;
  std::uint64_t size_ = 0;
  // By position, bytes of a heap that hold nothing.
  std::vector<std::uint64_t> freeIncoming_;
  std::vector<std::uint64_t> freeOutgoing_;
};

}  // namespace fg
