#include "framegraph/compile/synchronize.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "framegraph/compile/access_history.h"
#include "framegraph/compile/merge_ranges.h"
#include "framegraph/compile/previous_owners.h"
#include "framegraph/declare/access.h"

namespace fg {
namespace {

/// The state in which a resource's first use in a frame finds it.
struct Beginning {
  std::vector<SubresourceState> states;
  BarrierReason reason = BarrierReason::FirstUse;
  std::uint32_t aliasOf = kNone;
};

/// Batch of releases: they come after all passes.
constexpr std::uint32_t kAfterLastBatch = kNone;

class Synchronizer {
 public:
  Synchronizer(const Topology& topology, const AccessHistory& accesses, Plan& plan)
      : topology_(topology),
        graph_(topology.graph()),
        plan_(plan),
        history_(accesses),
        owners_(previousOwners(plan)),
        releases_(graph_.resources.size()) {
    for (const ExportDecl& exported : graph_.exports) {
      releases_[exported.resource.resource] = hostState(exported.resource.resource, exported.release);
    }
  }

  void run() {
    plan_.histories.resize(graph_.histories.size());
    for (std::size_t i = 0; i < graph_.histories.size(); ++i) {
      if (plan_.resources[graph_.histories[i].current].used) plan_.histories[i] = carried(graph_.histories[i]);
    }
    for (const std::uint32_t resource : topology_.resourcesByName()) {
      if (plan_.resources[resource].used && graph_.resources[resource].lifetime != Lifetime::Upload) emit(resource);
    }
  }

 private:
  /// The host's state of a resource, without a layout if it is a buffer.
  [[nodiscard]] ExternalState hostState(std::uint32_t resource, ExternalState state) const {
    if (std::holds_alternative<BufferDesc>(graph_.resources[resource].desc)) state.layout = VK_IMAGE_LAYOUT_UNDEFINED;
    return state;
  }

  /// The state in which a frame leaves a subresource.
  /// @param state before the frame; the default is right if the first use overwrites the contents
  [[nodiscard]] SubresourceState ending(std::uint32_t resource, std::uint32_t subresource,
                                        SubresourceState state = {}) const {
    for (const AccessGroup& group : history_.groups(resource, subresource)) advance(state, group);
    if (releases_[resource]) release(state, *releases_[resource]);
    return state;
  }

  [[nodiscard]] PlannedHistory carried(const HistoryDecl& history) const {
    const SubresourceState end = ending(history.current, 0);
    return {true, {end.stage, end.pendingWrite, end.layout}};
  }

  /// The state of `previous` at the start of a frame, as the last frame or a clear by the executor leaves it.
  [[nodiscard]] SubresourceState carriedState(std::uint32_t history) const {
    const ExternalState& carry = plan_.histories[history].carry;
    return {.stage = carry.stage, .pendingWrite = carry.access, .layout = carry.layout};
  }

  /// Release a resource to the host. A host that names no stage waits for a fence or semaphore, which makes all writes
  /// visible to it. In that case the next frame needs a barrier of its own on the stages of this one.
  static std::optional<PlannedBarrier> release(SubresourceState& state, const ExternalState& to) {
    AccessGroup group;
    group.batch = kAfterLastBatch;
    group.stage = to.stage;
    group.readMask = to.access & ~kWriteAccesses;
    group.writeMask = to.access & kWriteAccesses;
    group.layout = to.layout;
    const auto released = [](std::optional<PlannedBarrier> barrier) {
      if (barrier) barrier->reason = BarrierReason::Release;
      return barrier;
    };
    if (to.stage != VK_PIPELINE_STAGE_2_NONE) {
      // The host waits only for the stages that it names, so that a barrier must lead from all others to these.
      if ((state.stage & ~to.stage) != VK_PIPELINE_STAGE_2_NONE) state.visibleStage = VK_PIPELINE_STAGE_2_NONE;
      return released(advance(state, group));
    }
    if (state.layout == to.layout) return std::nullopt;
    // The next frame waits for the last stages, and thereby for the layout transition too.
    const VkPipelineStageFlags2 stage = state.stage;
    std::optional<PlannedBarrier> barrier = released(advance(state, group));
    barrier->dstStage = stage;
    barrier->dstAccess = VK_ACCESS_2_NONE;
    state.stage = stage;
    return barrier;
  }

  [[nodiscard]] Beginning beginning(std::uint32_t resource) const {
    const ResourceDecl& decl = graph_.resources[resource];
    const std::uint32_t count = history_.subresourceCount(resource);
    switch (decl.lifetime) {
      case Lifetime::Imported:
        return {std::vector(count, externalState(hostState(resource, *decl.acquire))), BarrierReason::Acquire};
      case Lifetime::HistoryPrevious:
        return {{carriedState(decl.history)}, BarrierReason::HistoryCarry};
      case Lifetime::HistoryCurrent:
        return aliasedByTransients(resource) ? handOver(resource) : swapped(decl.history);
      default:
        return plan_.resources[resource].heap == kNone ? ownBeginning(resource) : handOver(resource);
    }
  }

  /// The same state with contents that may be discarded.
  static SubresourceState overwritten(SubresourceState state) {
    state.layout = VK_IMAGE_LAYOUT_UNDEFINED;
    return state;
  }

  [[nodiscard]] Beginning ownBeginning(std::uint32_t resource) const {
    Beginning result;
    for (std::uint32_t i = 0; i < history_.subresourceCount(resource); ++i) {
      result.states.push_back(overwritten(ending(resource, i)));
    }
    return result;
  }

  [[nodiscard]] Beginning handOver(std::uint32_t resource) const {
    const std::vector<std::uint32_t>& owners = owners_[resource];
    if (owners == std::vector{resource}) return ownBeginning(resource);
    SubresourceState state;
    for (const std::uint32_t owner : owners) {
      for (std::uint32_t i = 0; i < history_.subresourceCount(owner); ++i) state.stage |= ending(owner, i).stage;
    }
    return {std::vector(history_.subresourceCount(resource), state), BarrierReason::AliasHandOver,
            *std::ranges::find_if(owners, [&](std::uint32_t owner) { return owner != resource; })};
  }

  /// `current` is the image that was `previous` in the last frame: wait for the reads of it there.
  [[nodiscard]] Beginning swapped(std::uint32_t history) const {
    const std::uint32_t previous = graph_.histories[history].previous;
    return {{overwritten(ending(previous, 0, carriedState(history)))}, BarrierReason::HistoryCarry};
  }

  /// True if transients have used some of the bytes of a history's `current` since it was `previous`.
  [[nodiscard]] bool aliasedByTransients(std::uint32_t current) const {
    return std::ranges::any_of(
        owners_[current], [&](std::uint32_t owner) { return graph_.resources[owner].lifetime == Lifetime::Transient; });
  }

  /// True if other resources use some of a transient's bytes before the next frame does.
  [[nodiscard]] bool sharesMemory(std::uint32_t resource) const {
    return graph_.resources[resource].lifetime == Lifetime::Transient && plan_.resources[resource].heap != kNone &&
           owners_[resource] != std::vector{resource};
  }

  [[nodiscard]] std::uint32_t nextBatch(std::uint32_t batch) const {
    return batch + 1 < batchCount(plan_) ? batch + 1 : kAfterLastBatch;
  }

  /// The list of barriers before a batch.
  [[nodiscard]] std::vector<PlannedBarrier>& barriersOf(std::uint32_t batch) {
    if (batch == kAfterLastBatch) return plan_.releases;
    return std::ranges::lower_bound(plan_.passes, batch, {}, &PlannedPass::batch)->barriers;
  }

  /// A barrier that makes a write available which nobody reads. A later wait for the writing stage includes it.
  static PlannedBarrier retire(const SubresourceState& state) {
    PlannedBarrier barrier;
    barrier.reason = BarrierReason::Retire;
    barrier.srcStage = state.stage;
    barrier.srcAccess = state.pendingWrite;
    barrier.dstStage = state.stage;
    barrier.oldLayout = state.layout;
    barrier.newLayout = state.layout;
    return barrier;
  }

  void emit(std::uint32_t resource) {
    const Beginning begin = beginning(resource);
    std::vector<std::pair<std::uint32_t, PlannedBarrier>> barriers;
    for (std::uint32_t i = 0; i < history_.subresourceCount(resource); ++i) {
      SubresourceState state = begin.states[i];
      const auto add = [&](std::uint32_t batch, const std::optional<PlannedBarrier>& barrier) {
        if (!barrier) return;
        barriers.emplace_back(batch, *barrier);
        barriers.back().second.resource = resource;
        barriers.back().second.range = history_.range(resource, i);
      };
      const std::span<const AccessGroup> groups = history_.groups(resource, i);
      for (const AccessGroup& group : groups) {
        std::optional<PlannedBarrier> barrier = advance(state, group);
        if (barrier && &group == groups.data()) {
          barrier->reason = begin.reason;
          barrier->aliasOf = begin.aliasOf;
        }
        add(group.batch, barrier);
      }
      if (const auto to = finalState(resource, state)) add(kAfterLastBatch, release(state, *to));
      if (sharesMemory(resource) && state.pendingWrite != VK_ACCESS_2_NONE) {
        add(nextBatch(groups.back().batch), retire(state));
      }
    }
    if (history_.subresourceCount(resource) > 1) mergeRanges(graph_.resources[resource], barriers);
    for (const auto& [batch, barrier] : barriers) barriersOf(batch).push_back(barrier);
  }

  /// The state in which the host gets a resource back. Imports that are not exported return to the state in which they
  /// arrived, because the next frame expects that state again. A layout of UNDEFINED is no state to return to, so that
  /// the layout is kept.
  [[nodiscard]] std::optional<ExternalState> finalState(std::uint32_t resource, const SubresourceState& state) const {
    if (releases_[resource]) return releases_[resource];
    if (!graph_.resources[resource].acquire) return std::nullopt;
    ExternalState acquire = hostState(resource, *graph_.resources[resource].acquire);
    if (acquire.layout == VK_IMAGE_LAYOUT_UNDEFINED) acquire.layout = state.layout;
    // A barrier that starts from the import's state waits for its stages only, and makes its writes available only.
    const bool hostWrites = (acquire.access & kWriteAccesses) != VK_ACCESS_2_NONE;
    const bool readable =
        (acquire.stage & ~state.visibleStage) == 0 && (acquire.access & ~state.visibleAccess) == VK_ACCESS_2_NONE;
    const bool covered = (state.stage & ~acquire.stage) == 0 && (state.pendingWrite & ~acquire.access) == 0;
    const bool asItCame = state.layout == acquire.layout && covered && (hostWrites || readable);
    return asItCame ? std::nullopt : std::optional(acquire);
  }

  const Topology& topology_;
  const GraphDesc& graph_;
  Plan& plan_;
  const AccessHistory& history_;
  std::vector<std::vector<std::uint32_t>> owners_;
  std::vector<std::optional<ExternalState>> releases_;
};

}  // namespace

void synchronize(const Topology& topology, const AccessHistory& accesses, Plan& plan) {
  Synchronizer(topology, accesses, plan).run();
}

}  // namespace fg
