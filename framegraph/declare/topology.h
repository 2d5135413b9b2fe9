#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "framegraph/declare/graph.h"

namespace fg {

/// Everything that is declared to happen to one version of a resource.
struct VersionUses {
  std::uint32_t writer = kNone;        ///< Pass that makes it; the first by name where several claim to.
  const AccessDecl* write = nullptr;   ///< The access by which it does.
  std::uint32_t predecessor = kNone;   ///< Version that it replaces or updates.
  bool keepsPredecessor = false;       ///< Some contents come from the predecessor: updated in place, or only a part
                                       ///< written.
  std::vector<std::uint32_t> readers;  ///< Passes that read it, updates in place included; by name, each once.
};

/// Who makes, reads and replaces every version; names as ranks, so that nothing depends on registration order.
/// Accesses through invalid handles are left out. Refers to the graph, which must outlive it.
class Topology {
 public:
  explicit Topology(const GraphDesc& graph);

  [[nodiscard]] const GraphDesc& graph() const { return *graph_; }
  /// Number of versions of a resource, the zeroth included.
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
  /// Place of a resource in `resourcesByName`.
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

/// True where an access names a declared resource and versions of it that some handle can have.
bool validHandle(const GraphDesc& graph, const AccessDecl& access);

/// The texture's part with VK_REMAINING_* resolved; buffers have one mip level and one layer.
SubresourceRange resolved(const ResourceDecl& resource, const SubresourceRange& range);

/// True where the range is all of the resource.
bool coversAll(const ResourceDecl& resource, const SubresourceRange& range);

}  // namespace fg
