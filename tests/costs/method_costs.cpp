#include "tests/costs/method_costs.h"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "framegraph/compile/compile.h"
#include "framegraph/compile/report.h"
#include "integration/denoise_graph.h"
#include "passes/denoiser.h"
#include "samples/bench/taps.h"
#include "tests/costs/machine.h"

namespace walr::costs {
namespace {

/// Traffic of one pass, as `fg::compile` counts it for a whole plan.
std::uint64_t passBytes(const fg::GraphDesc& graph, const fg::PlannedPass& pass) {
  fg::Plan alone;
  alone.passes = {pass};
  alone.resources.resize(graph.resources.size());
  fg::report(graph, alone);
  return alone.traffic.bytesRead + alone.traffic.bytesWritten;
}

PassCosts compiledCosts(const std::string& pass, const fg::ComputeDispatch& work, const NullDevice& device,
                        const TripCounts& trips) {
  PassCosts costs;
  costs.pass = pass;
  costs.shader = work.shader->name;
  costs.compiled = device.compile(work);
  const Listing listing(costs.compiled.assembly);
  costs.compiled.assembly.clear();
  costs.branches = branchInstructions(listing);
  costs.fetchInstructions = fetchInstructions(listing);
  costs.loops = listing.loops().size();
  if (const auto rounds = trips.of(costs.shader, costs.loops)) {
    costs.wave = countWave(listing, blockFrequencies(listing, *rounds));
  }
  return costs;
}

}  // namespace

std::vector<MethodName> methodsNamed(const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::string method = text.substr(0, colon);
  const auto denoiser = makeDenoiser(method);
  if (colon != std::string::npos) {
    denoiser->usePreset(text.substr(colon + 1));
    return {{method, text.substr(colon + 1)}};
  }
  std::vector<MethodName> names;
  for (const std::string& preset : denoiser->presets()) names.push_back({method, preset});
  if (names.empty()) names.push_back({method, ""});
  return names;
}

std::vector<MethodName> allMethods() {
  std::vector<MethodName> names;
  for (const std::string& method : denoiserNames()) std::ranges::move(methodsNamed(method), std::back_inserter(names));
  return names;
}

std::optional<double> PassCosts::cyclesPerWave() const {
  return wave ? std::optional(simdCycles(*wave)) : std::nullopt;
}

std::optional<double> MethodCosts::cyclesPerPixel(const PassCosts& pass) const {
  const auto cycles = pass.cyclesPerWave();
  if (!cycles) return std::nullopt;
  return *cycles * static_cast<double>(pass.threads) / 64.0 / pixels();
}

std::optional<double> MethodCosts::cyclesPerPixel() const {
  double sum = 0.0;
  for (const PassCosts& pass : passes) {
    const auto cycles = cyclesPerPixel(pass);
    if (!cycles) return std::nullopt;
    sum += *cycles;
  }
  return sum;
}

MethodCosts methodCosts(const MethodName& name, fg::Extent extent, const NullDevice& device, const TripCounts& trips) {
  const auto method = makeDenoiser(name.method);
  if (!name.preset.empty()) method->usePreset(name.preset);
  const DenoiseGraph declared = declareDenoiseGraph(*method, extent, InputConventions{}, kComputeHost);
  const fg::GraphDesc& graph = declared.graph.desc();
  const fg::CompileResult result = fg::compile(graph, fg::TableMemoryModel());
  if (!result.ok())
    throw std::runtime_error("the frame graph of " + name.text() + " does not compile:\n" + result.text());

  MethodCosts costs = {name, extent, {}};
  const fg::ComputeDispatch* previous = nullptr;
  for (const fg::PlannedPass& planned : result.plan.passes) {
    const fg::PassDecl& pass = graph.passes[planned.pass];
    const auto* work = std::get_if<fg::ComputeDispatch>(&pass.work);
    if (work == nullptr) throw std::runtime_error("pass '" + pass.name + "' is no dispatch of a compute shader");
    if (work->indirect.valid()) throw std::runtime_error("pass '" + pass.name + "' has no known number of work groups");
    const bool same =
        previous != nullptr && previous->shader == work->shader && previous->specialization == work->specialization;
    if (!same) costs.passes.push_back(compiledCosts(pass.name, *work, device, trips));
    previous = work;
    PassCosts& row = costs.passes.back();
    if (same) row.pass = row.pass.substr(0, row.pass.find(" to ")) + " to " + pass.name;
    const std::uint64_t groups = std::uint64_t{work->groups[0]} * work->groups[1] * work->groups[2];
    const auto& local = work->shader->localSize;
    row.groups += groups;
    row.threads += groups * local[0] * local[1] * local[2];
    row.bytes += passBytes(graph, planned);
    const auto taps = tapsPerPixel(graph, planned, extent);
    row.taps = taps && (!same || row.taps) ? std::optional(row.taps.value_or(0.0) + *taps) : std::nullopt;
  }
  return costs;
}

}  // namespace walr::costs
