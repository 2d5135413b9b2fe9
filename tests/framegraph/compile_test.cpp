#include "framegraph/compile/compile.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "framegraph/inspect/inspect.h"
#include "framegraph/verify/verify.h"
#include "tests/framegraph/test_shaders.h"

namespace fg {
namespace {

using test::kColor;
using test::recordNothing;

TEST(Compile, ChainOfPassesSharesMemoryAndHasOneBarrierPerAccess) {
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
  // Two of a kind at a time, one of them where the history's last frame was.
  EXPECT_EQ(result.plan.memory.transientPeakBytes, 64 * 32 * 8);
}

/// One pass that samples a texture and leaves a second binding unread.
/// @param bind whether it says what is bound there
CompileResult compileUnread(bool bind) {
  Graph graph;
  const Texture made = graph.callback("make", recordNothing).store("out", graph.texture("made", kColor));
  auto pass = graph.callback("filter", recordNothing);
  if (bind) pass.unread("motion", made);
  pass.sample("light", made);
  graph.exported(pass.store("out", graph.texture("filtered", kColor)), test::kTransferSource);
  return compile(graph.desc(), TableMemoryModel());
}

TEST(Compile, WhatAPassLeavesUnreadCostsNothing) {
  const CompileResult bound = compileUnread(true);
  const CompileResult without = compileUnread(false);
  ASSERT_TRUE(bound.ok()) << bound.text();
  EXPECT_EQ(bound.plan, without.plan) << "the same barriers, memory and traffic";
  EXPECT_EQ(bound.plan.traffic.bytesRead, 64U * 32 * 8);
}

/// Passes "a" to "d", each of which writes a texture of its own; nobody reads what "a" writes.
class UnreadWriteTest : public ::testing::Test {
 protected:
  UnreadWriteTest() {
    (void)graph_.callback("a", recordNothing).sideEffects().store("out", graph_.texture("unread", kColor));
    Texture value;
    for (const char* name : {"b", "c", "d"}) {
      auto pass = graph_.callback(name, recordNothing).sideEffects();
      if (value.valid()) pass.sample("in", value);
      value = pass.store("out", graph_.texture(std::string("of ") + name, kColor));
    }
    CompileResult result = compile(graph_.desc(), TableMemoryModel());
    EXPECT_TRUE(result.ok()) << result.text();
    plan_ = std::move(result.plan);
  }
  /// Position in the plan of the only barrier with this reason; kNone if there is none.
  static std::uint32_t positionOf(const Plan& plan, BarrierReason reason) {
    for (std::uint32_t i = 0; i < plan.passes.size(); ++i) {
      if (std::ranges::count(plan.passes[i].barriers, reason, &PlannedBarrier::reason) == 1) return i;
    }
    return kNone;
  }
  Graph graph_;
  Plan plan_;
};

TEST_F(UnreadWriteTest, IsMadeAvailableAfterItsPassAndHoldsItsMemoryUntilThen) {
  const std::uint32_t unread = plan_.resources[0].firstUse;
  ASSERT_LT(unread + 1, plan_.passes.size());
  EXPECT_EQ(positionOf(plan_, BarrierReason::Retire), unread + 1);
  EXPECT_EQ(plan_.memory.transientUnaliasedBytes, 4 * 64 * 32 * 8);
  EXPECT_EQ(plan_.memory.transientPeakBytes, 2 * 64 * 32 * 8);
  EXPECT_TRUE(verify(graph_.desc(), plan_).empty());
}

TEST_F(UnreadWriteTest, IsAHazardForTheNextOwnerIfNothingMakesItAvailable) {
  std::erase_if(plan_.passes[positionOf(plan_, BarrierReason::Retire)].barriers,
                [](const PlannedBarrier& barrier) { return barrier.reason == BarrierReason::Retire; });
  const std::vector<std::string> faults = verify(graph_.desc(), plan_);
  ASSERT_FALSE(faults.empty());
  EXPECT_NE(faults.front().find("takes over the memory of 'unread'"), std::string::npos) << faults.front();
}

TEST_F(UnreadWriteTest, IsTheReasonWhyTheNextPassCannotUseItsMemory) {
  EXPECT_NE(whyNotAliased(graph_.desc(), plan_, "unread", "of b").find("nobody reads the last write"),
            std::string::npos)
      << whyNotAliased(graph_.desc(), plan_, "unread", "of b") << toText(graph_.desc(), plan_);
}

}  // namespace
}  // namespace fg
