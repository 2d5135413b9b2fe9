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
  // checkVersions allocates a mark for each mip level and layer: too many if a resource exceeds the limits.
  if (!findings.has(code::kTooLarge)) checkVersions(topology, findings);
  checkOrder(topology, findings);
  checkShaders(topology, findings);
  std::vector<Diagnostic> list = findings.take();
  std::ranges::stable_sort(list, {}, [](const Diagnostic& diagnostic) {
    return std::tie(diagnostic.code, diagnostic.pass, diagnostic.resource, diagnostic.message);
  });
  return list;
}

}  // namespace fg
