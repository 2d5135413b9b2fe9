#include "framegraph/compile/compiler.h"
#include "framegraph/declare/same_topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

#include "framegraph/check/diagnostic_codes.h"
#include "tests/framegraph/random_graph.h"
#include "tests/framegraph/test_shaders.h"

namespace fg {
namespace {

using test::kColor;

constexpr std::array kBindings = {
    ShaderBinding{"source", 0, 0, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, true, false},
    ShaderBinding{"target", 0, 1, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, false, true, VK_FORMAT_R16G16B16A16_SFLOAT}};
constexpr std::array kConstants = {ShaderConstant{"kRadius", 0}};
constexpr Shader kFilter = {"filter", {}, kBindings, kConstants, 4, {8, 8, 1}};
constexpr Shader kOtherFilter = {"other", {}, kBindings, kConstants, 4, {8, 8, 1}};

/// What a host's settings may change.
struct Settings {
  float strength = 1;
  std::uint32_t radius = 2;
  Extent extent = kColor.extent;
  VkFilter filter = VK_FILTER_NEAREST;
  const Shader* shader = &kFilter;
  bool sideEffects = false;
  ExternalState release = test::kSampled;
};

Graph declare(const Settings& settings = {}) {
  const TextureDesc desc = {kColor.format, settings.extent};
  Graph graph;
  const History history = graph.history("past", desc);
  auto mix = graph.callback("mix", test::recordNothing);
  mix.sample("previous", history.previous);
  const Texture current = mix.store("current", history.current);
  auto pass = graph.compute("filter", *settings.shader);
  pass.sample("source", current, settings.filter)
      .constants(settings.strength)
      .specialize("kRadius", settings.radius)
      .dispatch(settings.extent);
  if (settings.sideEffects) pass.sideEffects();
  graph.exported(pass.store("target", graph.texture("filtered", desc)), settings.release);
  return graph;
}

class CompilerTest : public ::testing::Test {
 protected:
  TableMemoryModel memory_;
  Compiler compiler_{memory_};
};

TEST_F(CompilerTest, DoesNotCompileAnUnchangedGraphAgain) {
  const Plan plan = compiler_.compile(declare().desc()).plan;
  EXPECT_TRUE(compiler_.recompiled());
  EXPECT_EQ(plan, compile(declare().desc(), memory_).plan);
  for (int frame = 0; frame < 3; ++frame) {
    EXPECT_EQ(compiler_.compile(declare().desc()).plan, plan);
    EXPECT_FALSE(compiler_.recompiled());
  }
}

TEST_F(CompilerTest, DoesNotCompileForValuesThatAreOnlyRecorded) {
  (void)compiler_.compile(declare().desc());
  (void)compiler_.compile(declare({.strength = 0.5F, .radius = 7}).desc());
  EXPECT_FALSE(compiler_.recompiled());
}

TEST_F(CompilerTest, CompilesWhateverElseChanges) {
  const std::vector<Settings> changes = {
      {.extent = {128, 64}}, {.filter = VK_FILTER_LINEAR},       {.shader = &kOtherFilter},
      {.sideEffects = true}, {.release = test::kTransferSource},
  };
  const std::array<std::string, 1> resets = {"past"};
  for (const Settings& change : changes) {
    (void)compiler_.compile(declare().desc(), resets);
    const CompileResult& result = compiler_.compile(declare(change).desc(), resets);
    EXPECT_TRUE(compiler_.recompiled());
    EXPECT_TRUE(result.ok()) << result.text();
    EXPECT_EQ(result.plan, compile(declare(change).desc(), memory_).plan);
  }
}

TEST_F(CompilerTest, RefusesAHistoryThatChangesWithoutAReset) {
  (void)compiler_.compile(declare().desc());
  const Settings larger = {.extent = {128, 64}};
  for (int attempt = 0; attempt < 2; ++attempt) {
    const CompileResult& result = compiler_.compile(declare(larger).desc());
    EXPECT_FALSE(result.ok());
    EXPECT_TRUE(result.plan.passes.empty());
    const auto found = std::ranges::find(result.diagnostics, code::kHistoryChanged, &Diagnostic::code);
    ASSERT_NE(found, result.diagnostics.end()) << result.text();
    EXPECT_EQ(found->resource, "past.current");
  }
  const std::array<std::string, 1> resets = {"past"};
  EXPECT_TRUE(compiler_.compile(declare(larger).desc(), resets).ok());
  EXPECT_TRUE(compiler_.compile(declare(larger).desc()).ok());
  EXPECT_FALSE(compiler_.recompiled());
}

TEST_F(CompilerTest, FindsErrorsAgain) {
  const Settings empty = {.extent = {0, 0}};
  for (int attempt = 0; attempt < 2; ++attempt) {
    EXPECT_FALSE(compiler_.compile(declare(empty).desc()).ok());
    EXPECT_TRUE(compiler_.recompiled());
  }
}

/// One change of every part of a random graph.
TEST(SameTopology, SeesEveryChangeOfADescription) {
  const std::vector<std::function<bool(GraphDesc&)>> changes = {
      [](GraphDesc& graph) { return !graph.passes.empty() && (graph.passes.pop_back(), true); },
      [](GraphDesc& graph) { return !graph.exports.empty() && (graph.exports.pop_back(), true); },
      [](GraphDesc& graph) { return !graph.passes.empty() && (graph.passes.back().name += "x", true); },
      [](GraphDesc& graph) { return !graph.resources.empty() && (graph.resources.front().name += "x", true); },
      [](GraphDesc& graph) {
        return !graph.exports.empty() && (graph.exports.back().release.stage ^= VK_PIPELINE_STAGE_2_COPY_BIT, true);
      },
      [](GraphDesc& graph) {
        if (graph.passes.empty() || graph.passes.front().accesses.empty()) return false;
        graph.passes.front().accesses.front().range.baseMip += 1;
        return true;
      },
      [](GraphDesc& graph) {
        return !graph.passes.empty() && (graph.passes.back().extent = {{8, 8}}, true);
      },
      [](GraphDesc& graph) { return !graph.histories.empty() && (graph.histories.back().name += "x", true); },
  };
  std::vector<int> made(changes.size());
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Graph graph = test::randomGraph(seed);
    EXPECT_TRUE(sameTopology(graph.desc(), test::randomGraph(seed).desc())) << "seed " << seed;
    for (std::size_t i = 0; i < changes.size(); ++i) {
      GraphDesc changed = graph.desc();
      if (!changes[i](changed)) continue;
      EXPECT_FALSE(sameTopology(graph.desc(), changed)) << "seed " << seed << ", change " << i;
      ++made[i];
    }
  }
  for (const int count : made) EXPECT_GT(count, 0);
}

}  // namespace
}  // namespace fg
