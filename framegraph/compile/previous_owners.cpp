#include "framegraph/compile/previous_owners.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <tuple>

namespace fg {
namespace {

struct Owner {
  std::uint32_t resource;
  int frame;
};

/// The current owner of every byte of one allocation.
class Ownership {
 public:
  /// Give bytes to a resource, and return the owners that had any of them before.
  std::vector<Owner> take(std::uint64_t begin, std::uint64_t end, const Owner& owner) {
    split(begin);
    split(end);
    const auto first = blocks_.lower_bound(begin);
    const auto last = blocks_.lower_bound(end);
    std::vector<Owner> owners;
    for (auto block = first; block != last; ++block) owners.push_back(block->second.owner);
    blocks_.erase(first, last);
    blocks_.emplace(begin, Block{end, owner});
    return owners;
  }

 private:
  struct Block {
    std::uint64_t end;
    Owner owner;
  };

  void split(std::uint64_t offset) {
    auto block = blocks_.upper_bound(offset);
    if (block == blocks_.begin()) return;
    block = std::prev(block);
    if (block->first == offset || block->second.end <= offset) return;
    const Block rest = block->second;
    block->second.end = offset;
    blocks_.emplace(offset, rest);
  }

  std::map<std::uint64_t, Block> blocks_;  ///< Keyed by first byte.
};

}  // namespace

std::vector<std::vector<std::uint32_t>> previousOwners(const Plan& plan) {
  // Heaps that swap hold the same resources again every other frame, so that four frames reach the steady state.
  constexpr int kFrames = 4;
  std::vector<std::uint32_t> byFirstUse;
  for (std::uint32_t i = 0; i < plan.resources.size(); ++i) {
    if (plan.resources[i].heap != kNone) byFirstUse.push_back(i);
  }
  std::ranges::stable_sort(byFirstUse, {}, [&](std::uint32_t i) { return plan.resources[i].firstUse; });

  std::vector<std::vector<Owner>> owners(plan.resources.size());
  std::vector<Ownership> allocations(plan.heaps.size());
  for (int frame = 0; frame < kFrames; ++frame) {
    for (const std::uint32_t i : byFirstUse) {
      const PlannedResource& resource = plan.resources[i];
      owners[i] = allocations[allocationOf(plan.heaps, resource.heap, frame % 2)].take(
          resource.offset, resource.offset + resource.size, {i, frame});
    }
  }
  std::vector<std::vector<std::uint32_t>> result(plan.resources.size());
  for (std::uint32_t i = 0; i < owners.size(); ++i) {
    const auto recent = [&](const Owner& owner) {
      const PlannedResource& resource = plan.resources[owner.resource];
      return std::tuple(owner.frame, resource.lastUse, resource.offset);
    };
    std::ranges::sort(owners[i], std::greater{}, recent);
    for (const Owner& owner : owners[i]) {
      if (result[i].empty() || result[i].back() != owner.resource) result[i].push_back(owner.resource);
    }
  }
  return result;
}

}  // namespace fg
