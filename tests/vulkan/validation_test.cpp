#include <algorithm>

#include "tests/vulkan/gpu_fixture.h"
#include "tests/vulkan/graph_run.h"
#include "tests/vulkan/test_graphs.h"

namespace fg::test {
namespace {

/// Runs plans that are wrong on purpose, to show that the fixture catches such faults.
class ValidationTest : public GpuTest {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    chain(graph_, 0, 3);
    plan_ = compileFor(context(), graph_);
  }

  /// The messages of two frames of a plan.
  std::vector<vk::Message> messagesOf(const Plan& plan) {
    GraphRun run(device(), graph_, plan);
    run.frame();
    run.frame();
    return takeMessages();
  }

  static bool anyStartsWith(const std::vector<vk::Message>& messages, std::string_view prefix) {
    return std::ranges::any_of(messages, [&](const vk::Message& message) { return message.id.starts_with(prefix); });
  }

  std::vector<PlannedBarrier>::iterator findBarrier(BarrierReason reason, PlannedPass*& pass) {
    for (PlannedPass& candidate : plan_.passes) {
      const auto barrier = std::ranges::find(candidate.barriers, reason, &PlannedBarrier::reason);
      if (barrier == candidate.barriers.end()) continue;
      pass = &candidate;
      return barrier;
    }
    throw std::logic_error("the plan has no such barrier");
  }

  Graph graph_;
  Plan plan_;
};

TEST_F(ValidationTest, CorrectPlanCausesNoMessage) {
  EXPECT_TRUE(messagesOf(plan_).empty());
}

TEST_F(ValidationTest, DroppedExecutionDependencyIsCaught) {
  PlannedPass* pass = nullptr;
  const auto barrier = findBarrier(BarrierReason::ReadAfterWrite, pass);
  // The layout transition stays, so that nothing but the dependency is missing.
  barrier->srcStage = VK_PIPELINE_STAGE_2_NONE;
  barrier->srcAccess = VK_ACCESS_2_NONE;
  EXPECT_TRUE(anyStartsWith(messagesOf(plan_), "SYNC-HAZARD"));
}

TEST_F(ValidationTest, EveryDroppedReadBarrierIsCaught) {
  const Plan whole = plan_;
  int dropped = 0;
  for (std::size_t p = 0; p < whole.passes.size(); ++p) {
    for (std::size_t b = 0; b < whole.passes[p].barriers.size(); ++b) {
      if (whole.passes[p].barriers[b].reason != BarrierReason::ReadAfterWrite) continue;
      Plan broken = whole;
      auto& barriers = broken.passes[p].barriers;
      barriers.erase(barriers.begin() + static_cast<std::ptrdiff_t>(b));
      EXPECT_FALSE(messagesOf(broken).empty()) << "barrier " << b << " of pass " << p;
      ++dropped;
    }
  }
  EXPECT_EQ(dropped, 3) << "the chain has three reads after writes";
}

TEST_F(ValidationTest, WrongLayoutIsCaught) {
  PlannedPass* pass = nullptr;
  findBarrier(BarrierReason::ReadAfterWrite, pass)->newLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
  EXPECT_FALSE(messagesOf(plan_).empty());
}

}  // namespace
}  // namespace fg::test
