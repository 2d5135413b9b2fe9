#include "framegraph/inspect/inspect.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include <nlohmann/json.hpp>

#include "framegraph/compile/compile.h"
#include "framegraph/plan/names.h"
#include "tests/error_text.h"
#include "tests/framegraph/random_graph.h"
#include "tests/framegraph/test_shaders.h"

namespace fg {
namespace {

TEST(Inspect, JsonRoundTripsIntoAnyOrderOfRegistration) {
  constexpr std::uint64_t kGraphs = 300;
  for (std::uint64_t seed = 1; seed <= kGraphs; ++seed) {
    const Graph graph = test::randomGraph(seed);
    const GraphDesc other = test::shuffled(graph.desc(), seed);
    const Plan plan = compile(graph.desc(), TableMemoryModel()).plan;
    const std::string json = toJson(graph.desc(), plan);
    ASSERT_EQ(planFromJson(graph.desc(), json), plan) << "seed " << seed;
    const Plan otherPlan = compile(other, TableMemoryModel()).plan;
    ASSERT_EQ(toJson(other, otherPlan), json) << "seed " << seed;
    ASSERT_EQ(planFromJson(other, json), otherPlan) << "seed " << seed;
  }
}

TEST(Inspect, JsonThatIsNoPlanIsRejectedWithTheFaultNamed) {
  const GraphDesc empty;
  EXPECT_THROW(planFromJson(empty, "{"), std::invalid_argument);
  test::expectError([&] { planFromJson(empty, R"({"passes": [{"name": "ghost"}]})"); }, {"ghost"});
}

TEST(Inspect, FlagsWithoutANameAreHexadecimal) {
  EXPECT_EQ(stageNames(VK_PIPELINE_STAGE_2_BLIT_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT), "COMPUTE_SHADER|BLIT");
  EXPECT_EQ(stageNames(VkPipelineStageFlags2{1} << 60U), "0x1000000000000000");
  EXPECT_EQ(accessNames(VK_ACCESS_2_NONE), "NONE");
}

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

class InspectChainTest : public ::testing::Test {
 protected:
  InspectChainTest() {
    Texture value = graph_.import("input", test::kColor, test::kSampled);
    for (const char* name : {"a", "b", "c", "d"}) {
      auto pass = graph_.callback(name, test::recordNothing);
      pass.sample("in", value);
      value = pass.store("out", graph_.texture(std::string("t.") + name, test::kColor));
    }
    graph_.exported(value, test::kTransferSource);
    (void)graph_.callback("vain", test::recordNothing).store("out", graph_.texture("unseen", test::kColor));
    plan_ = compile(graph_.desc(), TableMemoryModel()).plan;
  }
  Graph graph_;
  Plan plan_;
};

TEST_F(InspectChainTest, JsonReportsMemoryAndTraffic) {
  const auto json = nlohmann::json::parse(toJson(graph_.desc(), plan_));
  constexpr std::uint64_t kBytes = 64 * 32 * 8;
  EXPECT_EQ(json["memory"]["transient_unaliased_bytes"], 3 * kBytes);
  EXPECT_EQ(json["memory"]["transient_peak_bytes"], 2 * kBytes);
  EXPECT_EQ(json["memory"]["transient_lower_bound_bytes"], 2 * kBytes);
  EXPECT_EQ(json["memory"]["persistent_bytes"], kBytes);
  // Four passes read and write eight bytes a pixel each.
  EXPECT_EQ(json["traffic"]["bytes_per_pixel"], 64.0);
  EXPECT_EQ(json["passes"].size(), 4U);
  EXPECT_EQ(json["textures"].size(), 6U);
}

TEST_F(InspectChainTest, DotHasEveryPassOnceAndTheCulledOneDashed) {
  const std::string dot = toDot(graph_.desc(), plan_);
  for (const char* edge :
       {"\"t.a v1\" -> \"pass b\"", "\"pass b\" -> \"t.b v1\"", "\"pass vain\" [shape=box, style=dashed"}) {
    EXPECT_NE(dot.find(edge), std::string::npos) << edge << "\n" << dot;
  }
  for (const char* name : {"a", "b", "c", "d", "vain"}) {
    EXPECT_EQ(occurrences(dot, "  \"pass " + std::string(name) + "\" ["), 1U) << name << "\n" << dot;
  }
  EXPECT_EQ(occurrences(dot, "shape=box"), 5U) << "no other pass\n" << dot;
  EXPECT_EQ(occurrences(dot, "style=dashed"), 1U) << "no other culled pass\n" << dot;
}

TEST_F(InspectChainTest, SvgHasARectangleForEveryTransient) {
  const std::string svg = toSvg(graph_.desc(), plan_);
  EXPECT_EQ(occurrences(svg, "<rect"), 3U);
}

TEST_F(InspectChainTest, WhyNamesTheReason) {
  const GraphDesc& desc = graph_.desc();
  EXPECT_NE(whyCulled(desc, plan_, "vain").find("'unseen' is read by no pass"), std::string::npos);
  EXPECT_NE(whyCulled(desc, plan_, "a").find("is executed"), std::string::npos);
  EXPECT_NE(whyBarriers(desc, plan_, "b").find("'t.a': ReadAfterWrite"), std::string::npos);
  EXPECT_NE(whyNotAliased(desc, plan_, "t.a", "t.b").find("alive at the same time"), std::string::npos);
  EXPECT_NE(whyNotAliased(desc, plan_, "t.a", "t.c").find("share memory"), std::string::npos);
  EXPECT_NE(whyNotAliased(desc, plan_, "t.a", "t.d").find("exported"), std::string::npos);
  EXPECT_NE(whyNotAliased(desc, plan_, "t.a", "ghost").find("declares no 'ghost'"), std::string::npos);
}

}  // namespace
}  // namespace fg
