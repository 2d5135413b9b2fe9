#include "framegraph/verify/verify.h"

#include <algorithm>
#include <array>
#include <optional>

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
    for (const PassDecl& pass : graph.passes) {
      for (const AccessDecl& access : pass.accesses) {
        if (access.writeVersion != kNone) writes_.push_back(&access);
      }
    }
    for (std::uint32_t i = 0; i < graph.resources.size(); ++i) addCells(i);
    for (const HistoryDecl& history : graph.histories) {
      first_[1][history.previous] = first_[0][history.current];
      first_[0][history.previous] = first_[1][history.current];
    }
    findPeers();
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
    const bool swaps = heap != kNone && plan_.heaps[heap].partner != kNone;
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

  /// The bytes of an allocation that a resource uses in frames of one parity.
  struct Block {
    std::uint32_t resource;
    std::uint32_t firstCell;
    std::uint32_t allocation;
  };

  [[nodiscard]] std::vector<Block> blocks() const {
    std::vector<Block> result;
    for (std::uint32_t i = 0; i < plan_.resources.size(); ++i) {
      const std::uint32_t heap = plan_.resources[i].heap;
      if (heap == kNone || graph_.resources[i].lifetime == Lifetime::HistoryPrevious) continue;
      const std::uint32_t partner = plan_.heaps[heap].partner;
      result.push_back({i, first_[0][i], heap});
      if (partner != kNone) result.push_back({i, first_[1][i], partner});
    }
    return result;
  }

  void findPeers() {
    const std::vector<Block> all = blocks();
    const auto meet = [&](const Block& x, const Block& y) {
      const PlannedResource& a = plan_.resources[x.resource];
      const PlannedResource& b = plan_.resources[y.resource];
      return x.allocation == y.allocation && a.offset < b.offset + b.size && b.offset < a.offset + a.size;
    };
    for (const Block& block : all) {
      for (const Block& other : all) {
        if (block.firstCell == other.firstCell || !meet(block, other)) continue;
        for (std::uint32_t cell = 0; cell < cellCount(block.resource); ++cell) {
          for (std::uint32_t peer = 0; peer < cellCount(other.resource); ++peer) {
            device_.cell(block.firstCell + cell).peers.push_back(other.firstCell + peer);
          }
        }
      }
    }
  }

  /// The cells of a range. Mip levels and layers that the texture lacks are left out.
  [[nodiscard]] std::vector<std::uint32_t> cellsOf(std::uint32_t resource, const SubresourceRange& range) const {
    const TextureDesc* desc = texture(resource);
    if (desc == nullptr) return {firstCell(resource)};
    std::vector<std::uint32_t> cells;
    for (std::uint32_t mip = 0; mip < desc->mipLevels; ++mip) {
      for (std::uint32_t layer = 0; layer < desc->arrayLayers; ++layer) {
        if (mip < range.baseMip || mip - range.baseMip >= range.mipCount) continue;
        if (layer < range.baseLayer || layer - range.baseLayer >= range.layerCount) continue;
        cells.push_back(firstCell(resource) + mip * desc->arrayLayers + layer);
      }
    }
    return cells;
  }

  /// The contents of a cell at a version: those of the last write up to this version that covers the cell.
  [[nodiscard]] Contents contentsAt(std::uint32_t resource, std::uint32_t version, std::uint32_t cell) const {
    const ResourceDecl& decl = graph_.resources[resource];
    std::uint32_t made = 0;
    for (const AccessDecl* write : writes_) {
      if (write->resource != resource || write->writeVersion > version || write->writeVersion < made) continue;
      const std::vector<std::uint32_t> covered = cellsOf(resource, write->range);
      if (std::ranges::find(covered, cell) != covered.end()) {
        made = write->writeVersion;
      }
    }
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
    for (std::uint32_t i = 0; i < cellCount(resource); ++i) {
      Cell& cell = device_.cell(firstCell(resource) + i);
      putIntoState(cell, state, texture(resource) != nullptr);
      cell.contents = empty ? Contents{} : Contents{resource, 0, frame_};
    }
  }

  /// Put a cell into the state in which the host leaves it.
  static void putIntoState(Cell& cell, const ExternalState& state, bool isTexture) {
    const VkPipelineStageFlags2 stage = expanded(state.stage);
    const VkAccessFlags2 writes = writesOf(state.access);
    cell.layout = isTexture ? state.layout : VK_IMAGE_LAYOUT_UNDEFINED;
    cell.written = state.stage != VK_PIPELINE_STAGE_2_NONE;  // Otherwise the host has waited for everything.
    cell.available = writes == 0;
    cell.writeAccess = writes;
    cell.reads.clear();
    cell.visible.clear();
    cell.availableTo = VK_PIPELINE_STAGE_2_NONE;
    if (!cell.written) return;
    if (writes != 0) {
      cell.write = {stage, VK_PIPELINE_STAGE_2_NONE};
    } else {
      cell.write = {VK_PIPELINE_STAGE_2_NONE, stage};
      cell.availableTo = stage;
      cell.visible.push_back({stage, state.access});
      cell.reads.push_back({stage, VK_PIPELINE_STAGE_2_NONE});
    }
  }

  /// Do what the executor does with an invalid history: wait for its last use, clear it, and leave it in the planned
  /// state.
  void clear(std::uint32_t history) {
    if (!plan_.histories[history].used) return;
    const ExternalState& carry = plan_.histories[history].carry;
    const HistoryDecl& decl = graph_.histories[history];
    constexpr VkPipelineStageFlags2 kClear = VK_PIPELINE_STAGE_2_CLEAR_BIT;
    Dependency before{expanded(carry.stage),
                      carry.access,
                      kClear,
                      VK_ACCESS_2_TRANSFER_WRITE_BIT,
                      VK_IMAGE_LAYOUT_UNDEFINED,
                      VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                      cellsOf(decl.previous, {})};
    Dependency after{kClear,       VK_ACCESS_2_TRANSFER_WRITE_BIT,       expanded(carry.stage),
                     carry.access, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, carry.layout,
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
    for (const PlannedBarrier& barrier : barriers) {
      batch.push_back({expanded(barrier.srcStage), barrier.srcAccess, expanded(barrier.dstStage), barrier.dstAccess,
                       barrier.oldLayout, barrier.newLayout, cellsOf(barrier.resource, barrier.range)});
    }
    device_.barrier(batch);
    // Buffers have no layout transition. The first write of a new owner is checked in their case (Device::access).
  }

  void touch(const AccessDecl& access) {
    const Use use = useOf(access.access, texture(access.resource) != nullptr);
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
  /// names; and it is readable if the state only reads.
  void checkReturnedImport(std::uint32_t index, const ExternalState& state, bool isTexture) {
    const Cell cell = device_.cell(index);
    const bool anyLayout = isTexture && state.layout == VK_IMAGE_LAYOUT_UNDEFINED;
    const VkImageLayout layout = anyLayout ? cell.layout : isTexture ? state.layout : VK_IMAGE_LAYOUT_UNDEFINED;
    const auto wrong = [&] {
      device_.complain("import '" + cell.name + "' is not returned in the state in which it arrived");
    };
    if (cell.layout != layout) return wrong();
    if (state.stage == VK_PIPELINE_STAGE_2_NONE) return;
    device_.checkFinished(index, state.stage);
    if (writesOf(state.access) == VK_ACCESS_2_NONE) {
      device_.access(index, {state.stage, state.access, VK_ACCESS_2_NONE, layout, 0}, cell.contents, cell.contents);
    } else if (cell.written && (cell.writeAccess & ~state.access) != VK_ACCESS_2_NONE) {
      if (!cell.available || (cell.availableTo & expanded(state.stage)) == VK_PIPELINE_STAGE_2_NONE) wrong();
    }
  }

  void checkExport(std::uint32_t resource, const ExportDecl& exported) {
    const ExternalState& state = exported.release;
    const bool isTexture = texture(resource) != nullptr;
    for (std::uint32_t i = 0; i < cellCount(resource); ++i) {
      const std::uint32_t index = firstCell(resource) + i;
      Cell& cell = device_.cell(index);
      const Contents expected = contentsAt(resource, exported.resource.version, index);
      if (cell.contents != expected) device_.complain("export '" + cell.name + "' does not hold what was declared");
      const VkImageLayout layout = isTexture ? state.layout : VK_IMAGE_LAYOUT_UNDEFINED;
      if (state.stage == VK_PIPELINE_STAGE_2_NONE) {
        if (cell.layout != layout) device_.complain("export '" + cell.name + "' is not in the declared layout");
        continue;
      }
      device_.checkFinished(index, state.stage);
      const VkAccessFlags2 writes = writesOf(state.access);
      device_.access(index, {state.stage, state.access & ~writes, writes, layout, 0}, expected, expected);
    }
  }

  const GraphDesc& graph_;
  const Plan& plan_;
  std::vector<const ExportDecl*> exports_;
  std::vector<const AccessDecl*> writes_;
  Device device_;
  /// Indexed by frame parity and resource: the first cell.
  std::array<std::vector<std::uint32_t>, 2> first_;
  std::uint32_t frame_ = 0;
};

}  // namespace

std::vector<std::string> verify(const GraphDesc& graph, const Plan& plan) {
  std::vector<std::string> faults = structuralFaults(graph, plan);
  return faults.empty() ? Replay(graph, plan).run() : faults;
}

}  // namespace fg
