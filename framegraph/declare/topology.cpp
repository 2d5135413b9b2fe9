#include "framegraph/declare/topology.h"

#include <algorithm>
#include <numeric>

namespace fg {
namespace {

template <typename Decl>
std::vector<std::uint32_t> orderedByName(const std::vector<Decl>& decls) {
  std::vector<std::uint32_t> order(decls.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t i) -> const std::string& { return decls[i].name; });
  return order;
}

}  // namespace

bool validHandle(const GraphDesc& graph, const AccessDecl& access) {
  if (access.resource >= graph.resources.size()) return false;
  const std::uint32_t versions = graph.resources[access.resource].versions;
  const auto valid = [&](std::uint32_t version) { return version == kNone || version <= versions; };
  return valid(access.readVersion) && valid(access.writeVersion) && valid(access.replacesVersion);
}

SubresourceRange resolved(const ResourceDecl& resource, const SubresourceRange& range) {
  const auto* texture = std::get_if<TextureDesc>(&resource.desc);
  if (texture == nullptr) return {0, 1, 0, 1};
  SubresourceRange result = range;
  if (range.mipCount == VK_REMAINING_MIP_LEVELS) {
    result.mipCount = texture->mipLevels - std::min(range.baseMip, texture->mipLevels);
  }
  if (range.layerCount == VK_REMAINING_ARRAY_LAYERS) {
    result.layerCount = texture->arrayLayers - std::min(range.baseLayer, texture->arrayLayers);
  }
  return result;
}

bool coversAll(const ResourceDecl& resource, const SubresourceRange& range) {
  return resolved(resource, range) == resolved(resource, {});
}

Topology::Topology(const GraphDesc& graph)
    : graph_(&graph),
      first_(graph.resources.size() + 1),
      passesByName_(orderedByName(graph.passes)),
      resourcesByName_(orderedByName(graph.resources)),
      resourceRank_(graph.resources.size()) {
  for (std::uint32_t i = 0; i < resourcesByName_.size(); ++i) resourceRank_[resourcesByName_[i]] = i;
  for (std::size_t i = 0; i < graph.resources.size(); ++i) first_[i + 1] = first_[i] + graph.resources[i].versions + 1;
  uses_.resize(first_.back());
  for (const std::uint32_t pass : passesByName_) {
    for (const AccessDecl& access : graph.passes[pass].accesses) {
      if (!validHandle(graph, access)) continue;
      if (access.readVersion != kNone) {
        auto& readers = mutableUses(access.resource, access.readVersion).readers;
        if (readers.empty() || readers.back() != pass) readers.push_back(pass);
      }
      if (access.writeVersion == kNone) continue;
      VersionUses& made = mutableUses(access.resource, access.writeVersion);
      if (made.writer != kNone) continue;
      made.writer = pass;
      made.write = &access;
      made.predecessor = access.readVersion != kNone ? access.readVersion : access.replacesVersion;
      made.keepsPredecessor = access.readVersion != kNone || !coversAll(graph.resources[access.resource], access.range);
    }
  }
}

}  // namespace fg
