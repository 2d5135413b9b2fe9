#include "framegraph/verify/verify.h"

#include <algorithm>
#include <array>

#include "framegraph/verify/verify_device.h"
#include "framegraph/verify/verify_structure.h"

namespace fg {
namespace {

using namespace check;

constexpr std::uint32_t kFrames = 5;
/// Version that marks the contents of a cleared history.
constexpr std::uint32_t kCleared = kNone;

bool resetsHistories(std::uint32_t frame) {
  return frame == 0 || frame == 3;
}

class Replay {
 public:
  Replay(const GraphDesc& graph, const Plan& plan) : graph_(graph), plan_(plan), exports_(graph.resources.size()) {
    for (const ExportDecl& exported : graph.exports) exports_[exported.resource.resource] = &exported;
    for (std::uint32_t i = 0; i < graph.resources.size(); ++i) addCells(i);
    for (const HistoryDecl& history : graph.histories) {
      first_[1][history.previous] = first_[0][history.current];
      first_[0][history.previous] = first_[1][history.current];
    }
    placeBlocks();
    listWrites();
  }

  std::vector<std::string> run() {
    for (frame_ = 0; frame_ < kFrames; ++frame_) {
      device_.setPlace(at("start"));
      for (std::uint32_t i = 0; i < graph_.resources.size(); ++i) begin(i);
      for (const PlannedPass& planned : plan_.passes) {
        device_.setPlace(at("pass '" + graph_.passes[planned.pass].name + "'"));
        record(planned.barriers);
        for (const AccessDecl& access : graph_.passes[planned.pass].accesses) touch(access);
      }
      device_.setPlace(at("end"));
      record(plan_.releases);
      listReleased();
      for (std::uint32_t i = 0; i < graph_.resources.size(); ++i) end(i);
    }
    return device_.takeComplaints();
  }

 private:
  [[nodiscard]] std::string at(const std::string& place) const {
    return "frame " + std::to_string(frame_) + ", " + place;
  }

  [[nodiscard]] const TextureDesc* texture(std::uint32_t resource) const {
    return std::get_if<TextureDesc>(&graph_.resources[resource].desc);
  }
  [[nodiscard]] std::uint32_t layers(std::uint32_t resource) const {
    return texture(resource) != nullptr ? texture(resource)->arrayLayers : 1;
  }
  [[nodiscard]] std::uint32_t cellCount(std::uint32_t resource) const {
    return texture(resource) != nullptr ? texture(resource)->mipLevels * layers(resource) : 1;
  }
  /// First cell of the physical image or buffer that the resource uses in this frame.
  [[nodiscard]] std::uint32_t firstCell(std::uint32_t resource) const { return first_[frame_ % 2][resource]; }

  /// True if even and odd frames use different images or buffers for the resource.
  [[nodiscard]] bool isDoubled(std::uint32_t resource) const {
    const std::uint32_t heap = plan_.resources[resource].heap;
    const bool swaps = heap < plan_.heaps.size() && plan_.heaps[heap].partner != kNone;
    return swaps || graph_.resources[resource].lifetime == Lifetime::HistoryCurrent;
  }

  void addCells(std::uint32_t resource) {
    for (auto& first : first_) {
      if (&first == first_.data() || isDoubled(resource)) {
        first.push_back(static_cast<std::uint32_t>(device_.cellCount()));
        for (std::uint32_t i = 0; i < cellCount(resource); ++i) {
          Cell cell;
          cell.name = graph_.resources[resource].name + (cellCount(resource) > 1 ? "[" + std::to_string(i) + "]" : "");
          device_.add(std::move(cell));
        }
      } else {
        first.push_back(first_[0].back());
      }
    }
  }

  /// Tell the device which images and buffers lie in shared memory. The images of a history are listed as `current`.
  void placeBlocks() {
    for (std::uint32_t i = 0; i < plan_.resources.size(); ++i) {
      const PlannedResource& planned = plan_.resources[i];
      if (planned.heap == kNone || planned.size == 0) continue;
      if (graph_.resources[i].lifetime == Lifetime::HistoryPrevious) continue;
      const std::uint64_t end = planned.offset + planned.size;
      const std::uint32_t partner = plan_.heaps[planned.heap].partner;
      device_.place({planned.heap, planned.offset, end, first_[0][i], cellCount(i)});
      if (partner != kNone) device_.place({partner, planned.offset, end, first_[1][i], cellCount(i)});
    }
  }

  /// List the versions that write each cell, in ascending order. Cells are those of even frames.
  void listWrites() {
    versions_.resize(device_.cellCount());
    for (const PassDecl& pass : graph_.passes) {
      for (const AccessDecl& access : pass.accesses) {
        if (access.writeVersion == kNone) continue;
        for (const std::uint32_t cell : cellsOf(access.resource, access.range)) {
          versions_[cell].push_back(access.writeVersion);
        }
      }
    }
    for (std::vector<std::uint32_t>& versions : versions_) std::ranges::sort(versions);
  }

  /// The cells of a range. Mip levels and layers that the texture lacks are left out.
  [[nodiscard]] std::vector<std::uint32_t> cellsOf(std::uint32_t resource, const SubresourceRange& range) const {
    const TextureDesc* desc = texture(resource);
    if (desc == nullptr) return {firstCell(resource)};
    std::vector<std::uint32_t> cells;
    const auto end = [](std::uint32_t base, std::uint32_t count, std::uint32_t size) {
      return base < size ? base + std::min(count, size - base) : base;
    };
    for (std::uint32_t mip = range.baseMip; mip < end(range.baseMip, range.mipCount, desc->mipLevels); ++mip) {
      const std::uint32_t layers = end(range.baseLayer, range.layerCount, desc->arrayLayers);
      for (std::uint32_t layer = range.baseLayer; layer < layers; ++layer) {
        cells.push_back(firstCell(resource) + mip * desc->arrayLayers + layer);
      }
    }
    return cells;
  }

  /// The contents of a cell at a version: those of the last write up to this version that covers the cell.
  [[nodiscard]] Contents contentsAt(std::uint32_t resource, std::uint32_t version, std::uint32_t cell) const {
    const ResourceDecl& decl = graph_.resources[resource];
    const std::vector<std::uint32_t>& versions = versions_[cell - firstCell(resource) + first_[0][resource]];
    const auto later = std::ranges::upper_bound(versions, version);
    const std::uint32_t made = later == versions.begin() ? 0 : *std::prev(later);
    if (made != 0 || decl.lifetime != Lifetime::HistoryPrevious) return {resource, made, frame_};
    const std::uint32_t current = graph_.histories[decl.history].current;
    if (resetsHistories(frame_)) return {current, kCleared, frame_};
    return {current, graph_.resources[current].versions, frame_ - 1};
  }

  void begin(std::uint32_t resource) {
    const ResourceDecl& decl = graph_.resources[resource];
    if (decl.lifetime == Lifetime::HistoryPrevious && resetsHistories(frame_)) return clear(decl.history);
    const bool host = decl.lifetime == Lifetime::Imported || decl.lifetime == Lifetime::Upload;
    if (!host) return;
    const ExternalState state = decl.acquire.value_or(ExternalState{});
    const bool empty = texture(resource) != nullptr && state.layout == VK_IMAGE_LAYOUT_UNDEFINED;
    const Use use = hostUse(state, texture(resource) != nullptr);
    for (std::uint32_t i = 0; i < cellCount(resource); ++i) {
      const std::uint32_t index = firstCell(resource) + i;
      device_.putIntoState(index, use);
      device_.cell(index).contents = empty ? Contents{} : Contents{resource, 0, frame_};
    }
  }

  /// The host's use of a resource in a state.
  static Use hostUse(const ExternalState& state, bool isTexture) {
    const VkAccessFlags2 access = expandedAccess(state.access);
    return {expanded(state.stage), access & ~writesOf(access), writesOf(access),
            isTexture ? state.layout : VK_IMAGE_LAYOUT_UNDEFINED, 0};
  }

  /// Do what the executor does with an invalid history: wait for its last use, clear it, and leave it in the planned
  /// state.
  void clear(std::uint32_t history) {
    if (!plan_.histories[history].used) return;
    const ExternalState& carry = plan_.histories[history].carry;
    const HistoryDecl& decl = graph_.histories[history];
    constexpr VkPipelineStageFlags2 kClear = VK_PIPELINE_STAGE_2_CLEAR_BIT;
    Dependency before{
        expanded(carry.stage),          expandedAccess(carry.access), kClear,
        VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_IMAGE_LAYOUT_UNDEFINED,    VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
        cellsOf(decl.previous, {})};
    Dependency after{kClear,           VK_ACCESS_2_TRANSFER_WRITE_BIT,       before.srcStage,
                     before.srcAccess, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, carry.layout,
                     before.cells};
    device_.barrier({before});
    const Use use{kClear, VK_ACCESS_2_NONE, VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 0};
    for (const std::uint32_t cell : before.cells) {
      device_.access(cell, use, {}, {decl.current, kCleared, frame_});
    }
    device_.barrier({after});
  }

  void record(const std::vector<PlannedBarrier>& barriers) {
    std::vector<Dependency> batch;
    batch.reserve(barriers.size());
    for (const PlannedBarrier& barrier : barriers) {
      batch.push_back({expanded(barrier.srcStage), expandedAccess(barrier.srcAccess), expanded(barrier.dstStage),
                       expandedAccess(barrier.dstAccess), barrier.oldLayout, barrier.newLayout,
                       cellsOf(barrier.resource, barrier.range)});
    }
    device_.barrier(batch);
    // Buffers have no layout transition. The first write of a new owner is checked in their case (Device::access).
  }

  /// List the cells whose layout the releases of this frame change.
  void listReleased() {
    released_.assign(device_.cellCount(), false);
    for (const PlannedBarrier& barrier : plan_.releases) {
      if (barrier.oldLayout == barrier.newLayout) continue;
      for (const std::uint32_t cell : cellsOf(barrier.resource, barrier.range)) released_[cell] = true;
    }
  }

  void touch(const AccessDecl& access) {
    Use use = useOf(access.access, texture(access.resource) != nullptr);
    use.stage = expanded(use.stage);
    for (const std::uint32_t cell : cellsOf(access.resource, access.range)) {
      const Contents expected =
          access.readVersion != kNone ? contentsAt(access.resource, access.readVersion, cell) : Contents{};
      device_.access(cell, use, expected, {access.resource, access.writeVersion, frame_});
    }
  }

  void end(std::uint32_t resource) {
    const ResourceDecl& decl = graph_.resources[resource];
    if (const ExportDecl* exported = exports_[resource]) return checkExport(resource, *exported);
    if (decl.lifetime != Lifetime::Imported) return;
    const ExternalState& state = *decl.acquire;
    const bool isTexture = texture(resource) != nullptr;
    for (std::uint32_t i = 0; i < cellCount(resource); ++i)
      checkReturnedImport(firstCell(resource) + i, state, isTexture);
  }

  /// Check that an import is back in the state in which it arrived: it has the same layout, unless that was UNDEFINED;
  /// all accesses happen in or before the stages of the state; all writes are available, except those that the state
  /// names. If the state only reads, or a release has changed the layout, the host can use the import at once.
  void checkReturnedImport(std::uint32_t index, const ExternalState& state, bool isTexture) {
    const Cell& cell = device_.cell(index);
    Use use = hostUse(state, isTexture);
    if (isTexture && state.layout == VK_IMAGE_LAYOUT_UNDEFINED) use.layout = cell.layout;
    const auto wrong = [&] {
      device_.complain("import '" + cell.name + "' is not returned in the state in which it arrived");
    };
    if (cell.layout != use.layout) return wrong();
    if (use.stage == VK_PIPELINE_STAGE_2_NONE) return;
    device_.checkFinished(index, use.stage);
    if (use.writes == VK_ACCESS_2_NONE || released_[index]) {
      const Contents contents = cell.contents;
      device_.access(index, use, contents, contents);
    } else if ((cell.writeAccess & ~(use.reads | use.writes)) != VK_ACCESS_2_NONE) {
      if (!device_.findsAvailable(use.stage, cell)) wrong();
    }
  }

  void checkExport(std::uint32_t resource, const ExportDecl& exported) {
    const ExternalState& state = exported.release;
    const Use use = hostUse(state, texture(resource) != nullptr);
    for (std::uint32_t i = 0; i < cellCount(resource); ++i) {
      const std::uint32_t index = firstCell(resource) + i;
      const Cell& cell = device_.cell(index);
      const Contents expected = contentsAt(resource, exported.resource.version, index);
      if (cell.contents != expected) device_.complain("export '" + cell.name + "' does not hold what was declared");
      if (use.stage == VK_PIPELINE_STAGE_2_NONE) {
        if (cell.layout != use.layout) device_.complain("export '" + cell.name + "' is not in the declared layout");
        continue;
      }
      device_.checkFinished(index, use.stage);
      device_.access(index, use, expected, expected);
    }
  }

  const GraphDesc& graph_;
  const Plan& plan_;
  std::vector<const ExportDecl*> exports_;
  std::vector<std::vector<std::uint32_t>> versions_;  ///< By cell: the versions that write it.
  Device device_;
  /// Indexed by frame parity and resource: the first cell.
  std::array<std::vector<std::uint32_t>, 2> first_;
  std::uint32_t frame_ = 0;
  std::vector<bool> released_;  ///< By cell: a release of this frame changes its layout.
};

}  // namespace

std::vector<std::string> verify(const GraphDesc& graph, const Plan& plan) {
  std::vector<std::string> faults = structuralFaults(graph, plan);
  return faults.empty() ? Replay(graph, plan).run() : faults;
}

}  // namespace fg
