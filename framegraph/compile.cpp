#include "framegraph/compile.h"

#include <algorithm>

#include "framegraph/access_history.h"
#include "framegraph/alias.h"
#include "framegraph/cull.h"
#include "framegraph/diagnostic_codes.h"
#include "framegraph/lifetimes.h"
#include "framegraph/report.h"
#include "framegraph/requirements.h"
#include "framegraph/schedule.h"
#include "framegraph/synchronize.h"
#include "framegraph/topology.h"

namespace fg {

namespace {

Diagnostic withoutEffect(const PassDecl& pass, const CulledPass& culled) {
  return {std::string(code::kPassWithoutEffect),
          Severity::Warning,
          pass.name,
          {},
          "pass '" + pass.name + "' is culled: " + culled.reason,
          pass.where};
}

}  // namespace

bool CompileResult::ok() const {
  return std::ranges::none_of(diagnostics, [](const Diagnostic& d) { return d.severity == Severity::Error; });
}

std::string CompileResult::text() const {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics) text += toText(diagnostic) + "\n";
  return text;
}

CompileResult compile(const GraphDesc& graph, const MemoryModel& memory, const CompileOptions& options) {
  CompileResult result;
  Plan& plan = result.plan;
  const Topology topology(graph);
  result.diagnostics = diagnose(topology, memory);
  if (!result.ok()) return result;

  Culling culling = cull(topology);
  plan.resources = requirements(graph, culling, memory);
  const std::vector<std::uint32_t> order = schedule(topology, culling, plan.resources);
  for (const std::uint32_t pass : order) plan.passes.push_back({pass, {}});
  plan.culled = std::move(culling.culled);
  findLifetimes(graph, order, plan.resources);
  const AccessHistory accesses(graph, plan);
  placeTransients(topology, accesses, memory.bufferImageGranularity(), options.lendHistories, plan);
  synchronize(topology, accesses, plan);
  report(graph, plan);
  for (const CulledPass& culled : plan.culled)
    result.diagnostics.push_back(withoutEffect(graph.passes[culled.pass], culled));
  return result;
}

}  // namespace fg
