#include "framegraph/compile/requirements.h"

#include "framegraph/declare/access.h"

namespace fg {
namespace {

void addUses(const PassDecl& pass, std::vector<PlannedResource>& resources) {
  for (const AccessDecl& access : pass.accesses) {
    PlannedResource& resource = resources[access.resource];
    resource.used = true;
    resource.imageUsage |= accessInfo(access.access).imageUsage;
    resource.bufferUsage |= accessInfo(access.access).bufferUsage;
  }
}

/// Add the usage flags that the host's own use of a resource needs.
void addExternalUse(const ExternalState& state, PlannedResource& resource) {
  resource.imageUsage |= imageUsageIn(state);
  resource.bufferUsage |= bufferUsageIn(state);
}

}  // namespace

std::vector<PlannedResource> requirements(const GraphDesc& graph, const Culling& culling, const MemoryModel& memory) {
  std::vector<PlannedResource> resources(graph.resources.size());
  for (std::size_t i = 0; i < graph.passes.size(); ++i) {
    if (culling.live[i]) addUses(graph.passes[i], resources);
  }
  for (std::size_t i = 0; i < resources.size(); ++i) {
    if (graph.resources[i].acquire) addExternalUse(*graph.resources[i].acquire, resources[i]);
  }
  for (const ExportDecl& exported : graph.exports) {
    resources[exported.resource.resource].used = true;
    addExternalUse(exported.release, resources[exported.resource.resource]);
  }
  for (const HistoryDecl& history : graph.histories) {
    PlannedResource& previous = resources[history.previous];
    PlannedResource& current = resources[history.current];
    if (!current.used) continue;
    previous.imageUsage |= current.imageUsage | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    current.imageUsage = previous.imageUsage;
  }
  for (std::size_t i = 0; i < resources.size(); ++i) {
    PlannedResource& resource = resources[i];
    if (!resource.used) continue;
    const auto* texture = std::get_if<TextureDesc>(&graph.resources[i].desc);
    const MemoryRequirements needs =
        texture != nullptr ? memory.texture(*texture, resource.imageUsage)
                           : memory.buffer(std::get<BufferDesc>(graph.resources[i].desc), resource.bufferUsage);
    resource.size = needs.size;
    resource.alignment = needs.alignment;
    resource.memoryTypeBits = needs.memoryTypeBits;
  }
  return resources;
}

std::vector<bool> aliasable(const GraphDesc& graph) {
  std::vector<bool> result(graph.resources.size());
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = graph.resources[i].lifetime == Lifetime::Transient;
  for (const ExportDecl& exported : graph.exports) result[exported.resource.resource] = false;
  return result;
}

std::vector<bool> aliasableHistories(const GraphDesc& graph, const std::vector<PlannedResource>& resources) {
  std::vector<bool> result;
  for (const HistoryDecl& history : graph.histories) {
    result.push_back(resources[history.current].used && resources[history.previous].used);
  }
  for (const ExportDecl& exported : graph.exports) {
    const std::uint32_t history = graph.resources[exported.resource.resource].history;
    if (history != kNone) result[history] = false;
  }
  return result;
}

}  // namespace fg
