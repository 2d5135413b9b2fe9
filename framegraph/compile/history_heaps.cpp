#include "framegraph/compile/history_heaps.h"

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>

namespace fg {
namespace {

/// Largest sum of whole blocks that fits into a capacity (subset sum). Returns the capacity, an upper bound, if there
/// are too many combinations to try.
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

/// Requests that compete for the same memory.
class Demand {
 public:
  explicit Demand(std::vector<HeapRequest> requests) : requests_(std::move(requests)), live_(liveBytes(requests_)) {}

  /// Smallest number of bytes by which the requests at a position exceed a capacity, as blocks cannot be split.
  [[nodiscard]] std::uint64_t overSubscription(std::uint32_t position, std::uint64_t capacity) const {
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

HistoryHeaps::HistoryHeaps(std::vector<Member> members, std::uint32_t positions) : members_(std::move(members)) {
  std::ranges::stable_sort(members_, {}, [](const Member& m) { return std::tuple(m.lastRead, m.written); });
  std::vector<HeapRequest> incoming;
  std::vector<HeapRequest> outgoing;
  for (const Member& member : members_) {
    offsets_.push_back((size_ + member.alignment - 1) / member.alignment * member.alignment);
    size_ = offsets_.back() + member.size;
    incoming.push_back({member.size, member.alignment, member.written, positions - 1});
    outgoing.push_back({member.size, member.alignment, 0, member.lastRead});
  }
  const auto unused = [&](const std::vector<HeapRequest>& images) {
    std::vector<std::uint64_t> bytes = liveBytes(images);
    bytes.resize(positions);
    for (std::uint64_t& value : bytes) value = size_ - value;
    return bytes;
  };
  freeIncoming_ = unused(incoming);
  freeOutgoing_ = unused(outgoing);
}

std::vector<ByteSpan> HistoryHeaps::taken(const HeapRequest& transient, std::uint64_t stride) const {
  std::vector<ByteSpan> spans;
  const auto add = [&](std::uint64_t begin, std::uint64_t end) {
    if (spans.empty() || spans.back().end != begin) {
      spans.push_back({begin, end});
    } else {
      spans.back().end = end;
    }
  };
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (members_[i].written <= transient.lastUse) add(offsets_[i], offsets_[i] + members_[i].size);
  }
  add(size_, stride);
  // Members are in the order of their last reads.
  const auto unread = std::ranges::lower_bound(members_, transient.firstUse, {}, &Member::lastRead);
  add(stride + (unread == members_.end() ? size_ : offsets_[static_cast<std::size_t>(unread - members_.begin())]),
      2 * stride);
  return spans;
}

std::vector<std::uint64_t> HistoryHeaps::excess(const std::vector<HeapRequest>& requests,
                                                const std::vector<std::uint32_t>& heldUntil) const {
  // Sort the transients by the heaps that could hold them, each considered alone.
  std::vector<HeapRequest> nowhere;
  std::vector<HeapRequest> somewhere;
  std::vector<HeapRequest> inIncoming;
  std::vector<HeapRequest> inOutgoing;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    const HeapRequest& request = requests[i];
    const bool incoming = request.size <= freeIncoming_[heldUntil[i]];
    const bool outgoing = request.size <= freeOutgoing_[request.firstUse];
    (incoming || outgoing ? somewhere : nowhere).push_back(request);
    if (incoming && !outgoing) inIncoming.push_back(request);
    if (outgoing && !incoming) inOutgoing.push_back(request);
  }
  const Demand forBoth(std::move(somewhere));
  const Demand forIncoming(std::move(inIncoming));
  const Demand forOutgoing(std::move(inOutgoing));
  std::vector<std::uint64_t> result = liveBytes(nowhere);
  result.resize(freeIncoming_.size());
  for (std::uint32_t i = 0; i < result.size(); ++i) {
    const std::uint64_t incoming = freeIncoming_[i];
    const std::uint64_t outgoing = freeOutgoing_[i];
    result[i] += std::max({forIncoming.overSubscription(i, incoming), forOutgoing.overSubscription(i, outgoing),
                           forBoth.overSubscription(i, incoming + outgoing)});
  }
  return result;
}

}  // namespace fg
