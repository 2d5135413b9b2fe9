#include "framegraph/compile.h"

#include <algorithm>
#include <numeric>

#include "framegraph/access.h"
#include "framegraph/format.h"

namespace fg {
namespace {

/// Passes in declared order; those that reach no export, history or side effect are left out.
void orderPasses(const GraphDesc& graph, Plan& plan) {
  std::vector<bool> neededResource(graph.resources.size());
  for (const ExportDecl& e : graph.exports) neededResource[e.resource.resource] = true;
  for (const HistoryDecl& h : graph.histories) neededResource[h.current] = true;
  std::vector<bool> kept(graph.passes.size());
  for (std::size_t i = graph.passes.size(); i-- > 0;) {
    const PassDecl& pass = graph.passes[i];
    kept[i] = pass.sideEffects || std::ranges::any_of(pass.accesses, [&](const AccessDecl& a) {
                return a.writeVersion != kNone && neededResource[a.resource];
              });
    if (!kept[i]) continue;
    for (const AccessDecl& a : pass.accesses) neededResource[a.resource] = true;
  }
  for (std::uint32_t i = 0; i < graph.passes.size(); ++i) {
    if (kept[i]) {
      plan.passes.push_back({i, {}});
    } else {
      plan.culled.push_back({i, "nothing it writes reaches an export or a history"});
    }
  }
}

void findLifetimes(const GraphDesc& graph, Plan& plan) {
  plan.resources.resize(graph.resources.size());
  for (std::uint32_t position = 0; position < plan.passes.size(); ++position) {
    for (const AccessDecl& a : graph.passes[plan.passes[position].pass].accesses) {
      PlannedResource& resource = plan.resources[a.resource];
      if (!resource.used) resource.firstUse = position;
      resource.used = true;
      resource.lastUse = position;
      resource.imageUsage |= accessInfo(a.access).imageUsage;
      resource.bufferUsage |= accessInfo(a.access).bufferUsage;
    }
  }
  for (const HistoryDecl& h : graph.histories) {
    PlannedResource& previous = plan.resources[h.previous];
    PlannedResource& current = plan.resources[h.current];
    previous.imageUsage = current.imageUsage |= previous.imageUsage;
  }
}

bool overlap(const PlannedResource& a, const PlannedResource& b) {
  return a.heap == b.heap && a.offset < b.offset + b.size && b.offset < a.offset + a.size;
}

/// Largest first, each at the lowest offset that no resource alive at the same time holds.
void placeTransients(const GraphDesc& graph, const MemoryModel& memory, Plan& plan) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < plan.resources.size(); ++i) {
    PlannedResource& resource = plan.resources[i];
    if (!resource.used) continue;
    const auto* texture = std::get_if<TextureDesc>(&graph.resources[i].desc);
    const MemoryRequirements needs =
        texture != nullptr ? memory.texture(*texture, resource.imageUsage)
                           : memory.buffer(std::get<BufferDesc>(graph.resources[i].desc), resource.bufferUsage);
    resource.size = needs.size;
    resource.alignment = needs.alignment;
    const Lifetime lifetime = graph.resources[i].lifetime;
    if (lifetime == Lifetime::HistoryCurrent) plan.memory.persistentBytes += 2 * needs.size;
    if (lifetime != Lifetime::Transient) continue;
    plan.memory.transientUnaliasedBytes += needs.size;
    order.push_back(i);
    const auto heap = std::ranges::find(plan.heaps, needs.memoryTypeBits, &PlannedHeap::memoryTypeBits);
    resource.heap = static_cast<std::uint32_t>(heap - plan.heaps.begin());
    if (heap == plan.heaps.end()) plan.heaps.push_back({needs.memoryTypeBits, 0});
  }
  std::ranges::stable_sort(order, std::greater{}, [&](std::uint32_t i) { return plan.resources[i].size; });
  std::vector<std::uint32_t> placed;
  for (const std::uint32_t i : order) {
    PlannedResource& resource = plan.resources[i];
    std::vector<std::uint64_t> candidates{0};
    for (const std::uint32_t j : placed) {
      const PlannedResource& other = plan.resources[j];
      if (other.heap == resource.heap)
        candidates.push_back((other.offset + other.size + resource.alignment - 1) / resource.alignment *
                             resource.alignment);
    }
    std::ranges::sort(candidates);
    for (const std::uint64_t candidate : candidates) {
      resource.offset = candidate;
      const bool free = std::ranges::none_of(placed, [&](std::uint32_t j) {
        const PlannedResource& other = plan.resources[j];
        return overlap(resource, other) && resource.firstUse <= other.lastUse && other.firstUse <= resource.lastUse;
      });
      if (free) break;
    }
    placed.push_back(i);
    PlannedHeap& heap = plan.heaps[resource.heap];
    heap.size = std::max(heap.size, resource.offset + resource.size);
  }
  for (const PlannedHeap& heap : plan.heaps) plan.memory.transientPeakBytes += heap.size;
  for (std::uint32_t position = 0; position < plan.passes.size(); ++position) {
    std::uint64_t live = 0;
    for (const std::uint32_t i : placed) {
      const PlannedResource& resource = plan.resources[i];
      if (resource.firstUse <= position && position <= resource.lastUse) live += resource.size;
    }
    plan.memory.transientLowerBoundBytes = std::max(plan.memory.transientLowerBoundBytes, live);
  }
}

/// What has happened to a resource since its last write.
struct State {
  VkPipelineStageFlags2 writeStage = VK_PIPELINE_STAGE_2_NONE;
  VkAccessFlags2 writeMask = VK_ACCESS_2_NONE;
  VkPipelineStageFlags2 readStages = VK_PIPELINE_STAGE_2_NONE;
  VkAccessFlags2 visibleTo = VK_ACCESS_2_NONE;
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
};

class Synchronizer {
 public:
  Synchronizer(const GraphDesc& graph, Plan& plan) : graph_(graph), plan_(plan), states_(graph.resources.size()) {}

  void run() {
    // The first replay only finds the state that a frame leaves behind; the second starts from it.
    replay(false);
    final_ = states_;
    replay(true);
    release();
  }

 private:
  void replay(bool record) {
    states_.assign(graph_.resources.size(), {});
    for (std::uint32_t i = 0; i < states_.size(); ++i) {
      if (const auto& acquire = graph_.resources[i].acquire) {
        states_[i] = {acquire->stage, acquire->access, VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE, acquire->layout};
      }
    }
    for (const HistoryDecl& h : graph_.histories) {
      if (final_.empty()) continue;
      const State& end = final_[h.current];
      states_[h.previous] = {end.writeStage | end.readStages, end.writeMask, VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE,
                             end.layout};
    }
    for (std::uint32_t position = 0; position < plan_.passes.size(); ++position) {
      PlannedPass& planned = plan_.passes[position];
      for (const AccessDecl& a : graph_.passes[planned.pass].accesses) {
        std::vector<PlannedBarrier> barriers;
        touch(a, position, barriers);
        if (record) planned.barriers.insert(planned.barriers.end(), barriers.begin(), barriers.end());
      }
    }
  }

  void touch(const AccessDecl& a, std::uint32_t position, std::vector<PlannedBarrier>& barriers) {
    if (graph_.resources[a.resource].lifetime == Lifetime::Upload) return;
    const AccessInfo& info = accessInfo(a.access);
    State& state = states_[a.resource];
    PlannedBarrier barrier;
    barrier.resource = a.resource;
    barrier.dstStage = info.stage;
    barrier.dstAccess = info.mask();
    barrier.oldLayout = state.layout;
    barrier.newLayout = info.layout;
    barrier.range = a.range;
    const PlannedResource& planned = plan_.resources[a.resource];
    const Lifetime lifetime = graph_.resources[a.resource].lifetime;
    const bool first = planned.firstUse == position && a.readVersion == kNone;
    if (first && lifetime == Lifetime::Transient) {
      handOver(a.resource, position, barrier);
    } else if (first && lifetime == Lifetime::HistoryCurrent) {
      const State& previous =
          final_.empty() ? state : final_[graph_.histories[graph_.resources[a.resource].history].previous];
      barrier.srcStage = previous.readStages | previous.writeStage;
      barrier.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
      barrier.reason = BarrierReason::HistoryCarry;
    } else if (info.writes()) {
      barrier.srcStage = state.readStages != 0 ? state.readStages : state.writeStage;
      barrier.srcAccess = state.readStages != 0 ? VK_ACCESS_2_NONE : state.writeMask;
      barrier.reason = state.readStages != 0 ? BarrierReason::WriteAfterRead : BarrierReason::WriteAfterWrite;
    } else {
      const bool visible = (info.readMask & ~state.visibleTo) == 0 && (info.stage & ~state.readStages) == 0;
      if (visible && state.layout == info.layout) return;
      const bool relayout = state.layout != info.layout && state.readStages != 0;
      barrier.srcStage = relayout ? state.readStages : state.writeStage;
      barrier.srcAccess = relayout ? VK_ACCESS_2_NONE : state.writeMask;
      barrier.reason = relayout ? BarrierReason::LayoutChange : BarrierReason::ReadAfterWrite;
    }
    barriers.push_back(barrier);
    if (info.writes()) {
      state = {info.stage, info.writeMask, VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE, info.layout};
    } else {
      state.readStages |= info.stage;
      state.visibleTo |= info.readMask;
      state.layout = info.layout;
    }
  }

  /// A transient's first use waits for whatever last touched its bytes, in this frame or the one before.
  void handOver(std::uint32_t resource, std::uint32_t position, PlannedBarrier& barrier) const {
    barrier.oldLayout = VK_IMAGE_LAYOUT_UNDEFINED;
    barrier.reason = BarrierReason::FirstUse;
    for (std::uint32_t i = 0; i < plan_.resources.size(); ++i) {
      const PlannedResource& other = plan_.resources[i];
      if (other.heap == kNone || !overlap(plan_.resources[resource], other)) continue;
      const bool inThisFrame = other.lastUse < position;
      if (!inThisFrame && final_.empty()) continue;
      const State& state = inThisFrame ? states_[i] : final_[i];
      barrier.srcStage |= state.readStages != 0 ? state.readStages : state.writeStage;
      barrier.srcAccess |= state.readStages != 0 ? VK_ACCESS_2_NONE : state.writeMask;
      if (i == resource) continue;
      barrier.reason = BarrierReason::AliasHandOver;
      barrier.aliasOf = i;
    }
  }

  void release() {
    for (const ExportDecl& e : graph_.exports) {
      const State& state = states_[e.resource.resource];
      PlannedBarrier barrier;
      barrier.resource = e.resource.resource;
      barrier.reason = BarrierReason::Release;
      barrier.srcStage = state.readStages | state.writeStage;
      barrier.srcAccess = state.writeMask;
      barrier.dstStage = e.release.stage;
      barrier.dstAccess = e.release.access;
      barrier.oldLayout = state.layout;
      barrier.newLayout = e.release.layout;
      plan_.releases.push_back(barrier);
    }
  }

  const GraphDesc& graph_;
  Plan& plan_;
  std::vector<State> states_;
  std::vector<State> final_;
};

std::uint64_t declaredBytes(const ResourceDecl& resource) {
  if (const auto* buffer = std::get_if<BufferDesc>(&resource.desc)) return buffer->size;
  const auto& texture = std::get<TextureDesc>(resource.desc);
  return std::uint64_t{texture.extent.width} * texture.extent.height * texture.arrayLayers *
         bytesPerTexel(texture.format);
}

void countTraffic(const GraphDesc& graph, Plan& plan) {
  for (const PlannedPass& planned : plan.passes) {
    for (const AccessDecl& a : graph.passes[planned.pass].accesses) {
      const std::uint64_t bytes = declaredBytes(graph.resources[a.resource]);
      if (a.readVersion != kNone) plan.traffic.bytesRead += bytes;
      if (a.writeVersion != kNone) plan.traffic.bytesWritten += bytes;
    }
  }
}

}  // namespace

bool CompileResult::ok() const {
  return std::ranges::none_of(diagnostics, [](const Diagnostic& d) { return d.severity == Severity::Error; });
}

std::string CompileResult::text() const {
  std::string text;
  for (const Diagnostic& d : diagnostics) text += d.code + ": " + d.message + "\n";
  return text;
}

CompileResult compile(const GraphDesc& graph, const MemoryModel& memory) {
  CompileResult result;
  orderPasses(graph, result.plan);
  findLifetimes(graph, result.plan);
  placeTransients(graph, memory, result.plan);
  Synchronizer(graph, result.plan).run();
  countTraffic(graph, result.plan);
  return result;
}

}  // namespace fg
