#include "framegraph/verify/verify_device.h"

#include <algorithm>

namespace fg::check {
namespace {

/// True if the operation is in the first synchronization scope of a dependency with these source stages.
bool waitsFor(VkPipelineStageFlags2 srcStage, const Operation& operation) {
  const bool direct = operation.stage != 0 && (operation.stage & ~srcStage) == 0;
  return direct || (operation.ordered & srcStage) != 0;
}

/// True if the work of later commands in these stages happens after the operation.
bool happensAfter(VkPipelineStageFlags2 stage, const Operation& operation) {
  return (stage & ~operation.ordered) == 0;
}

bool isTransition(const Dependency& dependency) {
  return dependency.oldLayout != dependency.newLayout;
}

/// True if the cell's last write is available before a dependency with these source stages.
bool findsAvailable(VkPipelineStageFlags2 srcStage, const Cell& cell) {
  return !cell.written || (cell.available && (cell.availableTo & srcStage) != 0);
}

/// True if the dependency itself makes the cell's last write available.
bool makesAvailable(const Dependency& dependency, const Cell& cell) {
  return cell.written && !cell.available && (cell.write.stage & ~dependency.srcStage) == 0 &&
         (cell.writeAccess & ~dependency.srcAccess) == 0;
}

}  // namespace

void Device::complain(const std::string& what) {
  complaints_.push_back(place_ + ": " + what);
}

void Device::barrier(const std::vector<Dependency>& batch) {
  // All scopes refer to the state before the batch.
  const std::vector<Publication> published = publications(batch);
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
  for (Cell& cell : cells_) {
    order(cell.write);
    for (Operation& read : cell.reads) order(read);
    const VkPipelineStageFlags2 availableTo = cell.availableTo;
    for (const Dependency& dependency : batch) {
      if ((availableTo & dependency.srcStage) != 0) cell.availableTo |= dependency.dstStage;
    }
  }
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
    cell.available = true;
    cell.availableTo |= dependency.dstStage;
  }
  cell.visible.push_back({dependency.dstStage, dependency.dstAccess});
}

void Device::checkTransition(const Dependency& dependency, std::uint32_t index) {
  const Cell& cell = cells_[index];
  const auto readsFinished = [&](const Cell& other) {
    return std::ranges::all_of(other.reads, [&](const Operation& read) { return waitsFor(dependency.srcStage, read); });
  };
  const auto writeFinished = [&](const Cell& other) {
    return findsAvailable(dependency.srcStage, other) && (!other.written || waitsFor(dependency.srcStage, other.write));
  };
  if (dependency.oldLayout != VK_IMAGE_LAYOUT_UNDEFINED && dependency.oldLayout != cell.layout) {
    complain("a barrier expects '" + cell.name + "' in layout " + std::to_string(dependency.oldLayout) +
             ", but it is in " + std::to_string(cell.layout));
  }
  // Vulkan executes layout transitions of one image in submission order without further dependencies.
  const bool afterTransition = cell.write.stage == VK_PIPELINE_STAGE_2_NONE;
  if (!readsFinished(cell) || !(afterTransition || writeFinished(cell) || makesAvailable(dependency, cell))) {
    complain("the layout of '" + cell.name + "' changes before earlier accesses have finished");
  }
  for (const std::uint32_t peer : cell.peers) {
    const Cell& other = cells_[peer];
    if (!readsFinished(other) || !writeFinished(other)) {
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
  cell.write = {VK_PIPELINE_STAGE_2_NONE, dependency.dstStage};
  cell.writeAccess = VK_ACCESS_2_NONE;
  cell.available = true;
  cell.availableTo = cell.write.ordered;
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
    const bool done = (!other.written || (other.available && (stage & ~other.availableTo) == 0)) &&
                      std::ranges::all_of(other.reads, finished);
    if (!done) complain("'" + cell.name + "' overwrites the memory of '" + other.name + "', which is still in use");
    other.contents = {};
  }
  cell.contents = result;
  cell.written = true;
  cell.write = {stage, VK_PIPELINE_STAGE_2_NONE};
  cell.writeAccess = use.writes;
  cell.available = false;
  cell.availableTo = VK_PIPELINE_STAGE_2_NONE;
  cell.visible.clear();
  cell.reads.clear();
}

void Device::checkFinished(std::uint32_t index, VkPipelineStageFlags2 stage) {
  const Cell& cell = cells_[index];
  const VkPipelineStageFlags2 waited = expanded(stage);
  const bool finished = (!cell.written || waitsFor(waited, cell.write)) &&
                        std::ranges::all_of(cell.reads, [&](const Operation& read) { return waitsFor(waited, read); });
  if (!finished)
    complain("'" + cell.name + "' is returned to the host while stages that its state does not name still access it");
}

}  // namespace fg::check
