#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "framegraph/declare/graph.h"

namespace fg {

/// All declared accesses to one version of a resource.
struct VersionUses {
  std::uint32_t writer = kNone;        ///< Pass that writes it; the first by name if several do.
  const AccessDecl* write = nullptr;   ///< The writing access.
  std::uint32_t predecessor = kNone;   ///< Version that it replaces or updates.
  bool keepsPredecessor = false;       ///< True if some contents come from the predecessor: it is updated in place, or
                                       ///< only a part is written.
  std::vector<std::uint32_t> readers;  ///< Passes that read or update it, ordered by name, each once.
};

/// The table of writers and readers of every version of every resource. Passes and resources are also available in the
/// order of their names, so that results need not depend on the order of registration. Accesses through invalid handles
/// are left out. Refers to the graph, which must outlive it.
class Topology {
 public:
  explicit Topology(const GraphDesc& graph);

  [[nodiscard]] const GraphDesc& graph() const { return *graph_; }
  /// Number of versions of a resource, including version 0.
  [[nodiscard]] std::uint32_t versionCount(std::uint32_t resource) const {
    return first_[resource + 1] - first_[resource];
  }
  [[nodiscard]] const VersionUses& uses(std::uint32_t resource, std::uint32_t version) const {
    return uses_[first_[resource] + version];
  }
  /// All passes, ordered by name.
  [[nodiscard]] std::span<const std::uint32_t> passesByName() const { return passesByName_; }
  /// All resources, ordered by name.
  [[nodiscard]] std::span<const std::uint32_t> resourcesByName() const { return resourcesByName_; }
  /// Index of a resource in `resourcesByName`.
  [[nodiscard]] std::uint32_t resourceRank(std::uint32_t resource) const { return resourceRank_[resource]; }

 private:
  VersionUses& mutableUses(std::uint32_t resource, std::uint32_t version) { return uses_[first_[resource] + version]; }

  const GraphDesc* graph_;
  std::vector<std::uint32_t> first_;
  std::vector<VersionUses> uses_;
  std::vector<std::uint32_t> passesByName_;
  std::vector<std::uint32_t> resourcesByName_;
  std::vector<std::uint32_t> resourceRank_;
};

/// True if an access refers to a declared resource and to existing versions of it.
bool validHandle(const GraphDesc& graph, const AccessDecl& access);

/// The range with VK_REMAINING_* replaced by numbers. Buffers have one mip level and one layer.
SubresourceRange resolved(const ResourceDecl& resource, const SubresourceRange& range);

/// True if the range is the whole resource.
bool coversAll(const ResourceDecl& resource, const SubresourceRange& range);

}  // namespace fg
