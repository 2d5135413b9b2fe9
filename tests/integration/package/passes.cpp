// A host that adds a method to a graph of its own, from the installed C++ libraries.
#include <cstdio>

#include "framegraph/compile/compile.h"
#include "integration/denoise_graph.h"
#include "integration/registry.h"

int main() {
  const auto method = walr::makeDenoiser("walr");
  const walr::DenoiseGraph declared = walr::declareDenoiseGraph(*method, {640, 360}, {}, walr::kComputeHost);
  const fg::CompileResult compiled = fg::compile(declared.graph.desc(), fg::TableMemoryModel());
  std::printf("%zu pass types, %zu passes\n", walr::passTypes().size(), compiled.plan.passes.size());
  return compiled.ok() && !compiled.plan.passes.empty() ? 0 : 1;
}
