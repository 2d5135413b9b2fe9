#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "framegraph/compile/compile.h"
#include "framegraph/compile/history_heaps.h"
#include "framegraph/inspect/inspect.h"
#include "framegraph/plan/memory_places.h"
#include "framegraph/verify/verify.h"
#include "tests/framegraph/random_graph.h"
#include "tests/framegraph/test_shaders.h"

/// Tests that transients use the memory of histories while that holds nothing.
namespace fg {
namespace {

using test::kColor;
using test::recordNothing;

constexpr std::uint64_t kBytes = 64 * 32 * 8;
constexpr TextureDesc kTwiceColor = {kColor.format, {64, 64}};

/// Of five passes the first reads `previous` and the third writes `current`. Four transients of half a history's size
/// live before, between and after these passes. The last one is written and never read.
class HistoryAliasingTest : public ::testing::Test {
 protected:
  HistoryAliasingTest() {
    history_ = graph_.history("history", kTwiceColor);
    auto a = graph_.callback("a", recordNothing);
    a.sample("in", history_.previous);
    before_ = a.store("out", graph_.texture("before", kColor));
    auto b = graph_.callback("b", recordNothing);
    b.sample("in", before_);
    across_ = b.store("out", graph_.texture("across", kColor));
    auto c = graph_.callback("c", recordNothing);
    c.sample("in", across_);
    current_ = c.store("out", history_.current);
    auto d = graph_.callback("d", recordNothing);
    d.sample("in", current_);
    after_ = d.store("out", graph_.texture("after", kColor));
    auto e = graph_.callback("e", recordNothing);
    e.access(after_, Access::TransferRead);
    unread_ = e.access(graph_.texture("unread", kColor), Access::TransferWrite);
    const Texture out = graph_.import("out", kColor, test::kTransferSource);
    graph_.exported(e.access(out, Access::TransferWrite), test::kTransferSource);
    plan_ = planOf();
  }

  Plan planOf(const CompileOptions& options = {}) {
    CompileResult result = compile(graph_.desc(), TableMemoryModel(), options);
    EXPECT_TRUE(result.ok()) << result.text();
    EXPECT_TRUE(verify(graph_.desc(), result.plan).empty()) << toText(graph_.desc(), result.plan);
    return std::move(result.plan);
  }
  PlannedResource& resource(Plan& plan, Texture texture) const { return plan.resources[texture.resource]; }
  /// The AliasHandOver barrier of a texture.
  PlannedBarrier& handOver(Plan& plan, Texture texture) const {
    for (PlannedPass& pass : plan.passes) {
      for (PlannedBarrier& barrier : pass.barriers) {
        if (barrier.resource == texture.resource && barrier.reason == BarrierReason::AliasHandOver) return barrier;
      }
    }
    throw std::logic_error("no AliasHandOver barrier of " + graph_.desc().resources[texture.resource].name);
  }
  [[nodiscard]] std::vector<std::uint32_t> aliasesOf(Texture texture) const {
    return aliasedHistoryImages(graph_.desc(), plan_, texture.resource);
  }

  Graph graph_;
  History history_;
  Texture before_;
  Texture across_;
  Texture current_;
  Texture after_;
  Texture unread_;
  Plan plan_;
};

TEST_F(HistoryAliasingTest, TransientsNeedNoMemoryBesidesTheHistory) {
  EXPECT_EQ(plan_.memory.persistentBytes, 2 * 2 * kBytes);
  EXPECT_EQ(plan_.memory.transientUnaliasedBytes, 4 * kBytes);
  EXPECT_EQ(plan_.memory.transientPeakBytes, 0U);
  EXPECT_EQ(plan_.memory.transientLowerBoundBytes, 0U);
  ASSERT_EQ(plan_.heaps.size(), 2U);
  EXPECT_EQ(plan_.heaps[0].size, 2 * kBytes);
  EXPECT_EQ(plan_.heaps[0].partner, 1U);
  EXPECT_EQ(plan_.heaps[1].partner, 0U);
}

TEST_F(HistoryAliasingTest, TransientsUseCurrentBeforeItsWriteAndPreviousAfterItsLastRead) {
  EXPECT_EQ(aliasesOf(before_), std::vector{history_.current.resource});
  for (const Texture late : {across_, after_, unread_}) {
    EXPECT_EQ(aliasesOf(late), std::vector{history_.previous.resource});
  }
}

TEST_F(HistoryAliasingTest, BarriersWaitForThePreviousOwnersAlsoInTheLastFrame) {
  // The owner before `across` is `previous` in this frame; that before `before` is a transient of the last frame.
  EXPECT_EQ(handOver(plan_, across_).aliasOf, history_.previous.resource);
  const std::uint32_t last = handOver(plan_, before_).aliasOf;
  EXPECT_TRUE(last == after_.resource || last == unread_.resource);
  EXPECT_EQ(handOver(plan_, before_).srcStage, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT);
  const PlannedBarrier& current = handOver(plan_, history_.current);
  EXPECT_EQ(current.aliasOf, before_.resource);
  EXPECT_EQ(current.srcStage, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT);
  EXPECT_EQ(current.oldLayout, VK_IMAGE_LAYOUT_UNDEFINED);
  ASSERT_EQ(std::ranges::count(plan_.releases, BarrierReason::Retire, &PlannedBarrier::reason), 1);
}

TEST_F(HistoryAliasingTest, CanBeSwitchedOff) {
  const Plan plan = planOf({.aliasHistories = false});
  EXPECT_EQ(plan.resources[history_.current.resource].heap, kNone);
  EXPECT_EQ(plan.resources[history_.previous.resource].heap, kNone);
  EXPECT_EQ(plan.memory.persistentBytes, plan_.memory.persistentBytes);
  EXPECT_EQ(plan.memory.transientPeakBytes, 2 * kBytes);
  EXPECT_EQ(plan.memory.transientLowerBoundBytes, 2 * kBytes);
}

TEST_F(HistoryAliasingTest, ExportedHistoriesAreNotAliased) {
  graph_.exported(current_, test::kSampled);
  plan_ = planOf();
  EXPECT_TRUE(aliasesOf(before_).empty());
  EXPECT_TRUE(aliasesOf(after_).empty());
  EXPECT_EQ(plan_.memory.transientPeakBytes, 2 * kBytes);
}

TEST_F(HistoryAliasingTest, InspectionNamesTheAliasedHistory) {
  const GraphDesc& desc = graph_.desc();
  const std::string place = placeText(desc, plan_, across_.resource);
  EXPECT_TRUE(place.starts_with("heap 1 [") && place.ends_with(") of history.previous")) << place;
  const std::string text = toText(desc, plan_);
  EXPECT_NE(text.find("Transient across: R16G16B16A16_SFLOAT 64x32, passes 1..2, " + place), std::string::npos) << text;
  EXPECT_NE(text.find("heap 1: 32768 bytes, swaps with heap 0 every frame"), std::string::npos) << text;
  EXPECT_NE(toDot(desc, plan_).find("tooltip=\"" + place), std::string::npos);
  EXPECT_NE(toSvg(desc, plan_).find(place), std::string::npos);
  EXPECT_NE(toJson(desc, plan_).find("\"aliases\": [\n        \"history.previous\""), std::string::npos);
  EXPECT_NE(whyBarriers(desc, plan_, "b").find("AliasHandOver of history.previous"), std::string::npos);
  EXPECT_NE(whyNotAliased(desc, plan_, "across", "history.previous").find("share memory"), std::string::npos);
  EXPECT_NE(whyNotAliased(desc, plan_, "across", "history.current").find("alive at the same time: batches 1 to 2 and"),
            std::string::npos);
  EXPECT_NE(whyNotAliased(desc, plan_, "history.current", "history.previous").find("only transients alias"),
            std::string::npos);
}

/// Plans that are wrong on purpose, with the expected faults.
TEST_F(HistoryAliasingTest, TheVerifierRejectsWrongPlans) {
  struct Damage {
    const char* what;
    std::function<void(Plan&)> apply;
    const char* complaint;
  };
  const auto unordered = [&](Texture texture) {
    return [this, texture](Plan& plan) { handOver(plan, texture).srcStage = VK_PIPELINE_STAGE_2_NONE; };
  };
  const std::vector<Damage> damages = {
      {"nothing waits for the last frame's transients", unordered(before_), "'before' takes over the memory of"},
      {"nothing waits for the reads of `previous`", unordered(across_), "takes over the memory of 'history.current'"},
      {"`current` waits for nothing", unordered(history_.current), "takes over the memory of 'before'"},
      {"nothing makes the last write of a frame available",
       [](Plan& plan) {
         std::erase_if(plan.releases, [](const PlannedBarrier& b) { return b.reason == BarrierReason::Retire; });
       },
       "takes over the memory of 'unread'"},
      {"a transient where `previous` is still to be read",
       [&](Plan& plan) { resource(plan, before_).heap = resource(plan, history_.previous).heap; },
       "does not hold what was declared"},
      {"a transient where `current` is written",
       [&](Plan& plan) { resource(plan, after_).heap = resource(plan, history_.current).heap; },
       "does not hold what was declared"},
      {"images that swap, but lie at different offsets",
       [&](Plan& plan) {
         for (PlannedHeap& heap : plan.heaps) heap.size += 4096;
         resource(plan, history_.previous).offset = 4096;
       },
       "'history.current' does not lie where its other image lies"},
      {"images in heaps that do not swap",
       [](Plan& plan) {
         for (PlannedHeap& heap : plan.heaps) heap.partner = kNone;
       },
       "'history.current' does not lie where its other image lies"},
      {"both images in one heap",
       [&](Plan& plan) { resource(plan, history_.previous).heap = resource(plan, history_.current).heap; },
       "'history.current' does not lie where its other image lies"},
      {"a heap that swaps alone", [](Plan& plan) { plan.heaps[1].partner = kNone; },
       "heap 0 swaps with a heap that does not swap with it"},
      {"heaps of two sizes", [](Plan& plan) { plan.heaps[1].size += 4096; }, "of another kind or size"},
  };
  for (const Damage& damage : damages) {
    Plan plan = plan_;
    damage.apply(plan);
    const std::vector<std::string> faults = verify(graph_.desc(), plan);
    EXPECT_TRUE(std::ranges::any_of(
        faults, [&](const std::string& fault) { return fault.find(damage.complaint) != std::string::npos; }))
        << damage.what << ": " << (faults.empty() ? "accepted" : faults.front());
  }
}

TEST(HistoryAliasing, NeverNeedsMoreMemoryThanWithoutAliasing) {
  constexpr std::uint64_t kGraphs = 2000;
  std::uint64_t saved = 0;
  for (std::uint64_t seed = 1; seed <= kGraphs; ++seed) {
    const Graph graph = test::randomGraph(seed, {4, 24});
    const CompileResult with = compile(graph.desc(), TableMemoryModel());
    const CompileResult without = compile(graph.desc(), TableMemoryModel(), {.aliasHistories = false});
    ASSERT_LE(with.plan.memory.transientPeakBytes, without.plan.memory.transientPeakBytes) << "seed " << seed;
    ASSERT_EQ(with.plan.memory.persistentBytes, without.plan.memory.persistentBytes) << "seed " << seed;
    saved += with.plan.memory.transientPeakBytes < without.plan.memory.transientPeakBytes ? 1 : 0;
  }
  EXPECT_GT(saved, kGraphs / 10) << "too few graphs in which aliasing histories saves memory";
}

TEST(HistoryHeaps, HistoriesLieInTheOrderOfTheirLastReads) {
  const HistoryHeaps heaps({{0, 64, 1, 3, 3}, {1, 30, 16, 0, 1}, {2, 16, 16, 1, 1}}, 4);
  ASSERT_EQ(heaps.members().size(), 3U);
  EXPECT_EQ(heaps.members()[0].history, 1U);
  EXPECT_EQ(heaps.members()[1].history, 2U);
  EXPECT_EQ(heaps.offset(1), 32U);
  EXPECT_EQ(heaps.size(), 48U + 64U);
}

/// Of two blocks of 60 bytes only one fits into 100 bytes, so that the excess is 60 and not 20. A block that is alive
/// while the history holds something does not fit either.
TEST(HistoryHeaps, ExcessCountsWholeBlocks) {
  const HistoryHeaps heaps({{0, 100, 1, 0, 0}}, 3);
  EXPECT_EQ(heaps.excess({{60, 1, 1, 1}, {60, 1, 1, 2}}, {1, 2}), (std::vector<std::uint64_t>{0, 60, 0}));
  EXPECT_EQ(heaps.excess({{60, 1, 1, 1}, {40, 1, 1, 2}}, {1, 2}), (std::vector<std::uint64_t>{0, 0, 0}));
  EXPECT_EQ(heaps.excess({{60, 1, 0, 1}}, {1}), (std::vector<std::uint64_t>{60, 60, 0}));
}

/// A write that no pass reads holds its bytes one pass longer, when `current` is already written.
TEST(HistoryHeaps, ExcessCountsBytesThatAreHeldTooLong) {
  const HistoryHeaps heaps({{0, 100, 1, 1, 1}}, 2);
  EXPECT_EQ(heaps.excess({{60, 1, 0, 0}}, {0}), (std::vector<std::uint64_t>{0, 0}));
  EXPECT_EQ(heaps.excess({{60, 1, 0, 0}}, {1}), (std::vector<std::uint64_t>{60, 0}));
}

}  // namespace
}  // namespace fg
