#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "framegraph/compile/compile.h"
#include "framegraph/declare/same_topology.h"

namespace fg {
namespace {

/// Denoiser-like: every pass reads the three textures before it and writes one; every eighth carries a history.
Graph chain(std::int64_t passes) {
  constexpr TextureDesc kDesc = {VK_FORMAT_R16G16B16A16_SFLOAT, {1920, 1080}};
  constexpr ExternalState kSampled = {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                                      VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};
  Graph graph;
  std::vector<Texture> values = {graph.import("input", kDesc, kSampled)};
  for (std::int64_t i = 0; i < passes; ++i) {
    const std::string number = std::to_string(i);
    auto pass = graph.callback("pass" + number, [](const RecordContext&) {});
    for (std::size_t back = 1; back <= 3 && back <= values.size(); ++back) {
      pass.sample("in" + std::to_string(back), values[values.size() - back]);
    }
    if (i % 8 == 0) {
      const History history = graph.history("history" + number, kDesc);
      pass.sample("previous", history.previous);
      values.push_back(pass.store("out", history.current));
    } else {
      values.push_back(pass.store("out", graph.texture("texture" + number, kDesc)));
    }
  }
  graph.exported(values.back(), kSampled);
  return graph;
}

void compileChain(benchmark::State& state) {
  const Graph graph = chain(state.range(0));
  const TableMemoryModel memory;
  if (!compile(graph.desc(), memory).ok()) return state.SkipWithError("the graph does not compile");
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(compile(graph.desc(), memory));
  state.counters["time_per_pass"] = benchmark::Counter(
      static_cast<double>(state.range(0)), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
  state.SetComplexityN(state.range(0));
}
/// What a host pays to find out that a graph with other settings needs no compiling.
void compareUnchanged(benchmark::State& state) {
  const Graph graph = chain(state.range(0));
  const Graph again = chain(state.range(0));
  if (!sameTopology(graph.desc(), again.desc())) return state.SkipWithError("the graph is another");
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(sameTopology(graph.desc(), again.desc()));
  state.SetComplexityN(state.range(0));
}

BENCHMARK(compareUnchanged)->RangeMultiplier(10)->Range(10, 10'000)->Unit(benchmark::kMicrosecond)->Complexity();
BENCHMARK(compileChain)->RangeMultiplier(10)->Range(10, 10'000)->Unit(benchmark::kMicrosecond)->Complexity();

}  // namespace
}  // namespace fg

BENCHMARK_MAIN();
