#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "samples/estimate/wave_counts.h"

/// What a wave executes of a shader, counted in the listing that AMD's compiler ACO prints of it.
namespace walr::costs {

/// One instruction of a listing.
struct Instruction {
  std::string name;
  std::string operands;
};

/// Instructions that run one after the other, with a label in front of them.
struct BasicBlock {
  std::size_t label = 0;  ///< "BB7" is 7. Labels ascend; not every number occurs.
  std::vector<Instruction> instructions;
};

/// A loop: consecutive blocks of which one jumps back to the first.
struct Loop {
  std::size_t first = 0;  ///< Index of the block.
  std::size_t last = 0;   ///< Inclusive.
};

/// The machine code of one shader.
class Listing {
 public:
  /// @param assembly the internal representation "Assembly" of RADV
  /// @throws std::runtime_error naming a jump to a label that there is not
  explicit Listing(std::string_view assembly);

  [[nodiscard]] std::span<const BasicBlock> blocks() const { return blocks_; }
  /// In the order of their first blocks: an outer loop comes before those inside it.
  [[nodiscard]] std::span<const Loop> loops() const { return loops_; }
  /// Index of the block that an instruction jumps to; nothing where it does not jump.
  [[nodiscard]] std::optional<std::size_t> target(const Instruction& instruction) const;

 private:
  std::vector<BasicBlock> blocks_;
  std::vector<Loop> loops_;
};

/// What no compiler knows of a shader's loops.
struct LoopCounts {
  std::vector<double> rounds;  ///< Of each loop.
  /// Share of a loop's rounds in which a wave does not jump over a side of a divergent branch inside the loop.
  double divergent = 1.0;
};

/// How often a wave runs each block of a listing, on average.
///
/// The wave shows a surface in all its threads. A divergent branch runs both sides, because some threads of the wave
/// take each of them; inside loops it does so in a share of the rounds. A uniform branch with two sides runs each half
/// of the time, so that a tree of branches in place of an array's index counts as much as its depth. A uniform branch
/// with one side runs it. Loops end when their rounds are over, and never before.
/// @param loops one entry of `rounds` per loop, indexed like `Listing::loops`
/// @throws std::invalid_argument if there is another number of them
std::vector<double> blockFrequencies(const Listing& listing, const LoopCounts& loops);

/// What one wave executes.
/// @param frequencies of the blocks
WaveCounts countWave(const Listing& listing, std::span<const double> frequencies);

/// Fetches in the listing, each counted once.
std::size_t fetchInstructions(const Listing& listing);

/// Jumps in the listing.
std::size_t branchInstructions(const Listing& listing);

}  // namespace walr::costs
