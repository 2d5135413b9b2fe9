#include "framegraph/compile/schedule.h"

#include <algorithm>
#include <queue>
#include <utility>

#include "framegraph/compile/requirements.h"
#include "framegraph/declare/dependencies.h"

namespace fg {
namespace {

/// A list of numbers for each of the numbers 0 to count - 1, all in one allocation.
class Lists {
 public:
  /// @param pairs (list, element) in any order; the elements of one list keep theirs
  Lists(std::size_t count, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs)
      : begin_(count + 1), elements_(pairs.size()) {
    for (const auto& [list, element] : pairs) ++begin_[list + 1];
    for (std::size_t i = 0; i < count; ++i) begin_[i + 1] += begin_[i];
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for (const auto& [list, element] : pairs) elements_[next[list]++] = element;
  }
  [[nodiscard]] std::span<const std::uint32_t> operator[](std::size_t list) const {
    return std::span(elements_).subspan(begin_[list], begin_[list + 1] - begin_[list]);
  }

 private:
  std::vector<std::uint32_t> begin_;
  std::vector<std::uint32_t> elements_;
};

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// The passes to order, numbered in the order of their names, and the transients that they use.
struct Problem {
  std::vector<std::uint32_t> passes;  ///< Indexed by pass number: index into `GraphDesc::passes`.
  std::vector<std::uint64_t> bytes;   ///< Size of every transient.
  Lists touched;                      ///< Transients of each pass.
  Lists touching;                     ///< Passes of each transient.
  Lists successors;
  Lists predecessors;
};

Problem makeProblem(const Topology& topology, const Culling& culling, const std::vector<PlannedResource>& resources) {
  const GraphDesc& graph = topology.graph();
  std::vector<std::uint32_t> passes;
  std::vector<std::uint32_t> number(graph.passes.size(), kNone);
  for (const std::uint32_t pass : topology.passesByName()) {
    if (!culling.live[pass]) continue;
    number[pass] = static_cast<std::uint32_t>(passes.size());
    passes.push_back(pass);
  }
  const std::vector<bool> shared = aliasable(graph);
  std::vector<std::uint64_t> bytes(resources.size());
  Pairs touched;
  for (std::uint32_t i = 0; i < passes.size(); ++i) {
    for (const AccessDecl& access : graph.passes[passes[i]].accesses) {
      if (!shared[access.resource]) continue;
      bytes[access.resource] = resources[access.resource].size;
      touched.emplace_back(i, access.resource);
    }
  }
  std::ranges::sort(touched);
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  Pairs edges;
  for (const Dependency& dependency : dependencies(topology, culling.live)) {
    edges.emplace_back(number[dependency.before], number[dependency.after]);
  }
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  const auto swapped = [](Pairs pairs) {
    for (auto& [first, second] : pairs) std::swap(first, second);
    return pairs;
  };
  const std::size_t count = passes.size();
  return {std::move(passes),     std::move(bytes),
          Lists(count, touched), Lists(resources.size(), swapped(touched)),
          Lists(count, edges),   Lists(count, swapped(edges))};
}

/// A list schedule in one direction of time.
///
/// A pass starts the lifetime of the transients that no taken pass uses, and ends it for those that no pass uses after
/// it. Its cost is the bytes that it starts less those that it ends.
class ListSchedule {
 public:
  ListSchedule(const Problem& problem, const Lists& before, const Lists& after)
      : problem_(problem),
        after_(after),
        waiting_(problem.passes.size()),
        cost_(problem.passes.size()),
        remaining_(problem.bytes.size()),
        started_(problem.bytes.size()) {
    for (std::size_t i = 0; i < remaining_.size(); ++i) {
      remaining_[i] = static_cast<std::uint32_t>(problem.touching[i].size());
    }
    for (std::uint32_t pass = 0; pass < waiting_.size(); ++pass) {
      waiting_[pass] = static_cast<std::uint32_t>(before[pass].size());
      for (const std::uint32_t transient : problem.touched[pass]) {
        if (remaining_[transient] > 1) cost_[pass] += signedBytes(transient);
      }
      if (waiting_[pass] == 0) ready_.emplace(cost_[pass], pass);
    }
  }

  std::vector<std::uint32_t> run() {
    std::vector<std::uint32_t> order;
    order.reserve(waiting_.size());
    while (!ready_.empty()) {
      const auto [cost, pass] = ready_.top();
      ready_.pop();
      if (waiting_[pass] == kNone || cost != cost_[pass]) continue;
      waiting_[pass] = kNone;
      order.push_back(pass);
      take(pass);
    }
    return order;
  }

 private:
  [[nodiscard]] std::int64_t signedBytes(std::uint32_t transient) const {
    return static_cast<std::int64_t>(problem_.bytes[transient]);
  }

  void take(std::uint32_t pass) {
    for (const std::uint32_t transient : problem_.touched[pass]) {
      --remaining_[transient];
      const bool starts = !started_[transient];
      started_[transient] = true;
      // Once it is alive, its bytes no longer count as a cost. The last pass that uses it gets them deducted.
      if (starts || remaining_[transient] == 1) reduceCosts(transient, starts);
    }
    for (const std::uint32_t next : after_[pass]) {
      if (--waiting_[next] == 0) ready_.emplace(cost_[next], next);
    }
  }

  void reduceCosts(std::uint32_t transient, bool starts) {
    const std::int64_t bytes = signedBytes(transient);
    for (const std::uint32_t other : problem_.touching[transient]) {
      if (waiting_[other] == kNone) continue;
      cost_[other] -= (starts ? bytes : 0) + (remaining_[transient] == 1 ? bytes : 0);
      if (waiting_[other] == 0) ready_.emplace(cost_[other], other);
    }
  }

  const Problem& problem_;
  const Lists& after_;
  std::vector<std::uint32_t> waiting_;  ///< Number of passes that must come first; kNone once taken.
  std::vector<std::int64_t> cost_;      ///< Change of the live bytes when the pass is taken.
  std::vector<std::uint32_t> remaining_;
  std::vector<bool> started_;
  using Entry = std::pair<std::int64_t, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> ready_;
};

std::uint64_t peakBytes(const Problem& problem, std::span<const std::uint32_t> order) {
  std::vector<std::uint32_t> remaining(problem.bytes.size());
  std::uint64_t live = 0;
  std::uint64_t peak = 0;
  for (const std::uint32_t pass : order) {
    for (const std::uint32_t transient : problem.touched[pass]) {
      if (remaining[transient]++ == 0) live += problem.bytes[transient];
    }
    peak = std::max(peak, live);
    for (const std::uint32_t transient : problem.touched[pass]) {
      if (remaining[transient] == problem.touching[transient].size()) live -= problem.bytes[transient];
    }
  }
  return peak;
}

}  // namespace

std::vector<std::uint32_t> schedule(const Topology& topology, const Culling& culling,
                                    const std::vector<PlannedResource>& resources) {
  const Problem problem = makeProblem(topology, culling, resources);
  std::vector<std::uint32_t> order = ListSchedule(problem, problem.predecessors, problem.successors).run();
  std::vector<std::uint32_t> backward = ListSchedule(problem, problem.successors, problem.predecessors).run();
  std::ranges::reverse(backward);
  if (peakBytes(problem, backward) < peakBytes(problem, order)) order = std::move(backward);
  for (std::uint32_t& pass : order) pass = problem.passes[pass];
  return order;
}

}  // namespace fg
