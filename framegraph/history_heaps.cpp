#include "framegraph/history_heaps.h"

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>

namespace fg {
namespace {

/// Most bytes of whole blocks that a capacity holds. Bounded in cost: where there are too many combinations, the
/// capacity.
std::uint64_t mostFitting(const std::vector<std::uint64_t>& blocks, std::uint64_t capacity) {
  constexpr std::size_t kMostSums = 1024;
  std::set<std::uint64_t> sums = {0};
  for (const std::uint64_t block : blocks) {
    std::vector<std::uint64_t> added;
    for (const std::uint64_t sum : sums) {
      if (sum + block <= capacity) added.push_back(sum + block);
    }
    sums.insert(added.begin(), added.end());
    if (sums.size() > kMostSums) return capacity;
  }
  return *sums.rbegin();
}

/// Requests that compete for the same bytes.
class Contest {
 public:
  explicit Contest(std::vector<HeapRequest> requests) : requests_(std::move(requests)), live_(liveBytes(requests_)) {}

  /// Least bytes of those alive at a position that are left when a capacity is full.
  [[nodiscard]] std::uint64_t losers(std::uint32_t position, std::uint64_t capacity) const {
    if (position >= live_.size() || live_[position] <= capacity) return 0;
    std::vector<std::uint64_t> blocks;
    for (const HeapRequest& request : requests_) {
      if (request.firstUse <= position && position <= request.lastUse) blocks.push_back(request.size);
    }
    return live_[position] - mostFitting(blocks, capacity);
  }

 private:
  std::vector<HeapRequest> requests_;
  std::vector<std::uint64_t> live_;
};

}  // namespace

HistoryHeaps::HistoryHeaps(std::vector<Member> members, std::uint32_t positions)
    : members_(std::move(members)), positions_(positions) {
  std::ranges::stable_sort(members_, {}, [](const Member& m) { return std::tuple(m.lastRead, m.written); });
  for (const Member& member : members_) {
    offsets_.push_back((size_ + member.alignment - 1) / member.alignment * member.alignment);
    size_ = offsets_.back() + member.size;
  }
}

std::vector<HeapObstacle> HistoryHeaps::obstacles(std::uint64_t stride) const {
  const std::uint32_t last = positions_ - 1;
  std::vector<HeapObstacle> result;
  for (std::size_t i = 0; i < members_.size(); ++i) {
    const std::uint64_t begin = offsets_[i];
    const std::uint64_t end = begin + members_[i].size;
    result.push_back({begin, end, members_[i].written, last});
    result.push_back({stride + begin, stride + end, 0, members_[i].lastRead});
  }
  result.push_back({size_, stride, 0, last});
  result.push_back({stride + size_, 2 * stride, 0, last});
  return result;
}

std::uint64_t HistoryHeaps::freeIncoming(std::uint32_t position) const {
  std::uint64_t bytes = size_;
  for (const Member& member : members_) bytes -= member.written <= position ? member.size : 0;
  return bytes;
}

std::uint64_t HistoryHeaps::freeOutgoing(std::uint32_t position) const {
  std::uint64_t bytes = size_;
  for (const Member& member : members_) bytes -= position <= member.lastRead ? member.size : 0;
  return bytes;
}

std::vector<std::uint64_t> HistoryHeaps::excess(const std::vector<HeapRequest>& requests,
                                                const std::vector<std::uint32_t>& heldUntil) const {
  // By where they could lie, were they alone.
  std::vector<HeapRequest> nowhere;
  std::vector<HeapRequest> somewhere;
  std::vector<HeapRequest> inIncoming;
  std::vector<HeapRequest> inOutgoing;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    const HeapRequest& request = requests[i];
    const bool incoming = request.size <= freeIncoming(heldUntil[i]);
    const bool outgoing = request.size <= freeOutgoing(request.firstUse);
    (incoming || outgoing ? somewhere : nowhere).push_back(request);
    if (incoming && !outgoing) inIncoming.push_back(request);
    if (outgoing && !incoming) inOutgoing.push_back(request);
  }
  const Contest forBoth(std::move(somewhere));
  const Contest forIncoming(std::move(inIncoming));
  const Contest forOutgoing(std::move(inOutgoing));
  std::vector<std::uint64_t> result = liveBytes(nowhere);
  result.resize(positions_);
  for (std::uint32_t i = 0; i < positions_; ++i) {
    const std::uint64_t incoming = freeIncoming(i);
    const std::uint64_t outgoing = freeOutgoing(i);
    result[i] += std::max(
        {forIncoming.losers(i, incoming), forOutgoing.losers(i, outgoing), forBoth.losers(i, incoming + outgoing)});
  }
  return result;
}

}  // namespace fg
