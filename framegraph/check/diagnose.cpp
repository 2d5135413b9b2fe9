#include "framegraph/check/diagnose.h"

#include <algorithm>
#include <tuple>

#include "framegraph/check/checks.h"

namespace fg {

std::string toText(const Diagnostic& diagnostic) {
  return std::string(diagnostic.where.file_name()) + ":" + std::to_string(diagnostic.where.line()) + ": " +
         (diagnostic.severity == Severity::Error ? "error " : "warning ") + diagnostic.code + ": " + diagnostic.message;
}

std::vector<Diagnostic> diagnose(const Topology& topology, const MemoryModel& memory) {
  Findings findings(topology.graph());
  checkResources(topology, memory, findings);
  checkPasses(topology, findings);
  checkVersions(topology, findings);
  checkOrder(topology, findings);
  checkShaders(topology, findings);
  std::vector<Diagnostic> list = findings.take();
  std::ranges::stable_sort(list, {}, [](const Diagnostic& diagnostic) {
    return std::tie(diagnostic.code, diagnostic.pass, diagnostic.resource, diagnostic.message);
  });
  return list;
}

std::vector<Diagnostic> diagnoseReplacement(const GraphDesc& before, const GraphDesc& after,
                                            std::span<const std::string> resets) {
  Findings findings(after);
  for (const HistoryDecl& history : after.histories) {
    const auto old = std::ranges::find(before.histories, history.name, &HistoryDecl::name);
    if (old == before.histories.end() || std::ranges::find(resets, history.name) != resets.end()) continue;
    const ResourceDecl& current = after.resources[history.current];
    if (before.resources[old->current].desc == current.desc) continue;
    findings.error(code::kHistoryChanged, current,
                   "the description of history '" + history.name +
                       "' differs from that of the last frame; reset the history with the change");
  }
  return findings.take();
}

}  // namespace fg
