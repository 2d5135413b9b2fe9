#include "tests/costs/method_costs.h"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "framegraph/compile/compile.h"
#include "integration/denoise_graph.h"
#include "passes/methods/denoiser.h"
#include "samples/estimate/frame_estimate.h"
#include "samples/estimate/plan_work.h"

namespace walr::costs {
namespace {

PassCosts costsOf(const PassWork& work, NullDevice& device, const TripCounts& trips) {
  PassCosts costs;
  costs.pass = work.pass;
  costs.batch = work.batch;
  costs.shader = work.dispatch->shader->name;
  costs.specialization = work.dispatch->specialization;
  costs.groups = work.groups;
  costs.threads = work.threads;
  costs.bytes = work.bytes;
  costs.compiled = device.compile(*work.dispatch);
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
  std::vector<std::string> presets = denoiser->presets();
  if (colon != std::string::npos) {
    presets = {text.substr(colon + 1)};
    denoiser->usePreset(presets.front());
  }
  if (presets.empty()) presets.emplace_back();
  std::vector<MethodName> names;
  for (const std::string& preset : presets)
    for (const test::LightSet& lights : test::lightSetsOf(*denoiser)) names.push_back({method, preset, lights});
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

std::optional<Bounds> PassCosts::boundsOn(const Machine& machine) const {
  if (!wave) return std::nullopt;
  return walr::boundsOn(machine, *wave, static_cast<double>(threads), static_cast<double>(compiled.waves),
                        static_cast<double>(bytes));
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

std::optional<double> MethodCosts::microseconds(const Machine& machine) const {
  FrameEstimate estimate;
  for (const PassCosts& pass : passes) estimate.add(pass.batch, pass.boundsOn(machine));
  return estimate.microseconds();
}

MethodCosts methodCosts(const MethodName& name, fg::Extent extent, NullDevice& device, const TripCounts& trips) {
  const auto method = makeDenoiser(name.method);
  if (!name.preset.empty()) method->usePreset(name.preset);
  const DenoiseGraph declared =
      declareDenoiseGraph(name.lights.denoisedBy(*method), extent, InputConventions{}, kComputeHost);
  const fg::GraphDesc& graph = declared.graph.desc();
  const fg::CompileResult result = fg::compile(graph, fg::TableMemoryModel());
  if (!result.ok())
    throw std::runtime_error("the frame graph of " + name.text() + " does not compile:\n" + result.text());

  const fg::MemoryReport& memory = result.plan.memory;
  MethodCosts costs = {name, extent, {}, memory.persistentBytes + memory.transientPeakBytes};
  for (const PassWork& work : workOf(graph, result.plan)) {
    costs.passes.push_back(costsOf(work, device, trips));
  }
  return costs;
}

}  // namespace walr::costs
