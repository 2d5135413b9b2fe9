#include <benchmark/benchmark.h>

#include "framegraph/compile/compile.h"
#include "framegraph/declare/same_topology.h"
#include "framegraph/verify/verify.h"
#include "tests/framegraph/chain_graph.h"

namespace fg {
namespace {

using test::chainGraph;

void compileChain(benchmark::State& state) {
  const Graph graph = chainGraph(state.range(0));
  const TableMemoryModel memory;
  if (!compile(graph.desc(), memory).ok()) return state.SkipWithError("the graph does not compile");
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(compile(graph.desc(), memory));
  state.counters["time_per_pass"] = benchmark::Counter(
      static_cast<double>(state.range(0)), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.SetComplexityN(state.range(0));
}

void verifyChain(benchmark::State& state) {
  const Graph graph = chainGraph(state.range(0));
  const CompileResult result = compile(graph.desc(), TableMemoryModel());
  if (!verify(graph.desc(), result.plan).empty()) return state.SkipWithError("the verifier refuses the plan");
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(verify(graph.desc(), result.plan));
  state.SetComplexityN(state.range(0));
}

/// What a host pays to find out that a graph with other settings needs no compiling.
void compareUnchanged(benchmark::State& state) {
  const Graph graph = chainGraph(state.range(0));
  const Graph again = chainGraph(state.range(0));
  if (!sameTopology(graph.desc(), again.desc())) return state.SkipWithError("the graph is another");
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(sameTopology(graph.desc(), again.desc()));
  state.SetComplexityN(state.range(0));
}

BENCHMARK(compareUnchanged)->RangeMultiplier(10)->Range(10, 10'000)->Unit(benchmark::kMicrosecond)->Complexity();
BENCHMARK(verifyChain)->RangeMultiplier(10)->Range(10, 10'000)->Unit(benchmark::kMicrosecond)->Complexity();
BENCHMARK(compileChain)->RangeMultiplier(10)->Range(10, 10'000)->Unit(benchmark::kMicrosecond)->Complexity();

}  // namespace
}  // namespace fg

BENCHMARK_MAIN();
