#include "framegraph/compile/cull.h"

#include <string>

namespace fg {
namespace {

/// Marks the passes that are needed, from exports and side effects backwards to their inputs.
class Marker {
 public:
  explicit Marker(const Topology& topology) : topology_(topology), live_(topology.graph().passes.size()) {}

  std::vector<bool> run() {
    const GraphDesc& graph = topology_.graph();
    for (const ExportDecl& exported : graph.exports) {
      need(exported.resource.resource, exported.resource.version);
      needHistory(exported.resource.resource);
    }
    for (std::uint32_t i = 0; i < graph.passes.size(); ++i) {
      if (graph.passes[i].sideEffects) keep(i);
    }
    while (!pending_.empty()) {
      const std::uint32_t pass = pending_.back();
      pending_.pop_back();
      for (const AccessDecl& access : graph.passes[pass].accesses) needInputs(access);
    }
    return std::move(live_);
  }

 private:
  void keep(std::uint32_t pass) {
    if (live_[pass]) return;
    live_[pass] = true;
    pending_.push_back(pass);
  }

  void need(std::uint32_t resource, std::uint32_t version) {
    const VersionUses& uses = topology_.uses(resource, version);
    if (uses.writer != kNone) keep(uses.writer);
  }

  void needInputs(const AccessDecl& access) {
    if (access.readVersion != kNone) need(access.resource, access.readVersion);
    if (access.writeVersion != kNone) {
      const VersionUses& made = topology_.uses(access.resource, access.writeVersion);
      if (made.keepsPredecessor) need(access.resource, made.predecessor);
    }
    needHistory(access.resource);
  }

  /// Who reads a history's `previous` needs the pass that writes `current`: it wrote `previous` in the last frame.
  void needHistory(std::uint32_t index) {
    const GraphDesc& graph = topology_.graph();
    const ResourceDecl& resource = graph.resources[index];
    if (resource.lifetime != Lifetime::HistoryPrevious) return;
    const std::uint32_t current = graph.histories[resource.history].current;
    need(current, topology_.versionCount(current) - 1);
  }

  const Topology& topology_;
  std::vector<bool> live_;
  std::vector<std::uint32_t> pending_;
};

std::string reason(const Topology& topology, std::uint32_t pass) {
  const GraphDesc& graph = topology.graph();
  std::string text;
  for (const AccessDecl& access : graph.passes[pass].accesses) {
    if (access.writeVersion == kNone) continue;
    const VersionUses& made = topology.uses(access.resource, access.writeVersion);
    if (!text.empty()) text += "; ";
    text += "'" + graph.resources[access.resource].name + "' is ";
    if (made.readers.empty()) {
      text += "read by no pass and not exported";
      continue;
    }
    text += "read only by passes that are culled themselves:";
    for (const std::uint32_t reader : made.readers) text += " '" + graph.passes[reader].name + "'";
  }
  return text.empty() ? "it writes nothing and has no side effects" : text;
}

}  // namespace

Culling cull(const Topology& topology) {
  Culling result{Marker(topology).run(), {}};
  for (const std::uint32_t pass : topology.passesByName()) {
    if (!result.live[pass]) result.culled.push_back({pass, reason(topology, pass)});
  }
  return result;
}

}  // namespace fg
