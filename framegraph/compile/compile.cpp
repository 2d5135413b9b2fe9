#include "framegraph/compile/compile.h"

#include <algorithm>

#include "framegraph/check/diagnostic_codes.h"
#include "framegraph/compile/access_history.h"
#include "framegraph/compile/alias.h"
#include "framegraph/compile/cull.h"
#include "framegraph/compile/lifetimes.h"
#include "framegraph/compile/report.h"
#include "framegraph/compile/requirements.h"
#include "framegraph/compile/schedule.h"
#include "framegraph/compile/synchronize.h"
#include "framegraph/declare/topology.h"

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

  // The table of writers and readers of each version of a resource. Later steps use it instead of the declarations.
  const Topology topology(graph);

  // Report all errors at once, before anything is planned: the later steps rely on a graph without errors.
  result.diagnostics = diagnose(topology, memory);
  if (!result.ok()) return result;

  // Drop passes whose results reach no export. They then cost no memory and no barrier.
  Culling culling = cull(topology);

  // Ask the memory model for the size of every remaining resource: the order of passes depends on sizes.
  plan.resources = requirements(graph, culling, memory);

  // Order the passes in as few batches as their dependencies allow, so that few transient bytes are alive at any time.
  // The number of a batch is the unit of time from here on.
  std::uint32_t batch = 0;
  for (const std::vector<std::uint32_t>& passes : schedule(topology, culling, plan.resources)) {
    for (const std::uint32_t pass : passes) plan.passes.push_back({pass, batch, {}});
    ++batch;
  }
  plan.culled = std::move(culling.culled);

  // Find the first and last pass that uses each resource. Resources that are used in different batches may share bytes.
  findLifetimes(graph, plan.passes, plan.resources);

  // Group accesses that need no barrier among themselves. Placement needs this before synchronization does, because a
  // write that nobody reads holds its bytes until a barrier has made it available.
  const AccessHistory accesses(graph, plan);

  // Give transients their offsets in shared heaps.
  placeTransients(topology, accesses, memory.bufferImageGranularity(), options.aliasHistories, plan);

  // Derive the barriers. This comes after placement, because a resource must wait for the previous owner of its
  // bytes.
  synchronize(topology, accesses, plan);

  // Sum up memory and traffic, and warn of every pass that is not executed.
  report(graph, plan);
  for (const CulledPass& culled : plan.culled)
    result.diagnostics.push_back(withoutEffect(graph.passes[culled.pass], culled));
  return result;
}

}  // namespace fg
