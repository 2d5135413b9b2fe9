#include "framegraph/verify_device.h"

#include <algorithm>

namespace fg::check {
namespace {

/// True where the operation is in the first synchronization scope of a dependency on these stages.
bool waitsFor(VkPipelineStageFlags2 srcStage, const Operation& operation) {
  const bool direct = operation.stage != 0 && (operation.stage & ~srcStage) == 0;
  return direct || (operation.ordered & srcStage) != 0;
}

/// True where a command's work in these stages happens after the operation.
bool happensAfter(VkPipelineStageFlags2 stage, const Operation& operation) {
  return (stage & ~operation.ordered) == 0;
}

bool isTransition(const Dependency& dependency) {
  return dependency.oldLayout != dependency.newLayout;
}

}  // namespace

void Device::complain(const std::string& what) {
  complaints_.push_back(place_ + ": " + what);
}

void Device::barrier(const std::vector<Dependency>& batch) {
  // All scopes refer to the state before the batch.
  std::vector<Operation> writes(cells_.size());
  std::ranges::transform(cells_, writes.begin(), &Cell::write);
  for (const Dependency& dependency : batch) {
    for (const std::uint32_t index : dependency.cells) {
      if (isTransition(dependency)) checkTransition(dependency, index);
    }
  }
  const auto order = [&](Operation& operation) {
    const Operation old = operation;
    for (const Dependency& dependency : batch) {
      if (waitsFor(dependency.srcStage, old)) operation.ordered |= dependency.dstStage;
    }
  };
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    order(cells_[i].write);
    for (Operation& read : cells_[i].reads) order(read);
  }
  for (const Dependency& dependency : batch) {
    for (const std::uint32_t index : dependency.cells) {
      publish(dependency, writes[index], cells_[index]);
    }
  }
  for (const Dependency& dependency : batch) {
    for (const std::uint32_t index : dependency.cells) {
      if (isTransition(dependency)) transition(dependency, index);
    }
  }
}

void Device::publish(const Dependency& dependency, const Operation& write, Cell& cell) {
  if (!cell.written || !waitsFor(dependency.srcStage, write)) return;
  const bool inAccessScope =
      write.stage != 0 && (write.stage & ~dependency.srcStage) == 0 && (cell.writeAccess & ~dependency.srcAccess) == 0;
  cell.available = cell.available || inAccessScope;
  if (cell.available) cell.visible.push_back({dependency.dstStage, dependency.dstAccess});
}

void Device::checkTransition(const Dependency& dependency, std::uint32_t index) {
  const Cell& cell = cells_[index];
  const auto ordered = [&](const Cell& other) {
    return (!other.written || waitsFor(dependency.srcStage, other.write)) &&
           std::ranges::all_of(other.reads, [&](const Operation& read) { return waitsFor(dependency.srcStage, read); });
  };
  if (dependency.oldLayout != VK_IMAGE_LAYOUT_UNDEFINED && dependency.oldLayout != cell.layout) {
    complain("a barrier takes '" + cell.name + "' to be in layout " + std::to_string(dependency.oldLayout) +
             ", but it is in " + std::to_string(cell.layout));
  }
  const bool available =
      !cell.written || cell.available ||
      ((cell.write.stage & ~dependency.srcStage) == 0 && (cell.writeAccess & ~dependency.srcAccess) == 0);
  if (!ordered(cell) || !available) {
    complain("the layout of '" + cell.name + "' changes before earlier accesses have finished");
  }
  for (const std::uint32_t peer : cell.peers) {
    const Cell& other = cells_[peer];
    if (!ordered(other) || (other.written && !other.available)) {
      complain("'" + cell.name + "' takes over the memory of '" + other.name + "' before its accesses have finished");
    }
  }
}

void Device::transition(const Dependency& dependency, std::uint32_t index) {
  Cell& cell = cells_[index];
  cell.layout = dependency.newLayout;
  if (dependency.oldLayout == VK_IMAGE_LAYOUT_UNDEFINED) {
    cell.contents = {};
    for (const std::uint32_t peer : cell.peers) cells_[peer].contents = {};
  }
  cell.written = true;
  // Layout transitions of one image are executed in submission order: where nothing waits for this one, a later one
  // that waits for the same work still comes after it.
  const bool waitedFor = dependency.dstStage != VK_PIPELINE_STAGE_2_NONE;
  cell.write = {VK_PIPELINE_STAGE_2_NONE, waitedFor ? dependency.dstStage : dependency.srcStage};
  cell.writeAccess = VK_ACCESS_2_NONE;
  cell.available = true;
  cell.visible = {{dependency.dstStage, dependency.dstAccess}};
  cell.reads.clear();
}

void Device::access(std::uint32_t index, const Use& use, const Contents& expected, const Contents& result) {
  Cell& cell = cells_[index];
  const VkPipelineStageFlags2 stage = expanded(use.stage);
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
  if (cell.written && !happensAfter(stage, cell.write)) complain("'" + cell.name + "' is accessed during a write");
  if (use.reads != 0) {
    if (cell.contents.resource == kNone || cell.contents != expected) {
      complain("'" + cell.name + "' is read, but does not hold what was declared");
    }
    if (cell.written && !visibleTo(use.reads)) complain("a write to '" + cell.name + "' is not visible to its reader");
  }
  if (use.writes == 0) {
    std::erase_if(cell.reads, [&](const Operation& read) { return read.stage == stage; });
    cell.reads.push_back({stage, VK_PIPELINE_STAGE_2_NONE});
    return;
  }
  if (cell.written && !visibleTo(use.writes)) complain("'" + cell.name + "' is overwritten by an unordered write");
  const auto finished = [&](const Operation& read) { return happensAfter(stage, read); };
  if (!std::ranges::all_of(cell.reads, finished)) complain("'" + cell.name + "' is overwritten while it is read");
  for (const std::uint32_t peer : cell.peers) {
    Cell& other = cells_[peer];
    const bool done = (!other.written || (other.available && happensAfter(stage, other.write))) &&
                      std::ranges::all_of(other.reads, finished);
    if (!done) complain("'" + cell.name + "' overwrites the memory of '" + other.name + "', which is still in use");
    other.contents = {};
  }
  cell.contents = result;
  cell.written = true;
  cell.write = {stage, VK_PIPELINE_STAGE_2_NONE};
  cell.writeAccess = use.writes;
  cell.available = false;
  cell.visible.clear();
  cell.reads.clear();
}

}  // namespace fg::check
