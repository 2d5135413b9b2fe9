#include "framegraph/compile/requirements.h"

#include <variant>

#include "framegraph/declare/access.h"

namespace fg {
namespace {

/// Usage flags are those of a texture or of a buffer, as the resource is.
void addUsage(const ResourceDecl& decl, VkImageUsageFlags image, VkBufferUsageFlags buffer, PlannedResource& resource) {
  if (std::holds_alternative<TextureDesc>(decl.desc)) {
    resource.imageUsage |= image;
  } else {
    resource.bufferUsage |= buffer;
  }
}

void addUses(const GraphDesc& graph, const PassDecl& pass, std::vector<PlannedResource>& resources) {
  for (const AccessDecl& access : pass.accesses) {
    PlannedResource& resource = resources[access.resource];
    const AccessInfo& info = accessInfo(access.access);
    resource.used = true;
    addUsage(graph.resources[access.resource], info.imageUsage, info.bufferUsage, resource);
  }
}

/// Add the usage flags that the host's own use of a resource needs.
void addExternalUse(const ResourceDecl& decl, const ExternalState& state, PlannedResource& resource) {
  addUsage(decl, imageUsageIn(state), bufferUsageIn(state), resource);
}

}  // namespace

std::vector<PlannedResource> requirements(const GraphDesc& graph, const Culling& culling, const MemoryModel& memory) {
  std::vector<PlannedResource> resources(graph.resources.size());
  for (std::size_t i = 0; i < graph.passes.size(); ++i) {
    if (culling.live[i]) addUses(graph, graph.passes[i], resources);
  }
  for (std::size_t i = 0; i < resources.size(); ++i) {
    const ResourceDecl& decl = graph.resources[i];
    if (decl.acquire) addExternalUse(decl, *decl.acquire, resources[i]);
  }
  for (const ExportDecl& exported : graph.exports) {
    const std::uint32_t index = exported.resource.resource;
    resources[index].used = true;
    addExternalUse(graph.resources[index], exported.release, resources[index]);
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
