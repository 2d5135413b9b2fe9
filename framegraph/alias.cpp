#include "framegraph/alias.h"

#include <algorithm>
#include <map>

#include "framegraph/heap_packing.h"
#include "framegraph/requirements.h"

namespace fg {
namespace {

bool isBuffer(const GraphDesc& graph, std::uint32_t resource) {
  return std::holds_alternative<BufferDesc>(graph.resources[resource].desc);
}

/// Linear and optimally tiled neighbours must not share a page of `granularity` bytes: where a heap has both, all
/// blocks are whole pages.
void separateBuffersFromImages(const GraphDesc& graph, const std::vector<std::uint32_t>& members,
                               std::uint64_t granularity, std::vector<HeapRequest>& requests) {
  const auto buffers = std::ranges::count_if(members, [&](std::uint32_t i) { return isBuffer(graph, i); });
  if (buffers == 0 || buffers == std::ssize(members)) return;
  for (HeapRequest& request : requests) {
    request.alignment = std::max(request.alignment, granularity);
    request.size = (request.size + granularity - 1) / granularity * granularity;
  }
}

}  // namespace

std::uint32_t heldUntil(const AccessHistory& accesses, const Plan& plan, std::uint32_t resource) {
  const std::uint32_t lastUse = plan.resources[resource].lastUse;
  const std::uint32_t unread = accesses.lastUnreadWrite(resource);
  const auto lastPass = static_cast<std::uint32_t>(plan.passes.size()) - 1;
  return unread == kNone ? lastUse : std::max(lastUse, std::min(unread + 1, lastPass));
}

void placeTransients(const Topology& topology, const AccessHistory& accesses, std::uint64_t bufferImageGranularity,
                     Plan& plan) {
  const GraphDesc& graph = topology.graph();
  const std::vector<bool> shared = aliasable(graph);
  std::map<std::uint32_t, std::vector<std::uint32_t>> classes;
  for (const std::uint32_t resource : topology.resourcesByName()) {
    const PlannedResource& planned = plan.resources[resource];
    if (shared[resource] && planned.used) classes[planned.memoryTypeBits].push_back(resource);
  }
  std::vector<HeapRequest> all;
  for (const auto& [memoryTypeBits, members] : classes) {
    std::vector<HeapRequest> requests;
    for (const std::uint32_t resource : members) {
      const PlannedResource& planned = plan.resources[resource];
      requests.push_back({planned.size, planned.alignment, planned.firstUse, planned.lastUse});
    }
    all.insert(all.end(), requests.begin(), requests.end());
    for (std::size_t i = 0; i < members.size(); ++i) requests[i].lastUse = heldUntil(accesses, plan, members[i]);
    separateBuffersFromImages(graph, members, bufferImageGranularity, requests);
    const HeapPacking packing = pack(requests);
    for (std::size_t i = 0; i < members.size(); ++i) {
      plan.resources[members[i]].heap = static_cast<std::uint32_t>(plan.heaps.size());
      plan.resources[members[i]].offset = packing.offsets[i];
      plan.memory.transientUnaliasedBytes += plan.resources[members[i]].size;
    }
    plan.heaps.push_back({memoryTypeBits, packing.size});
    plan.memory.transientPeakBytes += packing.size;
  }
  plan.memory.transientLowerBoundBytes = lowerBound(all);
}

}  // namespace fg
