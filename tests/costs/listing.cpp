#include "tests/costs/listing.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>

namespace walr::costs {
namespace {

using namespace std::string_view_literals;

constexpr std::array kTranscendentals = {"v_rcp"sv, "v_rsq"sv, "v_sqrt"sv, "v_exp"sv, "v_log"sv, "v_sin"sv, "v_cos"sv};
constexpr std::array kMultiplications = {"v_mul_lo_u32"sv, "v_mul_lo_i32"sv, "v_mul_hi_u32"sv,
                                         "v_mul_hi_i32"sv, "v_mad_u64"sv,    "v_mad_i64"sv};
constexpr std::array kFetches = {"image_"sv, "buffer_"sv, "global_"sv, "flat_"sv};
constexpr std::array kBranches = {"s_branch"sv, "s_cbranch"sv};

bool isOneOf(const Instruction& instruction, const auto& prefixes) {
  return std::ranges::any_of(prefixes, [&](std::string_view prefix) { return instruction.name.starts_with(prefix); });
}

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") + 1 - begin);
}

std::optional<std::size_t> labelIn(std::string_view text) {
  if (!text.starts_with("BB")) return std::nullopt;
  std::size_t label = 0;
  const auto [end, error] = std::from_chars(text.data() + 2, text.data() + text.size(), label);
  return error == std::errc{} ? std::optional(label) : std::nullopt;
}

/// A line is "BB7:" or an instruction, whose encoding follows a semicolon.
void readLine(std::string_view line, std::vector<BasicBlock>& blocks) {
  if (const auto label = labelIn(line); label && line.ends_with(':')) {
    blocks.push_back({*label, {}});
    return;
  }
  const std::string_view code = trimmed(line.substr(0, line.find(';')));
  if (blocks.empty() || code.empty() || (line.front() != '\t' && line.front() != ' ')) return;
  const std::size_t space = code.find_first_of(" \t");
  const std::string_view operands = space == std::string_view::npos ? std::string_view() : code.substr(space);
  blocks.back().instructions.push_back({std::string(code.substr(0, space)), std::string(trimmed(operands))});
}

bool endsProgram(const BasicBlock& block) {
  return !block.instructions.empty() && block.instructions.back().name == "s_endpgm";
}

/// Walks through the blocks in their order, in which no block runs before those that lead to it, but for loops.
class Frequencies {
 public:
  Frequencies(const Listing& listing, const LoopCounts& loops)
      : listing_(listing), loops_(loops), entered_(loops.rounds.size()), frequency_(listing.blocks().size() + 1) {}

  std::vector<double> operator()() {
    const std::size_t blocks = listing_.blocks().size();
    if (blocks != 0) frequency_[0] = 1.0;
    for (std::size_t block = 0; block < blocks; ++block) {
      enterLoops(block);
      leave(block);
      leaveLoops(block);
    }
    frequency_.pop_back();
    return std::move(frequency_);
  }

 private:
  void enterLoops(std::size_t block) {
    for (std::size_t i = 0; i < entered_.size(); ++i) {
      if (listing_.loops()[i].first != block) continue;
      entered_[i] = frequency_[block];
      frequency_[block] *= loops_.rounds[i];
    }
  }

  // What comes after a loop runs as often as the loop was entered, whichever jumps leave it.
  void leaveLoops(std::size_t block) {
    for (std::size_t i = 0; i < entered_.size(); ++i) {
      if (listing_.loops()[i].last == block) frequency_[block + 1] += entered_[i];
    }
  }

  [[nodiscard]] std::size_t endOfInnermostLoop(std::size_t block) const {
    std::size_t end = listing_.blocks().size();
    for (const Loop& loop : listing_.loops()) {
      if (loop.first <= block && block <= loop.last) end = std::min(end, loop.last);
    }
    return end;
  }

  void leave(std::size_t block) {
    const std::size_t end = endOfInnermostLoop(block);
    double left = frequency_[block];
    for (const Instruction& instruction : listing_.blocks()[block].instructions) {
      const auto target = listing_.target(instruction);
      if (!target) continue;
      if (instruction.name == "s_branch") {
        if (*target > block && *target <= end) frequency_[*target] += left;
        return;
      }
      // Loops are left when their rounds are over.
      if (*target <= block || *target > end) continue;
      const bool divergent = instruction.name.starts_with("s_cbranch_exec");
      const double share = divergent ? shareOfDivergentSide(end) : shareOfFirstSide(*target, end);
      frequency_[*target] += (1.0 - share) * left;
      left *= share;
    }
    if (block != end && !endsProgram(listing_.blocks()[block])) frequency_[block + 1] += left;
  }

  // Of a side that a wave jumps over where no thread takes it.
  [[nodiscard]] double shareOfDivergentSide(std::size_t end) const {
    return end == listing_.blocks().size() ? 1.0 : loops_.divergent;
  }

  // Of a uniform branch: the first side lies before `second`, and jumps over the second side if there is one.
  [[nodiscard]] double shareOfFirstSide(std::size_t second, std::size_t end) const {
    const auto& instructions = listing_.blocks()[second - 1].instructions;
    if (instructions.empty() || instructions.back().name != "s_branch") return 1.0;
    const bool leavesLoop = listing_.target(instructions.back()).value_or(0) > end;
    return leavesLoop ? 0.0 : 0.5;
  }

  const Listing& listing_;
  const LoopCounts& loops_;
  std::vector<double> entered_;
  std::vector<double> frequency_;  // One more than there are blocks: what runs off the end.
};

template <typename Predicate>
std::size_t countInstructions(const Listing& listing, Predicate predicate) {
  std::size_t count = 0;
  for (const BasicBlock& block : listing.blocks()) {
    count += static_cast<std::size_t>(std::ranges::count_if(block.instructions, predicate));
  }
  return count;
}

}  // namespace

Listing::Listing(std::string_view assembly) {
  while (!assembly.empty()) {
    const std::size_t end = std::min(assembly.find('\n'), assembly.size());
    if (end != 0) readLine(assembly.substr(0, end), blocks_);
    assembly.remove_prefix(std::min(end + 1, assembly.size()));
  }
  for (std::size_t block = 0; block < blocks_.size(); ++block) {
    for (const Instruction& instruction : blocks_[block].instructions) {
      const auto first = target(instruction);
      if (!first || *first > block) continue;
      const auto known = std::ranges::find(loops_, *first, &Loop::first);
      if (known == loops_.end()) {
        loops_.push_back({*first, block});
      } else {
        known->last = block;
      }
    }
  }
  std::ranges::sort(loops_, {}, &Loop::first);
}

std::optional<std::size_t> Listing::target(const Instruction& instruction) const {
  if (!isOneOf(instruction, kBranches)) return std::nullopt;
  const auto label = labelIn(instruction.operands);
  const auto found = label ? std::ranges::find(blocks_, *label, &BasicBlock::label) : blocks_.end();
  if (found == blocks_.end()) {
    throw std::runtime_error("the listing jumps to '" + instruction.operands + "', which it does not have");
  }
  return static_cast<std::size_t>(found - blocks_.begin());
}

std::vector<double> blockFrequencies(const Listing& listing, const LoopCounts& loops) {
  if (loops.rounds.size() != listing.loops().size()) {
    throw std::invalid_argument("the listing has " + std::to_string(listing.loops().size()) + " loops, not " +
                                std::to_string(loops.rounds.size()));
  }
  return Frequencies(listing, loops)();
}

WaveCounts countWave(const Listing& listing, std::span<const double> frequencies) {
  WaveCounts counts;
  bool underWay = false;
  for (std::size_t block = 0; block < listing.blocks().size(); ++block) {
    const double times = frequencies[block];
    for (const Instruction& instruction : listing.blocks()[block].instructions) {
      if (instruction.name.starts_with("v_")) {
        counts.vector += times;
        if (isOneOf(instruction, kMultiplications)) counts.multiplications += times;
        if (isOneOf(instruction, kTranscendentals)) counts.transcendentals += times;
      } else if (isOneOf(instruction, kFetches)) {
        counts.fetches += times;
        underWay = true;
      } else if (underWay && instruction.name == "s_waitcnt" &&
                 instruction.operands.find("vmcnt") != std::string::npos) {
        counts.waits += times;
        underWay = false;
      }
    }
  }
  return counts;
}

std::size_t fetchInstructions(const Listing& listing) {
  return countInstructions(listing, [](const Instruction& instruction) { return isOneOf(instruction, kFetches); });
}

std::size_t branchInstructions(const Listing& listing) {
  return countInstructions(listing, [](const Instruction& instruction) { return isOneOf(instruction, kBranches); });
}

}  // namespace walr::costs
