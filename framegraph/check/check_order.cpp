#include <algorithm>

#include "framegraph/check/checks.h"
#include "framegraph/declare/dependencies.h"

namespace fg {
namespace {

/// Finds cycles of passes that wait for each other. Cycles that share a pass are reported once.
class CycleSearch {
 public:
  explicit CycleSearch(const Topology& topology)
      : topology_(topology),
        edges_(dependencies(topology, std::vector<bool>(topology.graph().passes.size(), true))),
        outgoing_(topology.graph().passes.size()),
        state_(topology.graph().passes.size(), State::New) {
    for (std::size_t i = 0; i < edges_.size(); ++i) outgoing_[edges_[i].before].push_back(i);
  }

  std::vector<std::vector<Dependency>> run() {
    for (const std::uint32_t pass : topology_.passesByName()) {
      if (state_[pass] == State::New) visit(pass);
    }
    return std::move(cycles_);
  }

 private:
  enum class State : std::uint8_t { New, Open, Done };

  /// Depth-first search with a stack of its own: chains of passes can be too long for recursion.
  void visit(std::uint32_t root) {
    struct Frame {
      std::uint32_t pass;
      std::size_t next;
    };
    std::vector<Frame> frames{{root, 0}};
    std::vector<std::size_t> path;
    state_[root] = State::Open;
    while (!frames.empty()) {
      Frame& frame = frames.back();
      if (frame.next == outgoing_[frame.pass].size()) {
        state_[frame.pass] = State::Done;
        frames.pop_back();
        if (!path.empty()) path.pop_back();
        continue;
      }
      const std::size_t edge = outgoing_[frame.pass][frame.next++];
      const std::uint32_t target = edges_[edge].after;
      if (state_[target] == State::Open) addCycle(path, edge);
      if (state_[target] != State::New) continue;
      state_[target] = State::Open;
      path.push_back(edge);
      frames.push_back({target, 0});
    }
  }

  void addCycle(const std::vector<std::size_t>& path, std::size_t closing) {
    std::vector<Dependency> cycle;
    const std::uint32_t start = edges_[closing].after;
    bool inside = false;
    for (const std::size_t edge : path) {
      inside = inside || edges_[edge].before == start;
      if (inside) cycle.push_back(edges_[edge]);
    }
    cycle.push_back(edges_[closing]);
    const bool known = std::ranges::any_of(cycle, [&](const Dependency& edge) { return reported_[edge.before]; });
    for (const Dependency& edge : cycle) reported_[edge.before] = true;
    if (!known) cycles_.push_back(std::move(cycle));
  }

  const Topology& topology_;
  std::vector<Dependency> edges_;
  std::vector<std::vector<std::size_t>> outgoing_;
  std::vector<State> state_;
  std::vector<bool> reported_ = std::vector<bool>(state_.size());
  std::vector<std::vector<Dependency>> cycles_;
};

std::string describe(const GraphDesc& graph, const std::vector<Dependency>& cycle) {
  std::string text = "'" + graph.passes[cycle.front().before].name + "'";
  for (const Dependency& edge : cycle) {
    text += " -> '" + graph.passes[edge.after].name + "' (";
    switch (edge.kind) {
      case DependencyKind::ReadAfterWrite:
        text += "reads";
        break;
      case DependencyKind::WriteAfterRead:
        text += "overwrites";
        break;
      case DependencyKind::WriteAfterWrite:
        text += "replaces";
        break;
    }
    text += " '" + graph.resources[edge.resource].name + "' v" + std::to_string(edge.version) + ")";
  }
  return text;
}

const AccessDecl& readOf(const PassDecl& pass, const Dependency& edge) {
  return *std::ranges::find_if(pass.accesses, [&](const AccessDecl& access) {
    return access.resource == edge.resource && access.readVersion == edge.version;
  });
}

}  // namespace

void checkOrder(const Topology& topology, Findings& findings) {
  const GraphDesc& graph = topology.graph();
  for (const std::vector<Dependency>& cycle : CycleSearch(topology).run()) {
    const auto stale = std::ranges::find(cycle, DependencyKind::WriteAfterRead, &Dependency::kind);
    if (stale == cycle.end()) {
      findings.error(code::kCycle, graph.passes[cycle.front().before],
                     "passes wait for each other: " + describe(graph, cycle) +
                         "; read last frame's contents through a history, or another texture");
      continue;
    }
    const PassDecl& pass = graph.passes[stale->before];
    findings.error(code::kStaleVersionRead, pass, readOf(pass, *stale),
                   "pass '" + pass.name + "' reads version " + std::to_string(stale->version) + " of '" +
                       graph.resources[stale->resource].name + "' after pass '" + graph.passes[stale->after].name +
                       "' has overwritten it: " + describe(graph, cycle) +
                       "; read the newer version, or write to another texture");
  }
}

}  // namespace fg
