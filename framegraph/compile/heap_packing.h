#pragma once

#include <compare>
#include <cstdint>
#include <vector>

namespace fg {

/// A block of memory wanted for an interval of positions.
struct HeapRequest {
  std::uint64_t size = 0;
  std::uint64_t alignment = 1;
  std::uint32_t firstUse = 0;
  std::uint32_t lastUse = 0;  ///< Inclusive.
};

/// Bytes of a heap. An empty span is a border that no block crosses.
struct ByteSpan {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;  ///< Exclusive.
  friend auto operator<=>(const ByteSpan&, const ByteSpan&) = default;
};

struct HeapPacking {
  std::vector<std::uint64_t> offsets;  ///< By request.
  std::uint64_t size = 0;              ///< Largest end of any block.
};

/// By position, the bytes wanted there.
std::vector<std::uint64_t> liveBytes(const std::vector<HeapRequest>& requests);

/// Most bytes wanted at any one position: no packing can be smaller.
std::uint64_t lowerBound(const std::vector<HeapRequest>& requests);

/// Place all requests so that no two whose intervals meet overlap.
///
/// Offline dynamic storage allocation, which is NP-hard. Each block goes to the lowest gap that holds it, for several
/// orders of blocks (by size, by size times duration, by duration, by crowding, by time); the best of them is then
/// improved by taking the blocks that end highest first. Stops as soon as the target is met. Deterministic; cost is
/// bounded by a fixed number of placements.
/// @param taken by request, bytes that it cannot have; ordered
/// @param target a size that needs no improvement
HeapPacking pack(const std::vector<HeapRequest>& requests, const std::vector<std::vector<ByteSpan>>& taken,
                 std::uint64_t target);
/// Where all bytes are free.
HeapPacking pack(const std::vector<HeapRequest>& requests);

}  // namespace fg
