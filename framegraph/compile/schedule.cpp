#include "framegraph/compile/schedule.h"

#include <algorithm>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include "framegraph/compile/requirements.h"
#include "framegraph/declare/access.h"
#include "framegraph/declare/dependencies.h"

namespace fg {
namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// `count` lists of numbers, all in one allocation.
class Lists {
 public:
  /// @param pairs (list, element) in any order; the elements of a list keep their order
  Lists(std::size_t count, const Pairs& pairs) : begin_(count + 1), elements_(pairs.size()) {
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

/// A texture and the layout in which a pass uses it.
struct TextureUse {
  std::uint32_t resource = kNone;
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
};

/// The passes to order, numbered in the order of their names, and the textures and transients that they use.
struct Problem {
  std::vector<std::uint32_t> passes;              ///< Indexed by pass number: index into `GraphDesc::passes`.
  std::vector<std::vector<TextureUse>> textures;  ///< Of each pass.
  std::vector<std::uint64_t> bytes;               ///< Indexed by resource: size of every transient.
  Lists transientsOf;                             ///< Transients that each pass uses.
  Lists usersOf;                                  ///< Passes that use each transient.
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
  Pairs transientUses;
  std::vector<std::vector<TextureUse>> textures(passes.size());
  for (std::uint32_t i = 0; i < passes.size(); ++i) {
    for (const AccessDecl& access : graph.passes[passes[i]].accesses) {
      if (std::holds_alternative<TextureDesc>(graph.resources[access.resource].desc)) {
        textures[i].push_back({access.resource, accessInfo(access.access).layout});
      }
      if (!shared[access.resource]) continue;
      bytes[access.resource] = resources[access.resource].size;
      transientUses.emplace_back(i, access.resource);
    }
  }
  std::ranges::sort(transientUses);
  transientUses.erase(std::unique(transientUses.begin(), transientUses.end()), transientUses.end());
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
  return {std::move(passes),
          std::move(textures),
          std::move(bytes),
          Lists(count, transientUses),
          Lists(resources.size(), swapped(transientUses)),
          Lists(count, edges),
          Lists(count, swapped(edges))};
}

/// Passes of each batch.
using Batches = std::vector<std::vector<std::uint32_t>>;

/// Indexed by pass: number of passes in the longest chain of dependencies that ends before the pass.
std::vector<std::uint32_t> chainLengths(const Lists& before, const Lists& after, std::size_t passes) {
  std::vector<std::uint32_t> length(passes);
  std::vector<std::uint32_t> waiting(passes);
  std::vector<std::uint32_t> ready;
  for (std::uint32_t pass = 0; pass < passes; ++pass) {
    waiting[pass] = static_cast<std::uint32_t>(before[pass].size());
    if (waiting[pass] == 0) ready.push_back(pass);
  }
  while (!ready.empty()) {
    const std::uint32_t pass = ready.back();
    ready.pop_back();
    for (const std::uint32_t next : after[pass]) {
      length[next] = std::max(length[next], length[pass] + 1);
      if (--waiting[next] == 0) ready.push_back(next);
    }
  }
  return length;
}

/// The layouts in which the passes of one batch use textures.
class BatchLayouts {
 public:
  explicit BatchLayouts(std::size_t resources) : layout_(resources) {}

  /// True if all passes added use the pass's textures in the layouts of the pass, or not at all.
  [[nodiscard]] bool agreeWith(std::span<const TextureUse> uses) const {
    return std::ranges::all_of(
        uses, [&](const TextureUse& use) { return !layout_[use.resource] || layout_[use.resource] == use.layout; });
  }
  void add(std::span<const TextureUse> uses) {
    for (const TextureUse& use : uses) {
      std::optional<VkImageLayout>& layout = layout_[use.resource];
      if (!layout) used_.push_back(use.resource);
      layout = layout.value_or(use.layout) == use.layout ? use.layout : kSeveral;
    }
  }
  void clear() {
    for (const std::uint32_t resource : used_) layout_[resource].reset();
    used_.clear();
  }

 private:
  /// One pass uses parts of the texture in several layouts.
  static constexpr VkImageLayout kSeveral = VK_IMAGE_LAYOUT_MAX_ENUM;

  std::vector<std::optional<VkImageLayout>> layout_;  ///< Indexed by resource.
  std::vector<std::uint32_t> used_;
};

/// A list schedule in one direction of time.
///
/// A pass starts the lifetime of transients that no taken pass uses, and ends the lifetime of those that no other pass
/// is still to use. Its cost is the bytes that it starts less those that it ends. A batch takes every pass that the
/// longest chain does not let wait, and of the others those that do not add to the live bytes.
class ListSchedule {
 public:
  ListSchedule(const Problem& problem, const Lists& before, const Lists& after)
      : problem_(problem),
        after_(after),
        waiting_(problem.passes.size()),
        latest_(chainLengths(after, before, problem.passes.size())),
        cost_(problem.passes.size()),
        remaining_(problem.bytes.size()),
        started_(problem.bytes.size()),
        layouts_(problem.bytes.size()) {
    const std::uint32_t longest = latest_.empty() ? 0 : std::ranges::max(latest_);
    for (std::uint32_t& batch : latest_) batch = longest - batch;
    for (std::size_t i = 0; i < remaining_.size(); ++i) {
      remaining_[i] = static_cast<std::uint32_t>(problem.usersOf[i].size());
    }
    for (std::uint32_t pass = 0; pass < waiting_.size(); ++pass) {
      waiting_[pass] = static_cast<std::uint32_t>(before[pass].size());
      for (const std::uint32_t transient : problem.transientsOf[pass]) {
        if (remaining_[transient] > 1) cost_[pass] += signedBytes(transient);
      }
      if (waiting_[pass] == 0) ready_.push_back(pass);
    }
  }

  Batches run() {
    Batches batches;
    while (!ready_.empty()) batches.push_back(takeBatch(static_cast<std::uint32_t>(batches.size())));
    return batches;
  }

 private:
  [[nodiscard]] std::int64_t signedBytes(std::uint32_t transient) const {
    return static_cast<std::int64_t>(problem_.bytes[transient]);
  }

  std::vector<std::uint32_t> takeBatch(std::uint32_t number) {
    const auto urgencyThenCost = [&](std::uint32_t pass) {
      return std::tuple(latest_[pass] > number, cost_[pass], pass);
    };
    std::ranges::sort(ready_, {}, urgencyThenCost);
    std::vector<std::uint32_t> taken;
    std::vector<std::uint32_t> left;
    layouts_.clear();
    for (const std::uint32_t pass : ready_) {
      const bool mayWait = latest_[pass] > number && cost_[pass] > 0;
      if (mayWait || !layouts_.agreeWith(problem_.textures[pass])) {
        left.push_back(pass);
        continue;
      }
      layouts_.add(problem_.textures[pass]);
      taken.push_back(pass);
      take(pass);
    }
    ready_ = std::move(left);
    for (const std::uint32_t pass : taken) {
      for (const std::uint32_t next : after_[pass]) {
        if (--waiting_[next] == 0) ready_.push_back(next);
      }
    }
    return taken;
  }

  void take(std::uint32_t pass) {
    for (const std::uint32_t transient : problem_.transientsOf[pass]) {
      --remaining_[transient];
      const bool starts = !started_[transient];
      started_[transient] = true;
      // A live transient costs no other pass its bytes, and the last pass that is still to use it will free them.
      if (starts || remaining_[transient] == 1) reduceCosts(transient, starts);
    }
  }

  void reduceCosts(std::uint32_t transient, bool starts) {
    const std::int64_t bytes = signedBytes(transient);
    for (const std::uint32_t other : problem_.usersOf[transient]) {
      cost_[other] -= (starts ? bytes : 0) + (remaining_[transient] == 1 ? bytes : 0);
    }
  }

  const Problem& problem_;
  const Lists& after_;
  std::vector<std::uint32_t> waiting_;    ///< Number of passes that must come first.
  std::vector<std::uint32_t> latest_;     ///< Last batch that leaves room for all passes that depend on the pass.
  std::vector<std::int64_t> cost_;        ///< Change of the live bytes when the pass is taken.
  std::vector<std::uint32_t> remaining_;  ///< Indexed by resource: passes that are still to use the transient.
  std::vector<bool> started_;             ///< Indexed by resource: whether the transient is alive, or was.
  BatchLayouts layouts_;                  ///< Of the batch that is being filled.
  std::vector<std::uint32_t> ready_;      ///< Passes that may be taken now.
};

std::uint64_t peakBytes(const Problem& problem, const Batches& batches) {
  std::vector<std::uint32_t> used(problem.bytes.size());
  std::uint64_t live = 0;
  std::uint64_t peak = 0;
  const auto forEachUse = [&](const std::vector<std::uint32_t>& batch, const auto& visit) {
    for (const std::uint32_t pass : batch) std::ranges::for_each(problem.transientsOf[pass], visit);
  };
  for (const std::vector<std::uint32_t>& batch : batches) {
    forEachUse(batch, [&](std::uint32_t transient) {
      if (used[transient]++ == 0) live += problem.bytes[transient];
    });
    peak = std::max(peak, live);
    forEachUse(batch, [&](std::uint32_t transient) {
      if (used[transient] != problem.usersOf[transient].size()) return;
      used[transient] = kNone;  // Several passes of the batch may be its last.
      live -= problem.bytes[transient];
    });
  }
  return peak;
}

}  // namespace

std::vector<std::vector<std::uint32_t>> schedule(const Topology& topology, const Culling& culling,
                                                 const std::vector<PlannedResource>& resources) {
  const Problem problem = makeProblem(topology, culling, resources);
  Batches batches = ListSchedule(problem, problem.predecessors, problem.successors).run();
  Batches backward = ListSchedule(problem, problem.successors, problem.predecessors).run();
  std::ranges::reverse(backward);
  if (std::tuple(backward.size(), peakBytes(problem, backward)) <
      std::tuple(batches.size(), peakBytes(problem, batches))) {
    batches = std::move(backward);
  }
  for (std::vector<std::uint32_t>& batch : batches) {
    for (std::uint32_t& pass : batch) pass = problem.passes[pass];
  }
  return batches;
}

}  // namespace fg
