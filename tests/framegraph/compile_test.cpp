#include "framegraph/compile.h"

#include <gtest/gtest.h>

#include "tests/framegraph/test_shaders.h"

namespace fg {
namespace {

using test::kColor;
using test::recordNothing;

TEST(Compile, ChainOfPassesSharesMemoryAndHasOneBarrierAnAccess) {
  Graph graph;
  const Texture input = graph.import("input", kColor, test::kSampled);
  const History history = graph.history("accumulated", kColor);
  auto accumulate = graph.callback("accumulate", recordNothing);
  accumulate.sample("input", input).sample("previous", history.previous);
  const Texture current = accumulate.store("current", history.current);
  Texture value = current;
  for (const char* name : {"a", "b", "c", "d"}) {
    auto pass = graph.callback(name, recordNothing);
    pass.sample("in", value);
    value = pass.store("out", graph.texture(std::string("t.") + name, kColor));
  }
  graph.exported(value, test::kTransferSource);
  const CompileResult result = compile(graph.desc(), TableMemoryModel());
  ASSERT_TRUE(result.ok()) << result.text();
  EXPECT_EQ(result.plan.memory.transientPeakBytes, 2 * 64 * 32 * 8);
}

}  // namespace
}  // namespace fg
