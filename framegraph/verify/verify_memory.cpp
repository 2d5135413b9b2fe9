#include "framegraph/verify/verify_memory.h"

#include <algorithm>
#include <iterator>

namespace fg::check {

std::uint32_t SharedMemory::add(const Block& block) {
  Intervals& intervals = allocations_[block.allocation];
  intervals.try_emplace(0);
  blocks_.push_back({block, std::vector<std::uint32_t>(block.cellCount)});
  return static_cast<std::uint32_t>(blocks_.size() - 1);
}

std::vector<std::uint32_t> SharedMemory::others(std::uint32_t block) const {
  const Block& own = blocks_[block].block;
  const Intervals& intervals = allocations_.at(own.allocation);
  std::vector<std::uint32_t> result;
  for (auto i = std::prev(intervals.upper_bound(own.begin)); i != intervals.end() && i->first < own.end; ++i) {
    for (const Occupant& occupant : i->second) {
      if (occupant.block != block) result.push_back(occupant.block);
    }
  }
  std::ranges::sort(result);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

void SharedMemory::change(std::uint32_t block, std::uint32_t cell, std::uint64_t time) {
  Rounds& own = blocks_[block];
  if (own.count == 0) own.began = time;
  std::uint32_t& changed = own.changed[cell - own.block.firstCell];
  if (changed != own.round) ++own.count;
  changed = own.round;
  const bool all = own.count == own.block.cellCount;
  if (all) {
    ++own.round;
    own.count = 0;
  }

  Intervals& intervals = allocations_.at(own.block.allocation);
  split(intervals, own.block.begin);
  split(intervals, own.block.end);
  const auto begin = intervals.find(own.block.begin);
  const auto end = intervals.find(own.block.end);
  bool alone = true;
  for (auto i = begin; i != end; ++i) {
    std::vector<Occupant>& occupants = i->second;
    std::erase_if(occupants,
                  [&](const Occupant& other) { return other.block == block || (all && other.time < own.began); });
    alone = alone && occupants.empty();
    occupants.push_back({block, time});
  }
  if (alone) intervals.erase(std::next(begin), end);
}

void SharedMemory::split(Intervals& intervals, std::uint64_t at) {
  const auto interval = std::prev(intervals.upper_bound(at));
  if (interval->first == at) return;
  intervals.emplace_hint(std::next(interval), at, interval->second);
}

}  // namespace fg::check
