#include "framegraph/compile.h"

#include <algorithm>

#include "framegraph/alias.h"
#include "framegraph/cull.h"
#include "framegraph/lifetimes.h"
#include "framegraph/report.h"
#include "framegraph/requirements.h"
#include "framegraph/schedule.h"
#include "framegraph/synchronize.h"
#include "framegraph/topology.h"

namespace fg {

bool CompileResult::ok() const {
  return std::ranges::none_of(diagnostics, [](const Diagnostic& d) { return d.severity == Severity::Error; });
}

std::string CompileResult::text() const {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics) text += diagnostic.code + ": " + diagnostic.message + "\n";
  return text;
}

CompileResult compile(const GraphDesc& graph, const MemoryModel& memory) {
  CompileResult result;
  Plan& plan = result.plan;
  const Topology topology(graph);

  Culling culling = cull(topology);
  plan.resources = requirements(graph, culling, memory);
  const std::vector<std::uint32_t> order = schedule(topology, culling, plan.resources);
  for (const std::uint32_t pass : order) plan.passes.push_back({pass, {}});
  plan.culled = std::move(culling.culled);
  findLifetimes(graph, order, plan.resources);
  placeTransients(topology, memory.bufferImageGranularity(), plan);
  synchronize(topology, plan);
  report(graph, plan);
  return result;
}

}  // namespace fg
