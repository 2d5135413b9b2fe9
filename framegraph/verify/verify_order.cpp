#include "framegraph/verify/verify_order.h"

#include <algorithm>

namespace fg::check {

bool waitsFor(VkPipelineStageFlags2 srcStage, const Operation& operation) {
  const bool direct = operation.stage != 0 && (operation.stage & ~srcStage) == 0;
  return direct || (operation.ordered & srcStage) != 0;
}

bool happensAfter(VkPipelineStageFlags2 stage, const Operation& operation) {
  return (stage & ~operation.ordered) == 0;
}

OperationOrder::Handle OperationOrder::add(const Operation& operation) {
  const auto next = static_cast<Handle>(states_.size());
  const auto [entry, isNew] = distinct_.try_emplace({operation.stage, operation.ordered}, next);
  if (isNew) {
    states_.push_back(operation);
    parents_.push_back(next);
  }
  return entry->second;
}

OperationOrder::Handle OperationOrder::find(Handle handle) const {
  Handle root = handle;
  while (parents_[root] != root) root = parents_[root];
  while (parents_[handle] != root) handle = std::exchange(parents_[handle], root);
  return root;
}

void OperationOrder::barrier(std::vector<ExecutionDependency> batch) {
  std::ranges::sort(batch);
  batch.erase(std::unique(batch.begin(), batch.end()), batch.end());
  std::map<Key, Handle> after;
  for (const auto& [key, handle] : distinct_) {
    Operation& operation = states_[handle];
    const Operation before = operation;
    for (const ExecutionDependency& dependency : batch) {
      if (waitsFor(dependency.srcStage, before)) operation.ordered |= dependency.dstStage;
    }
    const auto [entry, isNew] = after.try_emplace({operation.stage, operation.ordered}, handle);
    if (!isNew) parents_[handle] = entry->second;
  }
  distinct_ = std::move(after);
}

}  // namespace fg::check
