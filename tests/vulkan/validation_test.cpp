#include <algorithm>
#include <map>
#include <string>

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

TEST_F(ValidationTest, NoMessageIsLeftOutAsOneTooMany) {
  PlannedPass* pass = nullptr;
  findBarrier(BarrierReason::ReadAfterWrite, pass)->newLayout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
  std::map<std::string, int> count;
  for (int i = 0; i < 12; ++i) {
    for (const vk::Message& message : messagesOf(plan_)) ++count[message.id];
  }
  const auto most = std::ranges::max_element(count, {}, &std::pair<const std::string, int>::second);
  ASSERT_NE(most, count.end());
  EXPECT_GE(most->second, 12) << most->first;
}

/// Sends messages through the layer's messenger, as a layer does.
class MessageTest : public GpuTest {
 protected:
  void send(const char* id) {
    const auto submit = reinterpret_cast<PFN_vkSubmitDebugUtilsMessageEXT>(
        vk::openLoader()(instance().handle(), "vkSubmitDebugUtilsMessageEXT"));
    VkDebugUtilsMessengerCallbackDataEXT data{};
    data.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CALLBACK_DATA_EXT;
    data.pMessageIdName = id;
    data.pMessage = "sent by a test";
    submit(instance().handle(), VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT,
           VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT, &data);
  }
};

TEST_F(MessageTest, WhatADriverAsksForIsNone) {
  send("WARNING-vkGetDeviceProcAddr-device");
  EXPECT_TRUE(takeMessages().empty());
  send("VUID-vkGetDeviceProcAddr-device-parameter");
  EXPECT_EQ(takeMessages().size(), 1U);
}

}  // namespace
}  // namespace fg::test
