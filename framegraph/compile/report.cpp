#include "framegraph/compile/report.h"

#include <algorithm>

#include "framegraph/compile/requirements.h"
#include "framegraph/declare/access.h"
#include "framegraph/declare/memory_model.h"

namespace fg {
namespace {

std::uint64_t accessedBytes(const ResourceDecl& resource, const AccessDecl& access) {
  if (const auto* buffer = std::get_if<BufferDesc>(&resource.desc)) return buffer->size;
  return texelBytes(std::get<TextureDesc>(resource.desc), access.range);
}

std::uint64_t pixels(const ResourceDecl& resource) {
  const auto* texture = std::get_if<TextureDesc>(&resource.desc);
  return texture == nullptr ? 0 : std::uint64_t{texture->extent.width} * texture->extent.height;
}

std::uint64_t persistentBytes(const GraphDesc& graph, const Plan& plan) {
  const std::vector<bool> shared = aliasable(graph);
  std::uint64_t bytes = 0;
  for (std::size_t i = 0; i < plan.resources.size(); ++i) {
    const Lifetime lifetime = graph.resources[i].lifetime;
    if (!plan.resources[i].used) continue;
    if (lifetime == Lifetime::HistoryCurrent) bytes += 2 * plan.resources[i].size;
    if (lifetime == Lifetime::Transient && !shared[i]) bytes += plan.resources[i].size;
  }
  return bytes;
}

}  // namespace

void report(const GraphDesc& graph, Plan& plan) {
  plan.memory.persistentBytes = persistentBytes(graph, plan);
  for (const PlannedPass& planned : plan.passes) {
    const std::vector<AccessDecl>& accesses = graph.passes[planned.pass].accesses;
    for (auto access = accesses.begin(); access != accesses.end(); ++access) {
      if (access->unread) continue;
      const auto sameBytes = [&](const AccessDecl& other) {
        return !other.unread && other.resource == access->resource && other.access == access->access &&
               other.range == access->range;
      };
      if (std::any_of(accesses.begin(), access, sameBytes)) continue;  // Bound twice, read once.
      const std::uint64_t bytes = accessedBytes(graph.resources[access->resource], *access);
      if (accessInfo(access->access).reads()) plan.traffic.bytesRead += bytes;
      if (accessInfo(access->access).writes()) plan.traffic.bytesWritten += bytes;
    }
  }
  for (const ExportDecl& exported : graph.exports) {
    plan.traffic.pixels = std::max(plan.traffic.pixels, pixels(graph.resources[exported.resource.resource]));
  }
}

}  // namespace fg
