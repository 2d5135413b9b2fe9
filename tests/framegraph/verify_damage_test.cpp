#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "framegraph/compile/compile.h"
#include "framegraph/inspect/inspect.h"
#include "framegraph/verify/verify.h"
#include "tests/framegraph/test_shaders.h"

/// Plans that are damaged in one way each, with the fault that the verifier must find. The random damages of the fuzz
/// test leave these parts of a plan as they are.
namespace fg::verify_damage_test {
namespace {

using test::kColor;
using test::recordNothing;

/// The host waits for the frame by other means, so that the verifier checks its image without an access of the host.
constexpr ExternalState kWaitedFor = {VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};

/// Of four passes the first two form a batch. The last two read the same, and write one texture after the other.
class VerifyDamage : public ::testing::Test {
 protected:
  VerifyDamage() {
    input_ = graph_.import("input", kColor, test::kSampled);
    auto left = graph_.callback("left", recordNothing);
    left.sample("in", input_);
    left_ = left.store("out", graph_.texture("left half", kColor));
    auto right = graph_.callback("right", recordNothing);
    right.sample("in", input_);
    sums_ = right.store("out", graph_.buffer("sums", {256}));
    auto first = graph_.callback("first", recordNothing).sideEffects();
    first.sample("left", left_).load("sums", sums_);
    const Texture once = first.store("out", graph_.texture("output", kColor));
    auto second = graph_.callback("second", recordNothing);
    second.sample("left", left_).load("sums", sums_);
    output_ = second.store("out", once);
    graph_.exported(output_, kWaitedFor);
    CompileResult result = compile(graph_.desc(), TableMemoryModel());
    EXPECT_TRUE(result.ok()) << result.text();
    plan_ = std::move(result.plan);
  }

  struct Damage {
    std::string fault;  ///< How the text of the fault ends.
    std::function<void(Plan&)> apply;
  };
  void expectFaults(const std::vector<Damage>& damages) const {
    for (const Damage& damage : damages) {
      Plan plan = plan_;
      damage.apply(plan);
      const std::vector<std::string> found = verify(graph_.desc(), plan);
      EXPECT_TRUE(std::ranges::any_of(found, [&](const std::string& text) { return text.ends_with(damage.fault); }))
          << "wanted: " << damage.fault << "\ngot " << found.size() << (found.empty() ? "" : ": " + found.front());
    }
  }

  static PlannedResource& of(Plan& plan, ResourceVersion resource) { return plan.resources[resource.resource]; }
  static PlannedHeap& heapOf(Plan& plan, ResourceVersion resource) { return plan.heaps.at(of(plan, resource).heap); }
  /// The first barrier on a resource in a list.
  static PlannedBarrier& on(std::vector<PlannedBarrier>& barriers, ResourceVersion resource) {
    const auto found = std::ranges::find(barriers, resource.resource, &PlannedBarrier::resource);
    EXPECT_NE(found, barriers.end());
    return found != barriers.end() ? *found : barriers.at(0);
  }

  Graph graph_;
  Texture input_;
  Texture left_;
  Buffer sums_;
  Texture output_;
  Plan plan_;
};

TEST_F(VerifyDamage, NoneHasNoFault) {
  EXPECT_EQ(verify(graph_.desc(), plan_), std::vector<std::string>{}) << toText(graph_.desc(), plan_);
  ASSERT_EQ(plan_.passes.size(), 4U);
  EXPECT_EQ(plan_.passes[1].batch, 0U);
  EXPECT_EQ(graph_.desc().passes[plan_.passes[2].pass].name, "first");
}

TEST_F(VerifyDamage, OfTheListOfPassesIsFound) {
  expectFaults({
      {"pass 1 has barriers inside its batch", [](Plan& plan) { plan.passes[1].barriers = plan.passes[0].barriers; }},
      {"pass 'first' has side effects, but is culled",
       [](Plan& plan) {
         plan.culled.push_back({plan.passes[2].pass, "nobody needs it"});
         plan.passes.erase(plan.passes.begin() + 2);
       }},
      {"export 'output' does not hold what was declared",
       [](Plan& plan) { std::swap(plan.passes[2].pass, plan.passes[3].pass); }},
  });
}

TEST_F(VerifyDamage, OfAResourceIsFound) {
  expectFaults({
      {"'left half' lacks usage flags",
       [&](Plan& plan) { of(plan, left_).imageUsage &= ~VkFlags{VK_IMAGE_USAGE_SAMPLED_BIT}; }},
      {"'sums' lacks usage flags", [&](Plan& plan) { of(plan, sums_).bufferUsage = 0; }},
      {"'output' lacks usage flags of the layout in which it is released",
       [&](Plan& plan) { of(plan, output_).imageUsage &= ~VkFlags{VK_IMAGE_USAGE_TRANSFER_SRC_BIT}; }},
      {"'left half' is used, but marked unused", [&](Plan& plan) { of(plan, left_).used = false; }},
  });
}

TEST_F(VerifyDamage, OfAPlaceInAHeapIsFound) {
  expectFaults({
      {"'left half' reaches past the end of its heap",
       [&](Plan& plan) { heapOf(plan, left_).size = of(plan, left_).offset + of(plan, left_).size - 1; }},
      {"'left half' is misaligned", [&](Plan& plan) { of(plan, left_).offset += 1; }},
      {"'left half' is misaligned", [&](Plan& plan) { of(plan, left_).alignment = 0; }},
      {"'left half' is in a type of memory that it cannot use",
       [&](Plan& plan) { of(plan, left_).memoryTypeBits = 1; }},
      {"'output' must not share memory", [&](Plan& plan) { of(plan, output_).heap = of(plan, left_).heap; }},
      {"'input' must not share memory", [&](Plan& plan) { of(plan, input_).heap = of(plan, left_).heap; }},
  });
}

TEST_F(VerifyDamage, OfTheLayoutOfABarrierIsFound) {
  expectFaults({
      {"'left half' has a barrier with the wrong new layout",
       [&](Plan& plan) { on(plan.passes[2].barriers, left_).newLayout = VK_IMAGE_LAYOUT_UNDEFINED; }},
      {"'sums' has a barrier with the wrong new layout",
       [&](Plan& plan) { on(plan.passes[2].barriers, sums_).newLayout = VK_IMAGE_LAYOUT_GENERAL; }},
      {"'output' has a barrier with the wrong new layout",
       [&](Plan& plan) { on(plan.releases, output_).newLayout = VK_IMAGE_LAYOUT_UNDEFINED; }},
  });
}

}  // namespace
}  // namespace fg::verify_damage_test
