#include "framegraph/hand_over.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <tuple>

namespace fg {
namespace {

/// Who owns which bytes of one heap.
class Ownership {
 public:
  /// Give bytes to a resource, and return those who had any of them.
  std::vector<std::uint32_t> take(std::uint64_t begin, std::uint64_t end, std::uint32_t resource) {
    split(begin);
    split(end);
    const auto first = blocks_.lower_bound(begin);
    const auto last = blocks_.lower_bound(end);
    std::vector<std::uint32_t> owners;
    for (auto block = first; block != last; ++block) owners.push_back(block->second.owner);
    blocks_.erase(first, last);
    blocks_.emplace(begin, Block{end, resource});
    return owners;
  }

 private:
  struct Block {
    std::uint64_t end;
    std::uint32_t owner;
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

  std::map<std::uint64_t, Block> blocks_;  ///< By first byte.
};

}  // namespace

std::vector<std::vector<std::uint32_t>> previousOwners(const Plan& plan) {
  std::vector<std::uint32_t> byFirstUse;
  for (std::uint32_t i = 0; i < plan.resources.size(); ++i) {
    if (plan.resources[i].heap != kNone) byFirstUse.push_back(i);
  }
  std::ranges::stable_sort(byFirstUse, {}, [&](std::uint32_t i) { return plan.resources[i].firstUse; });

  std::vector<std::vector<std::uint32_t>> owners(plan.resources.size());
  std::vector<Ownership> heaps(plan.heaps.size());
  for (int frame = 0; frame < 2; ++frame) {
    for (const std::uint32_t i : byFirstUse) {
      const PlannedResource& resource = plan.resources[i];
      owners[i] = heaps[resource.heap].take(resource.offset, resource.offset + resource.size, i);
    }
  }
  for (std::uint32_t i = 0; i < owners.size(); ++i) {
    // Older by a frame are those that are used again at or after this resource's own first use.
    const auto recent = [&](std::uint32_t owner) {
      const PlannedResource& resource = plan.resources[owner];
      return std::tuple(resource.firstUse < plan.resources[i].firstUse, resource.lastUse, resource.offset);
    };
    std::ranges::sort(owners[i], std::greater{}, recent);
    owners[i].erase(std::unique(owners[i].begin(), owners[i].end()), owners[i].end());
  }
  return owners;
}

}  // namespace fg
