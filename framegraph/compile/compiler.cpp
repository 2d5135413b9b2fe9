#include "framegraph/compile/compiler.h"

#include <algorithm>
#include <iterator>

#include "framegraph/declare/same_topology.h"

namespace fg {

const CompileResult& Compiler::compile(const GraphDesc& graph, std::span<const std::string> resets) {
  recompiled_ = !last_ || !sameTopology(*last_, graph);
  if (!recompiled_) return result_;
  result_ = fg::compile(graph, *memory_);
  if (lastWithoutErrors_) {
    std::ranges::move(diagnoseReplacement(*lastWithoutErrors_, graph, resets), std::back_inserter(result_.diagnostics));
  }
  if (result_.ok()) {
    lastWithoutErrors_ = graph;
    last_ = graph;
  } else {
    result_.plan = {};
    last_.reset();  // Errors are found again, and not with another call's resets.
  }
  return result_;
}

}  // namespace fg
