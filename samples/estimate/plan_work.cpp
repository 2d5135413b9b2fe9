#include "samples/estimate/plan_work.h"

#include <stdexcept>

#include "framegraph/compile/report.h"

namespace walr {
namespace {

/// Traffic of one pass, as `fg::compile` counts it for a whole plan.
std::uint64_t passBytes(const fg::GraphDesc& graph, const fg::PlannedPass& pass) {
  fg::Plan alone;
  alone.passes = {pass};
  alone.resources.resize(graph.resources.size());
  fg::report(graph, alone);
  return alone.traffic.bytesRead + alone.traffic.bytesWritten;
}

bool samePipeline(const fg::ComputeDispatch& a, const fg::ComputeDispatch& b) {
  return a.shader == b.shader && a.specialization == b.specialization;
}

}  // namespace

std::vector<PassWork> workOf(const fg::GraphDesc& graph, const fg::Plan& plan) {
  std::vector<PassWork> work;
  for (std::size_t i = 0; i < plan.passes.size(); ++i) {
    const fg::PassDecl& pass = graph.passes[plan.passes[i].pass];
    const auto* dispatch = std::get_if<fg::ComputeDispatch>(&pass.work);
    if (dispatch == nullptr) throw std::runtime_error("pass '" + pass.name + "' is no dispatch of a compute shader");
    if (dispatch->indirect.valid()) {
      throw std::runtime_error("pass '" + pass.name + "' has no known number of work groups");
    }
    if (work.empty() || !samePipeline(*work.back().dispatch, *dispatch)) {
      work.push_back({.pass = pass.name, .batch = plan.passes[i].batch, .dispatch = dispatch, .planned = {}});
    } else {
      work.back().pass = work.back().pass.substr(0, work.back().pass.find(" to ")) + " to " + pass.name;
    }
    PassWork& row = work.back();
    row.planned.push_back(i);
    const std::uint64_t groups = std::uint64_t{dispatch->groups[0]} * dispatch->groups[1] * dispatch->groups[2];
    const auto& local = dispatch->shader->localSize;
    row.groups += groups;
    row.threads += groups * local[0] * local[1] * local[2];
    row.bytes += passBytes(graph, plan.passes[i]);
  }
  return work;
}

}  // namespace walr
