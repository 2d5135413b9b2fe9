#include "framegraph/compile/alias.h"

#include <algorithm>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "framegraph/compile/heap_packing.h"
#include "framegraph/compile/history_heaps.h"
#include "framegraph/compile/requirements.h"

namespace fg {
namespace {

std::uint64_t roundUp(std::uint64_t value, std::uint64_t step) {
  return (value + step - 1) / step * step;
}

/// Places transients and histories of one memory class.
class Placement {
 public:
  /// @param transients resources, ordered by name
  /// @param histories indices into `GraphDesc::histories`, ordered by name
  Placement(const Topology& topology, const AccessHistory& accesses, std::uint64_t granularity,
            std::vector<std::uint32_t> transients, const std::vector<std::uint32_t>& histories, Plan& plan)
      : graph_(topology.graph()),
        plan_(plan),
        transients_(std::move(transients)),
        page_(pageSize(granularity, !histories.empty())),
        heaps_(members(histories), batchCount(plan)) {
    for (const std::uint32_t resource : transients_) {
      const PlannedResource& planned = plan.resources[resource];
      heldUntil_.push_back(heldUntil(accesses, plan, resource));
      const std::uint32_t first = batchOf(planned.firstUse);
      used_.push_back({planned.size, planned.alignment, first, batchOf(planned.lastUse)});
      held_.push_back({roundUp(planned.size, page_), std::max(planned.alignment, page_), first, heldUntil_.back()});
    }
  }

  void run(std::uint32_t memoryTypeBits) {
    // The second heap begins at a multiple of every alignment, so that offsets in both heaps are aligned alike.
    std::uint64_t alignment = 1;
    for (const HeapRequest& request : held_) alignment = std::max(alignment, request.alignment);
    for (const HistoryHeaps::Member& member : heaps_.members()) alignment = std::max(alignment, member.alignment);
    stride_ = roundUp(heaps_.size(), alignment);
    HeapPacking packing = packAll();
    const auto first = static_cast<std::uint32_t>(plan_.heaps.size());
    if (stride_ != 0) {
      plan_.heaps.push_back({memoryTypeBits, heaps_.size(), first + 1});
      plan_.heaps.push_back({memoryTypeBits, heaps_.size(), first});
    }
    placeHistories(first);
    const std::uint64_t own = 2 * stride_;  // Start of the heap that holds only transients.
    for (std::size_t i = 0; i < transients_.size(); ++i) {
      PlannedResource& resource = plan_.resources[transients_[i]];
      const std::uint64_t offset = packing.offsets[i];
      const std::uint64_t heap = offset < own ? offset / stride_ : (own == 0 ? 0 : 2);
      resource.heap = first + static_cast<std::uint32_t>(heap);
      resource.offset = offset - heap * stride_;
      plan_.memory.transientUnaliasedBytes += resource.size;
    }
    if (packing.size <= own) return;
    plan_.heaps.push_back({memoryTypeBits, packing.size - own});
    plan_.memory.transientPeakBytes += packing.size - own;
  }

  /// Indexed by batch: a lower bound of the bytes of transients that do not fit into the histories' heaps.
  [[nodiscard]] std::vector<std::uint64_t> excess() const { return heaps_.excess(used_, heldUntil_); }

 private:
  [[nodiscard]] std::uint32_t batchOf(std::uint32_t position) const { return plan_.passes[position].batch; }

  /// Unit of offsets and sizes in a heap. Buffers and optimally tiled images must not share a page of `granularity`
  /// bytes, so that a heap with both consists of whole pages; in other heaps a page is one byte.
  [[nodiscard]] std::uint64_t pageSize(std::uint64_t granularity, bool hasHistories) const {
    const auto buffers = std::ranges::count_if(
        transients_, [&](std::uint32_t i) { return std::holds_alternative<BufferDesc>(graph_.resources[i].desc); });
    const bool both = buffers != 0 && (hasHistories || buffers != std::ssize(transients_));
    return both ? granularity : 1;
  }

  [[nodiscard]] std::vector<HistoryHeaps::Member> members(const std::vector<std::uint32_t>& histories) const {
    std::vector<HistoryHeaps::Member> members;
    for (const std::uint32_t index : histories) {
      const HistoryDecl& history = graph_.histories[index];
      const PlannedResource& current = plan_.resources[history.current];
      members.push_back({index, roundUp(current.size, page_), std::max(current.alignment, page_),
                         batchOf(current.firstUse), batchOf(plan_.resources[history.previous].lastUse)});
    }
    return members;
  }

  /// Place all transients in one address space of three heaps: [0, stride) holds every history's `current`, [stride,
  /// 2 stride) every `previous`, and from 2 stride on there are only transients. Each block takes the lowest free
  /// bytes, so that the third heap is used last.
  [[nodiscard]] HeapPacking packAll() const {
    if (stride_ == 0) return pack(held_);
    const std::uint64_t own = 2 * stride_;
    const std::uint64_t target = own + std::ranges::max(heaps_.excess(held_, heldUntil_));
    std::vector<std::vector<ByteSpan>> taken;
    for (const HeapRequest& request : held_) taken.push_back(heaps_.taken(request, stride_));
    HeapPacking packing = pack(held_, taken, target);
    if (packing.size <= own + lowerBound(held_)) return packing;
    // The search is a heuristic: a packing without the histories' heaps can turn out smaller.
    HeapPacking apart = pack(held_);
    if (own + apart.size >= packing.size) return packing;
    for (std::uint64_t& offset : apart.offsets) offset += own;
    apart.size += own;
    return apart;
  }

  void placeHistories(std::uint32_t incoming) {
    for (std::size_t i = 0; i < heaps_.members().size(); ++i) {
      const HistoryDecl& history = graph_.histories[heaps_.members()[i].history];
      plan_.resources[history.current].heap = incoming;
      plan_.resources[history.previous].heap = incoming + 1;
      for (const std::uint32_t resource : {history.current, history.previous}) {
        plan_.resources[resource].offset = heaps_.offset(i);
      }
    }
  }

  const GraphDesc& graph_;
  Plan& plan_;
  std::vector<std::uint32_t> transients_;
  std::uint64_t page_;
  HistoryHeaps heaps_;
  std::vector<std::uint32_t> heldUntil_;  ///< Indexed by transient.
  std::vector<HeapRequest> used_;         ///< Indexed by transient: from first to last use.
  std::vector<HeapRequest> held_;         ///< Indexed by transient: whole pages, from first use to `heldUntil_`.
  std::uint64_t stride_ = 0;              ///< Distance between the histories' heaps; 0 without histories.
};

/// Resources that may share memory with each other. Both lists are ordered by name.
struct MemoryClass {
  std::vector<std::uint32_t> transients;
  std::vector<std::uint32_t> histories;  ///< Index into `GraphDesc::histories`.
};

/// Maps the memory types that the device allows for a resource to all resources with these types.
std::map<std::uint32_t, MemoryClass> memoryClasses(const Topology& topology, const Plan& plan, bool aliasHistories) {
  const GraphDesc& graph = topology.graph();
  const std::vector<bool> shared = aliasable(graph);
  const std::vector<bool> aliasable = aliasableHistories(graph, plan.resources);
  std::map<std::uint32_t, MemoryClass> classes;
  for (const std::uint32_t resource : topology.resourcesByName()) {
    const PlannedResource& planned = plan.resources[resource];
    if (shared[resource] && planned.used) classes[planned.memoryTypeBits].transients.push_back(resource);
    const ResourceDecl& decl = graph.resources[resource];
    if (decl.lifetime != Lifetime::HistoryCurrent || !aliasHistories || !aliasable[decl.history]) continue;
    classes[planned.memoryTypeBits].histories.push_back(decl.history);
  }
  return classes;
}

}  // namespace

std::uint32_t heldUntil(const AccessHistory& accesses, const Plan& plan, std::uint32_t resource) {
  const std::uint32_t lastUse = plan.passes[plan.resources[resource].lastUse].batch;
  const std::uint32_t unread = accesses.lastUnreadWrite(resource);
  return unread == kNone ? lastUse : std::max(lastUse, std::min(unread + 1, batchCount(plan) - 1));
}

void placeTransients(const Topology& topology, const AccessHistory& accesses, std::uint64_t bufferImageGranularity,
                     bool aliasHistories, Plan& plan) {
  std::vector<std::uint64_t> excess(batchCount(plan));
  for (auto& [memoryTypeBits, members] : memoryClasses(topology, plan, aliasHistories)) {
    Placement placement(topology, accesses, bufferImageGranularity, members.transients, members.histories, plan);
    placement.run(memoryTypeBits);
    std::ranges::transform(excess, placement.excess(), excess.begin(), std::plus{});
  }
  plan.memory.transientLowerBoundBytes = excess.empty() ? 0 : std::ranges::max(excess);
}

}  // namespace fg
