#include "framegraph/compile/compile.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "framegraph/declare/access.h"
#include "framegraph/inspect/inspect.h"
#include "framegraph/verify/verify.h"
#include "tests/framegraph/test_shaders.h"

namespace fg {
namespace {

using test::kColor;
using test::recordNothing;

TEST(HostStates, ShaderReadStandsForAllThatShadersRead) {
  constexpr VkPipelineStageFlags2 kStage = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
  EXPECT_EQ(imageUsageIn({kStage, VK_ACCESS_2_SHADER_READ_BIT, VK_IMAGE_LAYOUT_GENERAL}),
            VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT);
  EXPECT_EQ(imageUsageIn({kStage, VK_ACCESS_2_SHADER_READ_BIT, VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL}),
            VK_IMAGE_USAGE_SAMPLED_BIT);
  EXPECT_EQ(imageUsageIn({kStage, VK_ACCESS_2_SHADER_WRITE_BIT, VK_IMAGE_LAYOUT_GENERAL}), VK_IMAGE_USAGE_STORAGE_BIT);
  EXPECT_EQ(bufferUsageIn({kStage, VK_ACCESS_2_SHADER_READ_BIT, VK_IMAGE_LAYOUT_UNDEFINED}),
            VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  // Contents that the host gives up were sampled before; the layout of a buffer says nothing.
  EXPECT_EQ(imageUsageIn({kStage, VK_ACCESS_2_SHADER_READ_BIT, VK_IMAGE_LAYOUT_UNDEFINED}), VK_IMAGE_USAGE_SAMPLED_BIT);
  EXPECT_EQ(bufferUsageIn({kStage, VK_ACCESS_2_SHADER_READ_BIT, VK_IMAGE_LAYOUT_READ_ONLY_OPTIMAL}),
            VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
}

TEST(Requirements, UsageIsThatOfATextureOrOfABuffer) {
  Graph graph;
  const Texture texture = graph.texture("texture", kColor);
  const Buffer buffer = graph.buffer("buffer", {64});
  auto pass = graph.callback("both", recordNothing);
  graph.exported(pass.store("texture", texture), test::kSampled);
  graph.exported(pass.store("buffer", buffer), test::kSampled);
  const CompileResult result = compile(graph.desc(), TableMemoryModel());
  ASSERT_TRUE(result.ok()) << result.text();
  const PlannedResource& image = result.plan.resources[texture.resource];
  const PlannedResource& bytes = result.plan.resources[buffer.resource];
  EXPECT_NE(image.imageUsage, 0U);
  EXPECT_EQ(image.bufferUsage, 0U);
  EXPECT_NE(bytes.bufferUsage, 0U);
  EXPECT_EQ(bytes.imageUsage, 0U);
}

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

/// One pass that reads a texture and a buffer, and leaves two more bindings unread.
/// @param bind whether it says what is bound there
CompileResult compileUnread(bool bind) {
  Graph graph;
  auto maker = graph.callback("make", recordNothing);
  const Texture made = maker.store("out", graph.texture("made", kColor));
  const Buffer sums = maker.store("outSums", graph.buffer("sums", {256}));
  auto pass = graph.callback("filter", recordNothing);
  if (bind) pass.unread("motion", made).unread("moreSums", sums);
  pass.sample("light", made).load("sums", sums);
  graph.exported(pass.store("out", graph.texture("filtered", kColor)), test::kTransferSource);
  return compile(graph.desc(), TableMemoryModel());
}

TEST(Compile, WhatAPassLeavesUnreadCostsNothing) {
  const CompileResult bound = compileUnread(true);
  const CompileResult without = compileUnread(false);
  ASSERT_TRUE(bound.ok()) << bound.text();
  EXPECT_EQ(bound.plan, without.plan) << "the same barriers, memory and traffic";
  EXPECT_EQ(bound.plan.traffic.bytesRead, 64U * 32 * 8 + 256);
}

TEST(Compile, WhatAPassBindsTwiceCountsOnceAsRead) {
  constexpr TextureDesc kPyramid = {VK_FORMAT_R32_SFLOAT, {64, 32}, 2};
  constexpr std::uint64_t kBase = 64 * 32 * 4;
  constexpr SubresourceRange kFirst = {0, 1, 0, 1};
  constexpr SubresourceRange kSecond = {1, 1, 0, 1};
  Graph graph;
  const Texture input = graph.import("input", kPyramid, test::kSampled);
  const Texture other = graph.import("other", kPyramid, test::kSampled);
  auto pass = graph.callback("filter", recordNothing).sideEffects();
  const auto bytesRead = [&] { return compile(graph.desc(), TableMemoryModel()).plan.traffic.bytesRead; };
  pass.access(input, Access::SampledRead, kFirst);
  EXPECT_EQ(bytesRead(), kBase);
  pass.access(input, Access::SampledRead, kFirst);
  EXPECT_EQ(bytesRead(), kBase) << "the same level under another name";
  pass.access(input, Access::SampledRead, kSecond);
  EXPECT_EQ(bytesRead(), kBase + kBase / 4) << "another level of the texture";
  pass.access(other, Access::SampledRead, kFirst);
  EXPECT_EQ(bytesRead(), 2 * kBase + kBase / 4) << "the same level of another texture";
}

/// Passes "a" to "d", each of which writes a texture of its own, and "d" a second one; nobody reads what "a" writes.
/// "a" and "b" form a batch. The textures of "d" need the memory of both.
class UnreadWriteTest : public ::testing::Test {
 protected:
  UnreadWriteTest() {
    (void)graph_.callback("a", recordNothing).sideEffects().store("out", graph_.texture("unread", kColor));
    Texture value;
    for (const char* name : {"b", "c", "d"}) {
      auto pass = graph_.callback(name, recordNothing).sideEffects();
      if (value.valid()) pass.sample("in", value);
      value = pass.store("out", graph_.texture(std::string("of ") + name, kColor));
      if (name == std::string("d")) (void)pass.store("second", graph_.texture("second of d", kColor));
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

TEST(Culling, KeepsTheWriterOfAHistoryWhosePreviousImageIsOnlyExported) {
  Graph graph;
  const History history = graph.history("past", kColor);
  (void)graph.callback("write", recordNothing).store("out", history.current);
  graph.exported(history.previous, test::kSampled);
  const CompileResult result = compile(graph.desc(), TableMemoryModel());
  ASSERT_TRUE(result.ok()) << result.text();
  EXPECT_EQ(result.plan.passes.size(), 1U);
  EXPECT_EQ(verify(graph.desc(), result.plan), std::vector<std::string>{}) << toText(graph.desc(), result.plan);
}

// The host's next work on the image waits for its own stage only, so the plan leads from the write to this stage. There
// is no layout to return to.
TEST(Synchronize, GivesBackAnOverwrittenImportToItsStage) {
  constexpr VkPipelineStageFlags2 kHostStage = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
  Graph graph;
  auto pass = graph.callback("write", recordNothing).sideEffects();
  (void)pass.store("out", graph.import("scratch", kColor, {kHostStage, VK_ACCESS_2_NONE, VK_IMAGE_LAYOUT_UNDEFINED}));
  CompileResult result = compile(graph.desc(), TableMemoryModel());
  ASSERT_TRUE(result.ok()) << result.text();
  EXPECT_EQ(verify(graph.desc(), result.plan), std::vector<std::string>{});
  ASSERT_EQ(result.plan.releases.size(), 1U);
  const PlannedBarrier& release = result.plan.releases.front();
  EXPECT_EQ(release.srcStage, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT);
  EXPECT_EQ(release.srcAccess, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
  EXPECT_EQ(release.dstStage, kHostStage);
  EXPECT_EQ(release.newLayout, release.oldLayout);

  result.plan.releases.clear();
  EXPECT_FALSE(verify(graph.desc(), result.plan).empty());
}

TEST(Inspect, WritesNamesThatAreNotUtf8) {
  Graph graph;
  graph.exported(graph.callback("a\xff", recordNothing).store("out", graph.texture("b\xc3", kColor)), test::kSampled);
  const CompileResult result = compile(graph.desc(), TableMemoryModel());
  EXPECT_NE(toJson(graph.desc(), result.plan).find("a\xef\xbf\xbd"), std::string::npos);
}

TEST_F(UnreadWriteTest, IsMadeAvailableAfterItsPassAndHoldsItsMemoryUntilThen) {
  const std::uint32_t unread = plan_.passes[plan_.resources[0].firstUse].batch;
  ASSERT_LT(unread + 1, batchCount(plan_));
  const std::uint32_t retired = positionOf(plan_, BarrierReason::Retire);
  ASSERT_NE(retired, kNone);
  EXPECT_EQ(plan_.passes[retired].batch, unread + 1);
  EXPECT_EQ(plan_.memory.transientUnaliasedBytes, 5 * 64 * 32 * 8);
  EXPECT_EQ(plan_.memory.transientPeakBytes, 3 * 64 * 32 * 8);
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
