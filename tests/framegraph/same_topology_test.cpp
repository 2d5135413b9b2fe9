#include "framegraph/declare/same_topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "framegraph/compile/compile.h"
#include "tests/framegraph/random_graph.h"
#include "tests/framegraph/test_shaders.h"

namespace fg {
namespace {

using test::kColor;

constexpr std::array kBindings = {
    ShaderBinding{"source", 0, 0, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, true, false},
    ShaderBinding{"target", 0, 1, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, false, true, VK_FORMAT_R16G16B16A16_SFLOAT}};
constexpr std::array kConstants = {ShaderConstant{"kRadius", 0}};
constexpr Shader kBlur = {"filter", {}, kBindings, kConstants, 4, {8, 8, 1}};
constexpr Shader kOtherFilter = {"other", {}, kBindings, kConstants, 4, {8, 8, 1}};

/// What a host's settings may change.
struct Settings {
  float strength = 1;
  std::uint32_t radius = 2;
  Extent extent = kColor.extent;
  VkFilter filter = VK_FILTER_NEAREST;
  const Shader* shader = &kBlur;
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

bool sameTopologyAs(const Settings& settings) {
  return sameTopology(declare().desc(), declare(settings).desc());
}

TEST(SameTopology, IsThatOfAnUnchangedGraphAndOfValuesThatAreOnlyRecorded) {
  EXPECT_TRUE(sameTopologyAs({}));
  EXPECT_TRUE(sameTopologyAs({.strength = 0.5F, .radius = 7}));
  const TableMemoryModel memory;
  EXPECT_EQ(compile(declare({.strength = 0.5F, .radius = 7}).desc(), memory).plan,
            compile(declare().desc(), memory).plan);
}

TEST(SameTopology, IsAnotherForWhateverElseChanges) {
  const std::vector<Settings> changes = {
      {.extent = {128, 64}}, {.filter = VK_FILTER_LINEAR},       {.shader = &kOtherFilter},
      {.sideEffects = true}, {.release = test::kTransferSource},
  };
  for (std::size_t i = 0; i < changes.size(); ++i) EXPECT_FALSE(sameTopologyAs(changes[i])) << i;
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
      [](GraphDesc& graph) {
        static constexpr std::array<std::byte, 4> kContents{};
        return !graph.resources.empty() && (graph.resources.back().contents = kContents, true);
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
