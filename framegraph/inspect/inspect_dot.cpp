#include <algorithm>
#include <sstream>

#include "framegraph/declare/topology.h"
#include "framegraph/inspect/inspect.h"
#include "framegraph/plan/memory_places.h"

namespace fg {
namespace {

/// A quoted identifier or label.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

class DotWriter {
 public:
  DotWriter(const GraphDesc& graph, const Plan& plan) : graph_(graph), plan_(plan), topology_(graph) {}

  std::string run() {
    out_ << "digraph framegraph {\n  rankdir=LR;\n  node [fontname=\"sans-serif\"];\n";
    for (std::uint32_t i = 0; i < plan_.passes.size(); ++i) {
      const std::string& name = graph_.passes[plan_.passes[i].pass].name;
      out_ << "  " << quoted("pass " + name)
           << " [shape=box, style=filled, fillcolor=\"#f4d9a8\", label=" << quoted(std::to_string(i) + ": " + name)
           << "];\n";
    }
    for (const CulledPass& culled : plan_.culled) {
      const std::string& name = graph_.passes[culled.pass].name;
      out_ << "  " << quoted("pass " + name) << " [shape=box, style=dashed, label=" << quoted(name)
           << ", tooltip=" << quoted(culled.reason) << "];\n";
    }
    for (const std::uint32_t resource : topology_.resourcesByName()) writeVersions(resource);
    for (const HistoryDecl& history : byName()) {
      out_ << "  " << version(history.current, graph_.resources[history.current].versions) << " -> "
           << version(history.previous, 0) << " [style=dotted, label=\"next frame\"];\n";
    }
    out_ << "}\n";
    return out_.str();
  }

 private:
  [[nodiscard]] std::vector<HistoryDecl> byName() const {
    std::vector<HistoryDecl> histories = graph_.histories;
    std::ranges::sort(histories, {}, &HistoryDecl::name);
    return histories;
  }

  [[nodiscard]] std::string version(std::uint32_t resource, std::uint32_t number) const {
    return quoted(graph_.resources[resource].name + " v" + std::to_string(number));
  }

  void writeVersions(std::uint32_t resource) {
    for (std::uint32_t number = 0; number < topology_.versionCount(resource); ++number) {
      const VersionUses& uses = topology_.uses(resource, number);
      const std::string node = version(resource, number);
      if (uses.writer == kNone && uses.readers.empty()) continue;
      out_ << "  " << node << " [shape=ellipse";
      if (const std::string place = placeText(graph_, plan_, resource); !place.empty()) {
        out_ << ", tooltip=" << quoted(place);
      }
      out_ << "];\n";
      if (uses.writer != kNone) {
        out_ << "  " << quoted("pass " + graph_.passes[uses.writer].name) << " -> " << node << ";\n";
      }
      for (const std::uint32_t reader : uses.readers) {
        out_ << "  " << node << " -> " << quoted("pass " + graph_.passes[reader].name) << ";\n";
      }
    }
  }

  const GraphDesc& graph_;
  const Plan& plan_;
  Topology topology_;
  std::ostringstream out_;
};

}  // namespace

std::string toDot(const GraphDesc& graph, const Plan& plan) {
  return DotWriter(graph, plan).run();
}

}  // namespace fg
