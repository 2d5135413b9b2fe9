#include "framegraph/verify/verify_structure.h"

#include <algorithm>

#include "framegraph/verify/verify_rules.h"

namespace fg::check {
namespace {

class Structure {
 public:
  Structure(const GraphDesc& graph, const Plan& plan) : graph_(graph), plan_(plan) {}

  std::vector<std::string> run() {
    if (plan_.resources.size() != graph_.resources.size() || plan_.histories.size() != graph_.histories.size()) {
      return {"the numbers of resources or histories of plan and graph differ"};
    }
    checkPasses();
    if (!faults_.empty()) return std::move(faults_);
    checkHeaps();
    collectUses();
    for (std::uint32_t i = 0; i < plan_.resources.size(); ++i) checkResource(i);
    for (const HistoryDecl& history : graph_.histories) checkHistory(history);
    for (const PlannedPass& pass : plan_.passes) checkBarriers(pass.barriers);
    checkBarriers(plan_.releases);
    return std::move(faults_);
  }

 private:
  void checkPasses() {
    std::vector<int> seen(graph_.passes.size());
    const auto see = [&](std::uint32_t pass) {
      if (pass >= seen.size()) {
        faults_.emplace_back("the plan names a pass that the graph does not have");
      } else {
        ++seen[pass];
      }
    };
    for (const PlannedPass& pass : plan_.passes) see(pass.pass);
    for (const CulledPass& pass : plan_.culled) {
      see(pass.pass);
      if (pass.pass < seen.size() && graph_.passes[pass.pass].sideEffects) {
        faults_.push_back("pass '" + graph_.passes[pass.pass].name + "' has side effects, but is culled");
      }
    }
    for (std::size_t i = 0; i < plan_.passes.size(); ++i) checkBatch(i);
    if (std::ranges::any_of(seen, [](int count) { return count != 1; })) {
      faults_.emplace_back("some pass is neither executed nor culled, or appears twice");
    }
  }

  /// Batches are numbered from 0 in the order of execution. Only the first pass of a batch has barriers.
  void checkBatch(std::size_t position) {
    const PlannedPass& pass = plan_.passes[position];
    const std::uint32_t before = position == 0 ? kNone : plan_.passes[position - 1].batch;
    if (pass.batch == before && !pass.barriers.empty()) {
      faults_.push_back("pass " + std::to_string(position) + " has barriers inside its batch");
    }
    if (pass.batch != before && pass.batch != before + 1) {  // kNone + 1 is 0.
      faults_.push_back("pass " + std::to_string(position) + " is in a batch that does not follow the one before");
    }
  }

  /// What the passes of the plan and the exports do with a resource.
  struct ResourceUses {
    std::uint32_t first = kNone;  ///< Position of the first pass.
    std::uint32_t last = kNone;
    VkFlags usage = 0;
    const ExportDecl* exported = nullptr;
  };

  void collectUses() {
    uses_.resize(graph_.resources.size());
    for (std::uint32_t position = 0; position < plan_.passes.size(); ++position) {
      for (const AccessDecl& access : graph_.passes[plan_.passes[position].pass].accesses) {
        ResourceUses& uses = uses_[access.resource];
        if (uses.first == kNone) uses.first = position;
        uses.last = position;
        const bool texture = std::holds_alternative<TextureDesc>(graph_.resources[access.resource].desc);
        uses.usage |= useOf(access.access, texture).usage;
      }
    }
    for (const ExportDecl& exported : graph_.exports) uses_[exported.resource.resource].exported = &exported;
  }

  void checkResource(std::uint32_t index) {
    const ResourceDecl& decl = graph_.resources[index];
    const PlannedResource& planned = plan_.resources[index];
    const auto& [first, last, usage, exported] = uses_[index];
    const bool texture = std::holds_alternative<TextureDesc>(decl.desc);
    if (planned.firstUse != first || planned.lastUse != last) fault(decl, "has a lifetime that differs from its uses");
    if (((texture ? planned.imageUsage : planned.bufferUsage) & usage) != usage) fault(decl, "lacks usage flags");
    if (exported != nullptr) {
      const VkFlags needed = texture ? usageInLayout(exported->release.layout) : 0;
      if ((planned.imageUsage & needed) != needed)
        fault(decl, "lacks usage flags of the layout in which it is released");
    }
    if (first != kNone && !planned.used) fault(decl, "is used, but marked unused");
    const bool transient = decl.lifetime == Lifetime::Transient;
    const bool shares = (transient || decl.history != kNone) && exported == nullptr;
    if (!shares && planned.heap != kNone) fault(decl, "must not share memory");
    if (shares && first != kNone && (transient || planned.heap != kNone)) checkPlace(decl, planned);
  }

  void checkHeaps() {
    for (std::uint32_t i = 0; i < plan_.heaps.size(); ++i) {
      const PlannedHeap& heap = plan_.heaps[i];
      if (heap.partner == kNone) continue;
      const bool mutual =
          heap.partner < plan_.heaps.size() && heap.partner != i && plan_.heaps[heap.partner].partner == i;
      if (!mutual) {
        faults_.push_back("heap " + std::to_string(i) + " swaps with a heap that does not swap with it");
      } else if (heap.size != plan_.heaps[heap.partner].size ||
                 heap.memoryTypeBits != plan_.heaps[heap.partner].memoryTypeBits) {
        faults_.push_back("heap " + std::to_string(i) + " swaps with a heap of another kind or size");
      }
    }
  }

  /// The images of a history swap roles, so that each must lie at the same place of the partner heap as the other.
  void checkHistory(const HistoryDecl& history) {
    const PlannedResource& current = plan_.resources[history.current];
    const PlannedResource& previous = plan_.resources[history.previous];
    if (current.heap == kNone && previous.heap == kNone) return;
    const bool swap = current.heap < plan_.heaps.size() && plan_.heaps[current.heap].partner != kNone &&
                      plan_.heaps[current.heap].partner == previous.heap && current.offset == previous.offset &&
                      current.size == previous.size;
    if (!swap) fault(graph_.resources[history.current], "does not lie where its other image lies in the partner heap");
  }

  void checkPlace(const ResourceDecl& decl, const PlannedResource& planned) {
    if (planned.heap >= plan_.heaps.size()) return fault(decl, "has no heap");
    const PlannedHeap& heap = plan_.heaps[planned.heap];
    if (planned.alignment == 0 || planned.offset % planned.alignment != 0) fault(decl, "is misaligned");
    if (planned.offset + planned.size > heap.size) fault(decl, "reaches past the end of its heap");
    if ((heap.memoryTypeBits & ~planned.memoryTypeBits) != 0) fault(decl, "is in a type of memory that it cannot use");
  }

  void checkBarriers(const std::vector<PlannedBarrier>& barriers) {
    for (const PlannedBarrier& barrier : barriers) {
      if (barrier.resource >= graph_.resources.size()) {
        faults_.emplace_back("a barrier names a resource that the graph does not have");
        continue;
      }
      const ResourceDecl& decl = graph_.resources[barrier.resource];
      const bool texture = std::holds_alternative<TextureDesc>(decl.desc);
      if (texture == (barrier.newLayout == VK_IMAGE_LAYOUT_UNDEFINED))
        fault(decl, "has a barrier with the wrong new layout");
      if (barrier.reason == BarrierReason::Retire && barrier.oldLayout != barrier.newLayout) {
        fault(decl, "changes its layout in a Retire barrier");
      }
    }
  }

  void fault(const ResourceDecl& decl, const std::string& what) { faults_.push_back("'" + decl.name + "' " + what); }

  const GraphDesc& graph_;
  const Plan& plan_;
  std::vector<ResourceUses> uses_;
  std::vector<std::string> faults_;
};

}  // namespace

std::vector<std::string> structuralFaults(const GraphDesc& graph, const Plan& plan) {
  return Structure(graph, plan).run();
}

}  // namespace fg::check
