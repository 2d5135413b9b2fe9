#include "tests/framegraph/dependency_chains.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <set>

#include "framegraph/verify/verify_rules.h"

namespace fg::test {
namespace {

using Stages = VkPipelineStageFlags2;
using Accesses = VkAccessFlags2;

/// Histories swap roles every frame. They are cleared before frames without a valid previous frame.
constexpr std::uint32_t kFrames = 4;
constexpr std::array kCleared = {true, false, false, true};

/// One dependency of a batch. The dependencies of one batch have the same time and do not order each other.
struct Dependency {
  Stages srcStage = 0;
  Accesses srcAccess = 0;
  Stages dstStage = 0;
  Accesses dstAccess = 0;
  bool transition = false;
  std::vector<std::uint32_t> cells;
};

/// An access to one cell, or a layout transition of it, at one time. A cell is one mip level and layer of one physical
/// image, or one buffer.
struct Operation {
  std::size_t time = 0;
  std::uint32_t cell = 0;
  Stages stage = 0;  ///< None for a layout transition, which has no stage.
  Accesses reads = 0;
  Accesses writes = 0;
  std::optional<Dependency> transition;  ///< The transition; also used for imports in a readable state.
  std::string name;

  [[nodiscard]] bool changes() const { return writes != 0 || transition.has_value(); }
};

bool overlap(const PlannedResource& a, const PlannedResource& b) {
  return a.offset < b.offset + b.size && b.offset < a.offset + a.size;
}

/// The allocation in which a resource lies in frames of one parity; kNone if it has memory of its own.
std::uint32_t allocation(const Plan& plan, std::uint32_t resource, std::uint32_t parity) {
  const std::uint32_t heap = plan.resources[resource].heap;
  if (heap == kNone) return kNone;
  return parity == 1 && plan.heaps[heap].partner != kNone ? plan.heaps[heap].partner : heap;
}

/// All operations and dependencies of a few frames, in submission order.
class Timeline {
 public:
  Timeline(const GraphDesc& graph, const Plan& plan) : graph_(graph), plan_(plan) {
    for (std::uint32_t i = 0; i < graph.resources.size(); ++i) {
      const bool doubled =
          graph.resources[i].lifetime == Lifetime::HistoryCurrent || allocation(plan, i, 0) != allocation(plan, i, 1);
      first_[0].push_back(cells_);
      cells_ += cellCount(i);
      first_[1].push_back(doubled ? cells_ : first_[0].back());
      if (doubled) cells_ += cellCount(i);
    }
    for (const HistoryDecl& history : graph.histories) {
      first_[1][history.previous] = first_[0][history.current];
      first_[0][history.previous] = first_[1][history.current];
    }
    findPeers();
    since_.resize(cells_);
    operationsOf_.resize(cells_);
    for (frame_ = 0; frame_ < kFrames; ++frame_) runFrame();
  }

  std::vector<std::string> takeFaults() { return std::move(faults_); }

 private:
  /// Find the peers of every cell: those that share a byte of an allocation with it, in frames of either parity.
  void findPeers() {
    peers_.resize(cells_);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> all;  // Resources and parities.
    for (std::uint32_t i = 0; i < graph_.resources.size(); ++i) {
      all.emplace_back(i, 0);
      if (first_[0][i] != first_[1][i]) all.emplace_back(i, 1);
    }
    for (const auto& [i, parity] : all) {
      for (const auto& [j, otherParity] : all) {
        const std::uint32_t place = allocation(plan_, i, parity);
        if (place == kNone || place != allocation(plan_, j, otherParity)) continue;
        const std::uint32_t own = first_[parity][i];
        const std::uint32_t other = first_[otherParity][j];
        if (own == other || !overlap(plan_.resources[i], plan_.resources[j])) continue;
        for (std::uint32_t a = 0; a < cellCount(i); ++a) {
          for (std::uint32_t b = 0; b < cellCount(j); ++b) addPeer(own + a, other + b);
        }
      }
    }
  }

  /// Add a peer once: images of a history are listed both as `previous` and as `current`.
  void addPeer(std::uint32_t cell, std::uint32_t peer) {
    std::vector<std::uint32_t>& peers = peers_[cell];
    if (std::ranges::find(peers, peer) == peers.end()) peers.push_back(peer);
  }

  [[nodiscard]] const TextureDesc* texture(std::uint32_t resource) const {
    return std::get_if<TextureDesc>(&graph_.resources[resource].desc);
  }
  [[nodiscard]] std::uint32_t cellCount(std::uint32_t resource) const {
    return texture(resource) == nullptr ? 1 : texture(resource)->mipLevels * texture(resource)->arrayLayers;
  }
  [[nodiscard]] std::vector<std::uint32_t> cellsOf(std::uint32_t resource, const SubresourceRange& range) const {
    const std::uint32_t first = first_[frame_ % 2][resource];
    if (texture(resource) == nullptr) return {first};
    std::vector<std::uint32_t> cells;
    for (std::uint32_t i = 0; i < cellCount(resource); ++i) {
      const std::uint32_t mip = i / texture(resource)->arrayLayers;
      const std::uint32_t layer = i % texture(resource)->arrayLayers;
      if (mip >= range.baseMip && mip - range.baseMip < range.mipCount && layer >= range.baseLayer &&
          layer - range.baseLayer < range.layerCount) {
        cells.push_back(first + i);
      }
    }
    return cells;
  }

  void runFrame() {
    for (std::uint32_t i = 0; i < graph_.resources.size(); ++i) begin(i);
    for (const PlannedPass& planned : plan_.passes) {
      batch(planned.barriers);
      for (const AccessDecl& access : graph_.passes[planned.pass].accesses) {
        if (graph_.resources[access.resource].lifetime == Lifetime::Upload) continue;
        const check::Use use = check::useOf(access.access, texture(access.resource) != nullptr);
        operate(cellsOf(access.resource, access.range), {check::expanded(use.stage), use.reads, use.writes},
                graph_.passes[planned.pass].name + " on " + graph_.resources[access.resource].name);
      }
      ++time_;
    }
    batch(plan_.releases);
    for (std::uint32_t i = 0; i < graph_.resources.size(); ++i) end(i);
    ++time_;
  }

  struct Touch {
    Stages stage;
    Accesses reads;
    Accesses writes;
  };

  void operate(const std::vector<std::uint32_t>& cells, const Touch& touch, const std::string& name) {
    for (const std::uint32_t cell : cells) {
      add({time_, cell, touch.stage, touch.reads, touch.writes, std::nullopt,
           "frame " + std::to_string(frame_) + " " + name});
    }
  }

  void batch(const std::vector<PlannedBarrier>& barriers) {
    std::vector<Dependency> dependencies;
    for (const PlannedBarrier& barrier : barriers) {
      dependencies.push_back({check::expanded(barrier.srcStage), check::expandedAccess(barrier.srcAccess),
                              check::expanded(barrier.dstStage), check::expandedAccess(barrier.dstAccess),
                              barrier.oldLayout != barrier.newLayout, cellsOf(barrier.resource, barrier.range)});
    }
    batch(std::move(dependencies));
  }

  void batch(std::vector<Dependency> dependencies) {
    batches_.resize(time_ + 1);
    batches_[time_] = std::move(dependencies);
    const std::vector<Dependency> now = batches_[time_];
    for (const Dependency& dependency : now) {
      if (!dependency.transition) continue;
      for (const std::uint32_t cell : dependency.cells) {
        add({time_, cell, 0, 0, 0, dependency, "frame " + std::to_string(frame_) + " transition"});
      }
    }
    ++time_;
  }

  void begin(std::uint32_t resource) {
    const ResourceDecl& decl = graph_.resources[resource];
    if (decl.lifetime == Lifetime::HistoryPrevious && kCleared[frame_] && plan_.histories[decl.history].used) {
      return clear(resource, plan_.histories[decl.history].carry);
    }
    if (decl.lifetime != Lifetime::Imported) return;
    const ExternalState& state = *decl.acquire;
    const Stages stage = check::expanded(state.stage);
    const Accesses access = check::expandedAccess(state.access);
    const Accesses writes = check::writesOf(access);
    for (const std::uint32_t cell : cellsOf(resource, {})) {
      since_[cell] = time_;  // Earlier accesses do not count: the host has ordered them.
      if (stage == VK_PIPELINE_STAGE_2_NONE) continue;
      Operation operation{time_, cell, stage, access & ~writes, writes, std::nullopt, "host on " + decl.name};
      if (writes == 0) {
        Operation readable = operation;
        readable.stage = 0;
        readable.reads = 0;
        readable.transition = Dependency{0, 0, stage, access, true, {cell}};
        operations_.push_back(readable);
        operationsOf_[cell].push_back(operations_.size() - 1);
      }
      operations_.push_back(operation);
      operationsOf_[cell].push_back(operations_.size() - 1);
    }
    ++time_;
  }

  void clear(std::uint32_t previous, const ExternalState& carry) {
    const std::vector<std::uint32_t> cells = cellsOf(previous, {});
    const Stages stage = check::expanded(carry.stage);
    const Accesses access = check::expandedAccess(carry.access);
    constexpr Stages kClear = VK_PIPELINE_STAGE_2_CLEAR_BIT;
    constexpr Accesses kWrite = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    batch(std::vector<Dependency>{{stage, access, kClear, kWrite, true, cells}});
    operate(cells, {kClear, 0, kWrite}, "clear");
    ++time_;
    batch(std::vector<Dependency>{{kClear, kWrite, stage, access, true, cells}});
  }

  void end(std::uint32_t resource) {
    const ResourceDecl& decl = graph_.resources[resource];
    const auto exported =
        std::ranges::find(graph_.exports, resource, [](const ExportDecl& e) { return e.resource.resource; });
    const bool isExport = exported != graph_.exports.end();
    if (!isExport && decl.lifetime != Lifetime::Imported) return;
    const ExternalState& state = isExport ? exported->release : *decl.acquire;
    if (state.stage == VK_PIPELINE_STAGE_2_NONE) return;
    if (!isExport && texture(resource) != nullptr && state.layout == VK_IMAGE_LAYOUT_UNDEFINED) return;
    const Stages stage = check::expanded(state.stage);
    const Accesses access = check::expandedAccess(state.access);
    const Accesses writes = check::writesOf(access);
    for (const std::uint32_t cell : cellsOf(resource, {})) {
      for (const std::size_t before : operationsOf_[cell]) {
        if (operations_[before].time >= since_[cell] && !precedes(operations_[before], stage, time_)) {
          fault(operations_[before], "the host that takes " + decl.name);
        }
      }
      if (isExport || writes == 0 || isReleased(cell)) {
        add({time_, cell, stage, access & ~writes, writes, std::nullopt, "host on " + decl.name});
      } else {
        checkPending(cell, access, decl.name);
      }
    }
  }

  /// True if a release of this frame has changed the layout of the cell.
  [[nodiscard]] bool isReleased(std::uint32_t cell) const {
    const Operation* change = lastChange(cell);
    return change != nullptr && change->transition && change->time == time_ - 1;
  }

  /// An import that returns to the state in which it arrived may have unavailable writes, if the state names them.
  void checkPending(std::uint32_t cell, Accesses access, const std::string& name) {
    const Operation* write = lastChange(cell);
    if (write == nullptr || write->writes == 0 || (write->writes & ~access) == 0) return;
    if (afterAvailable(*write, time_) == 0) fault(*write, "the host that gets back " + name);
  }

  [[nodiscard]] const Operation* lastChange(std::uint32_t cell) const {
    for (auto index = operationsOf_[cell].rbegin(); index != operationsOf_[cell].rend(); ++index) {
      const Operation& operation = operations_[*index];
      if (operation.time < since_[cell]) return nullptr;
      if (operation.changes()) return &operation;
    }
    return nullptr;
  }

  static bool covers(const Dependency& dependency, std::uint32_t cell) {
    return std::ranges::find(dependency.cells, cell) != dependency.cells.end();
  }

  /// Follow the dependencies between two times. Vulkan also executes the layout transitions of a queue in their order;
  /// a plan must not depend on it.
  /// @param reached stages of the work that is ordered after the first operation
  /// @param direct true for dependencies that wait for the first operation itself
  /// @return stages of the later work that is ordered after the first operation
  template <typename Direct>
  [[nodiscard]] Stages follow(std::size_t begin, std::size_t end, Stages reached, Direct direct) const {
    for (std::size_t time = begin; time < end && time < batches_.size(); ++time) {
      Stages next = reached;
      for (const Dependency& dependency : batches_[time]) {
        if ((reached & dependency.srcStage) != 0 || direct(dependency)) next |= dependency.dstStage;
      }
      reached = next;
    }
    return reached;
  }

  /// Stages of the work that is ordered after one stage of an operation.
  [[nodiscard]] Stages after(const Operation& operation, Stages bit, std::size_t until) const {
    const std::size_t begin = operation.time + 1;
    if (operation.transition) {
      return follow(begin, until, operation.transition->dstStage, [](const Dependency&) { return false; });
    }
    return follow(begin, until, 0, [&](const Dependency& d) { return (d.srcStage & bit) != 0; });
  }

  /// Stages of the work that is ordered after a write has become available; none if it has not.
  [[nodiscard]] Stages afterAvailable(const Operation& write, std::size_t until) const {
    if (write.transition) return after(write, 0, until);
    return follow(write.time + 1, until, 0, [&](const Dependency& d) { return makesAvailable(d, write); });
  }

  template <typename Check>
  static bool forEachBit(Stages stages, Check check) {
    if (stages == 0) return check(Stages{0});
    for (; stages != 0; stages &= stages - 1) {
      if (!check(stages & ~(stages - 1))) return false;
    }
    return true;
  }

  /// True if work that waits for any of these stages, at this time, comes after the operation.
  [[nodiscard]] bool precedes(const Operation& operation, Stages stages, std::size_t time) const {
    return forEachBit(operation.stage,
                      [&](Stages bit) { return (bit & stages) != 0 || (after(operation, bit, time) & stages) != 0; });
  }

  /// True if a chain of dependencies leads from one operation to another.
  [[nodiscard]] bool ordered(const Operation& first, const Operation& second) const {
    return forEachBit(first.stage, [&](Stages bit) {
      const Stages reached = after(first, bit, second.time);
      if (!second.transition) return (second.stage & ~reached) == 0;
      return ((reached | bit) & second.transition->srcStage) != 0;
    });
  }

  static bool makesAvailable(const Dependency& dependency, const Operation& write) {
    return covers(dependency, write.cell) && (write.stage & ~dependency.srcStage) == 0 &&
           (write.writes & ~dependency.srcAccess) == 0;
  }

  /// True if a write is visible to an access.
  /// @param wanted the access flags of the reading or of the writing part
  [[nodiscard]] bool visible(const Operation& write, const Operation& access, Accesses wanted) const {
    if (wanted == 0) return true;
    return forEachBit(access.stage, [&](Stages bit) {
      const auto publishes = [&](const Dependency& d) {
        return (d.dstStage & bit) != 0 && (wanted & ~d.dstAccess) == 0;
      };
      if (write.transition && publishes(*write.transition)) return true;
      for (std::size_t time = write.time + 1; time < access.time && time < batches_.size(); ++time) {
        const Stages available = afterAvailable(write, time);
        for (const Dependency& dependency : batches_[time]) {
          if (!covers(dependency, write.cell) || !publishes(dependency)) continue;
          if ((available & dependency.srcStage) != 0) return true;
          if (!write.transition && makesAvailable(dependency, write)) return true;
        }
      }
      return false;
    });
  }

  void add(Operation operation) {
    const std::uint32_t cell = operation.cell;
    checkAgainst(cell, operation);
    if (operation.changes()) {
      for (const std::uint32_t peer : peers_[cell]) checkAgainst(peer, operation);
    }
    operations_.push_back(std::move(operation));
    operationsOf_[cell].push_back(operations_.size() - 1);
  }

  void checkAgainst(std::uint32_t cell, const Operation& operation) {
    for (const std::size_t index : operationsOf_[cell]) {
      const Operation& before = operations_[index];
      if (before.time < since_[cell] || before.time == operation.time) continue;
      if ((before.changes() || operation.changes()) && !ordered(before, operation)) fault(before, operation.name);
    }
    const Operation* write = lastChange(cell);
    if (write == nullptr || write->time == operation.time) return;
    const bool sameImage = cell == operation.cell;
    bool safe = true;
    if (operation.transition) {
      safe = (afterAvailable(*write, operation.time) & operation.transition->srcStage) != 0 ||
             (sameImage && makesAvailable(*operation.transition, *write));
    } else if (sameImage) {
      safe = visible(*write, operation, operation.reads) && visible(*write, operation, operation.writes);
    } else {
      safe = (operation.stage & ~afterAvailable(*write, operation.time)) == 0;
    }
    if (!safe) fault(*write, operation.name);
  }

  void fault(const Operation& before, const std::string& after) {
    faults_.push_back("nothing orders " + before.name + " before " + after);
  }

  const GraphDesc& graph_;
  const Plan& plan_;
  std::array<std::vector<std::uint32_t>, 2> first_;  ///< Indexed by frame parity and resource: the first cell.
  std::uint32_t cells_ = 0;
  std::vector<std::vector<std::uint32_t>> peers_;
  std::vector<std::size_t> since_;                ///< Indexed by cell: the time since which the graph owns it.
  std::vector<std::vector<Dependency>> batches_;  ///< Indexed by time.
  std::vector<Operation> operations_;
  std::vector<std::vector<std::size_t>> operationsOf_;  ///< Indexed by cell.
  std::uint32_t frame_ = 0;
  std::size_t time_ = 0;
  std::vector<std::string> faults_;
};

}  // namespace

std::vector<std::string> unorderedAccesses(const GraphDesc& graph, const Plan& plan) {
  return Timeline(graph, plan).takeFaults();
}

}  // namespace fg::test
