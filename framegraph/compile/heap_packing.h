#pragma once

#include <compare>
#include <cstdint>
#include <vector>

namespace fg {

/// A block of memory that is needed during an interval of positions, the numbers of batches.
struct HeapRequest {
  std::uint64_t size = 0;
  std::uint64_t alignment = 1;
  std::uint32_t firstUse = 0;
  std::uint32_t lastUse = 0;  ///< Inclusive.
};

/// A range of bytes in a heap. An empty span marks a border that no block may cross.
struct ByteSpan {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;  ///< Exclusive.
  friend auto operator<=>(const ByteSpan&, const ByteSpan&) = default;
};

struct HeapPacking {
  std::vector<std::uint64_t> offsets;  ///< Indexed by request.
  std::uint64_t size = 0;              ///< Largest end of any block.
};

/// Indexed by position: the sum of the bytes that are needed there.
std::vector<std::uint64_t> liveBytes(const std::vector<HeapRequest>& requests);

/// Largest sum of bytes needed at one position: no packing can be smaller.
std::uint64_t lowerBound(const std::vector<HeapRequest>& requests);

/// Place all requests so that blocks overlap in memory only if their intervals do not overlap in time.
///
/// This is offline dynamic storage allocation, which is NP-hard. Each block goes into the lowest gap that is large
/// enough, for several orders of blocks: by size, by size times duration, by duration, by the bytes alive beside it,
/// and by first use. The best of these orders is then improved: the block with the highest end is placed earlier. The
/// search stops as soon as the target is met. It is deterministic, and its cost is bounded.
/// @param taken indexed by request: bytes that it cannot have, in ascending order
/// @param target the search stops at this size
HeapPacking pack(const std::vector<HeapRequest>& requests, const std::vector<std::vector<ByteSpan>>& taken,
                 std::uint64_t target);
/// As above, with all bytes free and the lower bound as target.
HeapPacking pack(const std::vector<HeapRequest>& requests);

}  // namespace fg
