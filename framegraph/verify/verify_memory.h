#pragma once

#include <cstdint>
#include <map>
#include <vector>

namespace fg::check {

/// Bytes of an allocation in which a physical image or buffer lies, and its cells.
struct Block {
  std::uint32_t allocation = 0;
  std::uint64_t begin = 0;  ///< Bytes from the start of the allocation.
  std::uint64_t end = 0;    ///< One past the last byte.
  std::uint32_t firstCell = 0;
  std::uint32_t cellCount = 1;
};

/// The blocks that have changed each byte of the allocations. Once all cells of a block have changed after the other
/// blocks in its bytes, the others are forgotten: each change was checked to come after them, so that whatever comes
/// after it comes after them, too.
class SharedMemory {
 public:
  /// @return the index of the block
  std::uint32_t add(const Block& block);
  [[nodiscard]] const Block& block(std::uint32_t index) const { return blocks_[index].block; }
  /// The other blocks that have changed some of a block's bytes, each once.
  [[nodiscard]] std::vector<std::uint32_t> others(std::uint32_t block) const;
  /// Record that a cell of a block has changed.
  /// @param time equal for changes that are not ordered, and never less than before
  void change(std::uint32_t block, std::uint32_t cell, std::uint64_t time);

 private:
  /// A block that has changed some bytes, and the last time at which it did.
  struct Occupant {
    std::uint32_t block;
    std::uint64_t time;
  };
  /// The occupants of every interval of bytes, by its first byte. It ends where the next one begins.
  using Intervals = std::map<std::uint64_t, std::vector<Occupant>>;

  /// A block, and which of its cells have changed since the round began.
  struct Rounds {
    Block block;
    std::vector<std::uint32_t> changed;  ///< The round in which each cell changed last.
    std::uint32_t round = 1;
    std::uint32_t count = 0;  ///< Cells that have changed in this round.
    std::uint64_t began = 0;  ///< Time of the round's first change.
  };

  static void split(Intervals& intervals, std::uint64_t at);

  std::vector<Rounds> blocks_;
  std::map<std::uint32_t, Intervals> allocations_;
};

}  // namespace fg::check
