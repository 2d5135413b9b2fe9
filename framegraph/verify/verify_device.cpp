#include "framegraph/verify/verify_device.h"

#include <algorithm>

namespace fg::check {
namespace {

bool isTransition(const Dependency& dependency) {
  return dependency.oldLayout != dependency.newLayout;
}

}  // namespace

void Device::complain(const std::string& what) {
  complaints_.push_back(place_ + ": " + what);
}

void Device::place(const Block& block) {
  const std::uint32_t index = memory_.add(block);
  for (std::uint32_t i = 0; i < block.cellCount; ++i) cells_[block.firstCell + i].block = index;
}

void Device::putIntoState(std::uint32_t index, const Use& use) {
  Cell& cell = cells_[index];
  cell.layout = use.layout;
  cell.written = use.stage != VK_PIPELINE_STAGE_2_NONE;  // Otherwise the host has waited for everything.
  cell.available = use.writes == VK_ACCESS_2_NONE;
  cell.writeAccess = use.writes;
  cell.reads.clear();
  cell.visible.clear();
  if (!cell.written) return;
  if (!cell.available) {
    cell.write = order_.add({use.stage, VK_PIPELINE_STAGE_2_NONE});
    return;
  }
  cell.write = cell.availability = order_.add({VK_PIPELINE_STAGE_2_NONE, use.stage});
  cell.visible.push_back({use.stage, use.reads});
  cell.reads.push_back(order_.add({use.stage, VK_PIPELINE_STAGE_2_NONE}));
}

bool Device::findsAvailable(VkPipelineStageFlags2 srcStage, const Cell& cell) const {
  return !cell.written || (cell.available && waitsFor(srcStage, at(cell.availability)));
}

bool Device::makesAvailable(const Dependency& dependency, const Cell& cell) const {
  return cell.written && !cell.available && (at(cell.write).stage & ~dependency.srcStage) == 0 &&
         (cell.writeAccess & ~dependency.srcAccess) == 0;
}

std::vector<std::uint32_t> Device::peers(const Cell& cell) const {
  std::vector<std::uint32_t> result;
  if (cell.block == kNone) return result;
  for (const std::uint32_t other : memory_.others(cell.block)) {
    const Block& block = memory_.block(other);
    for (std::uint32_t i = 0; i < block.cellCount; ++i) result.push_back(block.firstCell + i);
  }
  return result;
}

void Device::takeBytes(std::uint32_t index, const std::vector<std::uint32_t>& peers) {
  for (const std::uint32_t peer : peers) cells_[peer].contents = {};
  if (cells_[index].block != kNone) memory_.change(cells_[index].block, index, time_);
}

void Device::barrier(const std::vector<Dependency>& batch) {
  ++time_;
  // All scopes refer to the state before the batch.
  const std::vector<Publication> published = publications(batch);
  for (const Dependency& dependency : batch) {
    for (const std::uint32_t index : dependency.cells) {
      if (isTransition(dependency)) checkTransition(dependency, index);
    }
  }
  std::vector<ExecutionDependency> execution;
  for (const Dependency& dependency : batch) execution.push_back({dependency.srcStage, dependency.dstStage});
  order_.barrier(std::move(execution));
  for (const Publication& publication : published) publish(publication);
  for (const Dependency& dependency : batch) {
    for (const std::uint32_t index : dependency.cells) {
      if (isTransition(dependency)) transition(dependency, index);
    }
  }
}

std::vector<Device::Publication> Device::publications(const std::vector<Dependency>& batch) const {
  std::vector<Publication> result;
  for (const Dependency& dependency : batch) {
    for (const std::uint32_t index : dependency.cells) {
      const Cell& cell = cells_[index];
      const bool makes = makesAvailable(dependency, cell);
      if (makes || findsAvailable(dependency.srcStage, cell)) result.push_back({&dependency, index, makes});
    }
  }
  return result;
}

void Device::publish(const Publication& publication) {
  Cell& cell = cells_[publication.cell];
  const Dependency& dependency = *publication.dependency;
  if (publication.makesAvailable) {
    const VkPipelineStageFlags2 before = cell.available ? at(cell.availability).ordered : VK_PIPELINE_STAGE_2_NONE;
    cell.availability = order_.add({VK_PIPELINE_STAGE_2_NONE, before | dependency.dstStage});
    cell.available = true;
  }
  const Visibility visibility{dependency.dstStage, dependency.dstAccess};
  if (std::ranges::find(cell.visible, visibility) == cell.visible.end()) cell.visible.push_back(visibility);
}

void Device::checkTransition(const Dependency& dependency, std::uint32_t index) {
  const Cell& cell = cells_[index];
  const auto readsFinished = [&](const Cell& other) {
    return allReads(other, [&](const Operation& read) { return waitsFor(dependency.srcStage, read); });
  };
  const auto writeFinished = [&](const Cell& other) {
    return findsAvailable(dependency.srcStage, other) &&
           (!other.written || waitsFor(dependency.srcStage, at(other.write)));
  };
  if (dependency.oldLayout != VK_IMAGE_LAYOUT_UNDEFINED && dependency.oldLayout != cell.layout) {
    complain("a barrier expects '" + cell.name + "' in layout " + std::to_string(dependency.oldLayout) +
             ", but it is in " + std::to_string(cell.layout));
  }
  // Vulkan executes the layout transitions of one queue in submission order. The verifier does not count on it: a plan
  // that needs it has a barrier whose stages do not name what the barrier waits for.
  if (!readsFinished(cell) || !(writeFinished(cell) || makesAvailable(dependency, cell))) {
    complain("the layout of '" + cell.name + "' changes before earlier accesses have finished");
  }
  for (const std::uint32_t peer : peers(cell)) {
    const Cell& other = cells_[peer];
    if (!readsFinished(other) || !writeFinished(other)) {
      complain("'" + cell.name + "' takes over the memory of '" + other.name + "' before its accesses have finished");
    }
  }
}

void Device::transition(const Dependency& dependency, std::uint32_t index) {
  Cell& cell = cells_[index];
  cell.layout = dependency.newLayout;
  if (dependency.oldLayout == VK_IMAGE_LAYOUT_UNDEFINED) cell.contents = {};
  takeBytes(index, peers(cell));
  cell.written = true;
  cell.write = cell.availability = order_.add({VK_PIPELINE_STAGE_2_NONE, dependency.dstStage});
  cell.writeAccess = VK_ACCESS_2_NONE;
  cell.available = true;
  cell.visible = {{dependency.dstStage, dependency.dstAccess}};
  cell.reads.clear();
}

void Device::access(std::uint32_t index, const Use& use, const Contents& expected, const Contents& result) {
  ++time_;
  Cell& cell = cells_[index];
  const VkPipelineStageFlags2 stage = use.stage;
  const auto visibleTo = [&](VkAccessFlags2 access) {
    for (VkPipelineStageFlags2 rest = stage; rest != 0; rest &= rest - 1) {
      const VkPipelineStageFlags2 bit = rest & ~(rest - 1);
      const bool visible = std::ranges::any_of(
          cell.visible, [&](const Visibility& to) { return (to.stage & bit) != 0 && (access & ~to.access) == 0; });
      if (!visible) return false;
    }
    return true;
  };
  if (cell.layout != use.layout) {
    complain("'" + cell.name + "' is accessed in layout " + std::to_string(use.layout) + ", but is in " +
             std::to_string(cell.layout));
  }
  if (cell.written && !happensAfter(stage, at(cell.write))) complain("'" + cell.name + "' is accessed during a write");
  if (use.reads != 0) {
    if (cell.contents.resource == kNone || cell.contents != expected) {
      complain("'" + cell.name + "' is read, but does not hold what was declared");
    }
    if (cell.written && !visibleTo(use.reads)) complain("a write to '" + cell.name + "' is not visible to its reader");
  }
  if (use.writes == 0) {
    std::erase_if(cell.reads, [&](OperationOrder::Handle read) { return at(read).stage == stage; });
    cell.reads.push_back(order_.add({stage, VK_PIPELINE_STAGE_2_NONE}));
    return;
  }
  if (cell.written && !visibleTo(use.writes)) complain("'" + cell.name + "' is overwritten by an unordered write");
  const auto finished = [&](const Operation& read) { return happensAfter(stage, read); };
  if (!allReads(cell, finished)) complain("'" + cell.name + "' is overwritten while it is read");
  const std::vector<std::uint32_t> others = peers(cell);
  for (const std::uint32_t peer : others) {
    const Cell& other = cells_[peer];
    const bool done = (!other.written || (other.available && happensAfter(stage, at(other.availability)))) &&
                      allReads(other, finished);
    if (!done) complain("'" + cell.name + "' overwrites the memory of '" + other.name + "', which is still in use");
  }
  takeBytes(index, others);
  cell.contents = result;
  cell.written = true;
  cell.write = order_.add({stage, VK_PIPELINE_STAGE_2_NONE});
  cell.writeAccess = use.writes;
  cell.available = false;
  cell.visible.clear();
  cell.reads.clear();
}

void Device::checkFinished(std::uint32_t index, VkPipelineStageFlags2 stage) {
  const Cell& cell = cells_[index];
  const bool finished = (!cell.written || waitsFor(stage, at(cell.write))) &&
                        allReads(cell, [&](const Operation& read) { return waitsFor(stage, read); });
  if (!finished)
    complain("'" + cell.name + "' is returned to the host while stages that its state does not name still access it");
}

}  // namespace fg::check
