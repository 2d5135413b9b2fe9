#include "framegraph/compile/heap_packing.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <tuple>
#include <utility>

namespace fg {
namespace {

/// Bounds the work of all attempts together. Unit: visits of blocks that are alive at the same time.
constexpr std::uint64_t kVisitBudget = 200'000;

std::uint64_t aligned(std::uint64_t offset, std::uint64_t alignment) {
  return (offset + alignment - 1) / alignment * alignment;
}

/// Indexed by request: the requests that are alive at some position at which it is alive.
std::vector<std::vector<std::uint32_t>> findNeighbours(const std::vector<HeapRequest>& requests) {
  std::vector<std::uint32_t> byStart(requests.size());
  std::iota(byStart.begin(), byStart.end(), 0U);
  std::ranges::stable_sort(byStart, {}, [&](std::uint32_t i) { return requests[i].firstUse; });
  std::vector<std::vector<std::uint32_t>> neighbours(requests.size());
  std::vector<std::uint32_t> active;
  for (const std::uint32_t i : byStart) {
    std::erase_if(active, [&](std::uint32_t j) { return requests[j].lastUse < requests[i].firstUse; });
    for (const std::uint32_t j : active) {
      neighbours[i].push_back(j);
      neighbours[j].push_back(i);
    }
    active.push_back(i);
  }
  return neighbours;
}

class Packer {
 public:
  Packer(const std::vector<HeapRequest>& requests, const std::vector<std::vector<ByteSpan>>& taken,
         std::uint64_t target)
      : requests_(requests), taken_(taken), neighbours_(findNeighbours(requests)), target_(target) {
    for (const auto& list : neighbours_) visitsPerAttempt_ += list.size() + 1;
    for (const auto& list : taken_) visitsPerAttempt_ += list.size();
  }

  HeapPacking run() {
    for (std::vector<std::uint32_t>& order : orders()) {
      attempt(order);
      if (finished()) return std::move(best_);
    }
    improve();
    return std::move(best_);
  }

 private:
  using Order = std::vector<std::uint32_t>;

  [[nodiscard]] bool finished() const { return best_.size <= target_ || visits_ >= kVisitBudget; }

  template <typename Key>
  [[nodiscard]] Order orderedBy(Key key) const {
    Order order(requests_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::stable_sort(order, std::greater{}, key);
    return order;
  }

  [[nodiscard]] std::vector<Order> orders() const {
    const auto size = [&](std::uint32_t i) { return requests_[i].size; };
    const auto duration = [&](std::uint32_t i) { return requests_[i].lastUse - requests_[i].firstUse + 1; };
    const std::vector<std::uint64_t> live = liveBytes(requests_);
    const auto crowding = [&](std::uint32_t i) {
      return *std::max_element(live.begin() + requests_[i].firstUse, live.begin() + requests_[i].lastUse + 1);
    };
    return {orderedBy([&](std::uint32_t i) { return std::pair(size(i), duration(i)); }),
            orderedBy([&](std::uint32_t i) { return std::pair(size(i) * duration(i), size(i)); }),
            orderedBy([&](std::uint32_t i) { return std::pair(duration(i), size(i)); }),
            orderedBy([&](std::uint32_t i) { return std::tuple(crowding(i), size(i), duration(i)); }),
            orderedBy([&](std::uint32_t i) { return std::pair(~requests_[i].firstUse, size(i)); })};
  }

  /// Put every block, in the given order, into the lowest gap between the neighbours that are already placed.
  HeapPacking place(const Order& order) {
    HeapPacking packing{std::vector<std::uint64_t>(requests_.size(), kUnplaced), 0};
    std::vector<ByteSpan> taken;
    for (const std::uint32_t i : order) {
      taken = taken_[i];
      for (const std::uint32_t j : neighbours_[i]) {
        if (packing.offsets[j] == kUnplaced) continue;
        taken.push_back({packing.offsets[j], packing.offsets[j] + requests_[j].size});
      }
      std::ranges::sort(taken);
      std::uint64_t offset = 0;
      for (const auto& [begin, end] : taken) {
        if (offset + requests_[i].size <= begin) break;
        offset = std::max(offset, aligned(end, requests_[i].alignment));
      }
      packing.offsets[i] = offset;
      packing.size = std::max(packing.size, offset + requests_[i].size);
    }
    visits_ += visitsPerAttempt_;
    return packing;
  }

  bool attempt(const Order& order) {
    HeapPacking packing = place(order);
    if (!bestOrder_.empty() && packing.size >= best_.size) return false;
    best_ = std::move(packing);
    bestOrder_ = order;
    return true;
  }

  /// Move the block with the highest end forward in the order, so that it finds a lower gap. Repeat until it is first,
  /// the target is met or the budget is used up.
  void improve() {
    Order order = bestOrder_;
    HeapPacking current = best_;
    while (!finished()) {
      const auto top = std::ranges::find_if(
          order, [&](std::uint32_t i) { return current.offsets[i] + requests_[i].size == current.size; });
      if (top == order.begin()) return;
      std::rotate(order.begin() + (top - order.begin()) / 2, top, top + 1);
      current = place(order);
      if (current.size >= best_.size) continue;
      best_ = current;
      bestOrder_ = order;
    }
  }

  static constexpr std::uint64_t kUnplaced = ~std::uint64_t{0};

  const std::vector<HeapRequest>& requests_;
  const std::vector<std::vector<ByteSpan>>& taken_;
  std::vector<std::vector<std::uint32_t>> neighbours_;
  std::uint64_t target_;
  std::uint64_t visitsPerAttempt_ = 0;
  std::uint64_t visits_ = 0;
  Order bestOrder_;
  HeapPacking best_;
};

}  // namespace

std::vector<std::uint64_t> liveBytes(const std::vector<HeapRequest>& requests) {
  std::uint32_t end = 0;
  for (const HeapRequest& request : requests) end = std::max(end, request.lastUse + 1);
  std::vector<std::uint64_t> live(std::size_t{end} + 1);
  for (const HeapRequest& request : requests) {
    live[request.firstUse] += request.size;
    live[std::size_t{request.lastUse} + 1] -= request.size;
  }
  std::partial_sum(live.begin(), live.end(), live.begin());
  return live;
}

std::uint64_t lowerBound(const std::vector<HeapRequest>& requests) {
  return std::ranges::max(liveBytes(requests));
}

HeapPacking pack(const std::vector<HeapRequest>& requests, const std::vector<std::vector<ByteSpan>>& taken,
                 std::uint64_t target) {
  if (requests.empty()) return {};
  return Packer(requests, taken, target).run();
}

HeapPacking pack(const std::vector<HeapRequest>& requests) {
  return pack(requests, std::vector<std::vector<ByteSpan>>(requests.size()), lowerBound(requests));
}

}  // namespace fg
