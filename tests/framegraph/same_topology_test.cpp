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

TEST(SameTopology, IsAnotherForSettingsThatChangeThePlan) {
  const std::vector<Settings> changes = {
      {.extent = {128, 64}}, {.filter = VK_FILTER_LINEAR},       {.shader = &kOtherFilter},
      {.sideEffects = true}, {.release = test::kTransferSource},
  };
  for (std::size_t i = 0; i < changes.size(); ++i) EXPECT_FALSE(sameTopologyAs(changes[i])) << i;
}

/// A graph that sets every part of a description. Its compute pass is the first.
GraphDesc withEveryPart() {
  static constexpr std::array<std::byte, 12> kArguments{};
  Graph graph;
  const Texture input = graph.import("input", kColor, test::kSampled);
  const Buffer arguments = graph.upload("arguments", kArguments);
  const History history = graph.history("past", kColor);
  (void)graph.history("other past", kColor);
  auto pass = graph.compute("filter", kBlur);
  pass.sample("source", input).unread("second", input).sample("previous", history.previous);
  const Texture once = pass.store("target", history.current);
  pass.constants(1.0F).historyAge(history, 0).specialize("kRadius", std::uint32_t{2}).specialize("kWidth", true);
  pass.texels(kColor.extent).dispatchIndirect(arguments, 0);
  auto plain = graph.compute("plain", kBlur);
  plain.sample("source", once).dispatch(kColor.extent);
  const Texture twice = plain.store("target", graph.texture("result", kColor));
  graph.callback("host", test::recordNothing).sample("source", twice).sideEffects();
  graph.exported(twice, test::kSampled);
  return graph.desc();
}

/// A change of one part of a description and nothing else.
struct Change {
  const char* part;
  std::function<void(GraphDesc&)> make;
};

ComputeDispatch& dispatchOf(GraphDesc& graph, std::size_t pass = 0) {
  return std::get<ComputeDispatch>(graph.passes.at(pass).work);
}

void expectAnother(const std::vector<Change>& changes) {
  const GraphDesc graph = withEveryPart();
  EXPECT_TRUE(sameTopology(graph, withEveryPart()));
  for (const Change& change : changes) {
    GraphDesc changed = graph;
    change.make(changed);
    EXPECT_FALSE(sameTopology(graph, changed)) << change.part;
    EXPECT_FALSE(sameTopology(changed, graph)) << change.part;
  }
}

TEST(SameTopology, IsAnotherForEachPartOfAResource) {
  static constexpr std::array<std::byte, 12> kElsewhere{};
  const auto change = [](auto make) {
    return [make](GraphDesc& graph) {  // The import has a state, and the upload contents.
      make(*std::ranges::find(graph.resources, "input", &ResourceDecl::name),
           *std::ranges::find(graph.resources, "arguments", &ResourceDecl::name));
    };
  };
  expectAnother({
      {"name", change([](ResourceDecl& input, ResourceDecl&) { input.name = "x"; })},
      {"format", change([](ResourceDecl& input, ResourceDecl&) {
         std::get<TextureDesc>(input.desc).format = VK_FORMAT_R32_SFLOAT;
       })},
      {"mip levels",
       change([](ResourceDecl& input, ResourceDecl&) { std::get<TextureDesc>(input.desc).mipLevels = 2; })},
      {"layers", change([](ResourceDecl& input, ResourceDecl&) { std::get<TextureDesc>(input.desc).arrayLayers = 2; })},
      {"size", change([](ResourceDecl&, ResourceDecl& upload) { std::get<BufferDesc>(upload.desc).size = 16; })},
      {"kind", change([](ResourceDecl& input, ResourceDecl&) { input.desc = BufferDesc{12}; })},
      {"lifetime", change([](ResourceDecl& input, ResourceDecl&) { input.lifetime = Lifetime::Transient; })},
      {"state", change([](ResourceDecl& input, ResourceDecl&) { input.acquire = test::kTransferSource; })},
      {"lack of a state", change([](ResourceDecl& input, ResourceDecl&) { input.acquire.reset(); })},
      {"history", change([](ResourceDecl& input, ResourceDecl&) { input.history = 0; })},
      {"versions", change([](ResourceDecl& input, ResourceDecl&) { ++input.versions; })},
      {"place of the contents", change([](ResourceDecl&, ResourceDecl& upload) { upload.contents = kElsewhere; })},
      {"size of the contents",
       change([](ResourceDecl&, ResourceDecl& upload) { upload.contents = upload.contents.first(8); })},
      {"one more", [](GraphDesc& graph) { graph.resources.emplace_back().name = "x"; }},
  });
}

TEST(SameTopology, IsAnotherForEachPartOfAnAccess) {
  const auto change = [](auto make) {
    return [make](GraphDesc& graph) { make(graph.passes.front().accesses.front()); };
  };
  expectAnother({
      {"resource", change([](AccessDecl& access) { ++access.resource; })},
      {"version read", change([](AccessDecl& access) { ++access.readVersion; })},
      {"version written", change([](AccessDecl& access) { access.writeVersion = 1; })},
      {"version replaced", change([](AccessDecl& access) { access.replacesVersion = 0; })},
      {"kind", change([](AccessDecl& access) { access.access = Access::StorageRead; })},
      {"first mip level", change([](AccessDecl& access) { access.range.baseMip = 1; })},
      {"mip levels", change([](AccessDecl& access) { access.range.mipCount = 1; })},
      {"first layer", change([](AccessDecl& access) { access.range.baseLayer = 1; })},
      {"layers", change([](AccessDecl& access) { access.range.layerCount = 1; })},
      {"binding", change([](AccessDecl& access) { access.binding = "x"; })},
      {"filter", change([](AccessDecl& access) { access.filter = VK_FILTER_LINEAR; })},
      {"whether it is unread", change([](AccessDecl& access) { access.unread = true; })},
      {"one less", [](GraphDesc& graph) { graph.passes.front().accesses.pop_back(); }},
  });
}

TEST(SameTopology, IsAnotherForEachPartOfAHistoryOrAnExport) {
  expectAnother({
      {"name", [](GraphDesc& graph) { graph.histories.front().name = "x"; }},
      {"previous image", [](GraphDesc& graph) { graph.histories.front().previous = graph.histories[1].previous; }},
      {"current image", [](GraphDesc& graph) { graph.histories.front().current = graph.histories[1].current; }},
      {"one history less", [](GraphDesc& graph) { graph.histories.pop_back(); }},
      {"exported resource", [](GraphDesc& graph) { graph.exports.front().resource.resource = 0; }},
      {"exported version", [](GraphDesc& graph) { ++graph.exports.front().resource.version; }},
      {"stage of the release", [](GraphDesc& graph) { graph.exports.front().release.stage = 0; }},
      {"access of the release", [](GraphDesc& graph) { graph.exports.front().release.access = 0; }},
      {"layout of the release",
       [](GraphDesc& graph) { graph.exports.front().release.layout = VK_IMAGE_LAYOUT_GENERAL; }},
      {"one export less", [](GraphDesc& graph) { graph.exports.pop_back(); }},
  });
}

TEST(SameTopology, IsAnotherForEachPartOfAPass) {
  expectAnother({
      {"name", [](GraphDesc& graph) { graph.passes.front().name = "x"; }},
      {"extent",
       [](GraphDesc& graph) {
         graph.passes.front().extent = Extent{8, 8};
       }},
      {"side effects", [](GraphDesc& graph) { graph.passes.front().sideEffects = true; }},
      {"one less", [](GraphDesc& graph) { graph.passes.pop_back(); }},
      {"kind of work", [](GraphDesc& graph) { graph.passes.front().work = HostCallback{}; }},
      {"shader", [](GraphDesc& graph) { dispatchOf(graph).shader = &kOtherFilter; }},
      {"constants that are set", [](GraphDesc& graph) { dispatchOf(graph).specialized.flip(); }},
      {"constants that the shader lacks", [](GraphDesc& graph) { dispatchOf(graph).unknownConstants.front() = "x"; }},
      {"size of the push constants", [](GraphDesc& graph) { dispatchOf(graph).constants.resize(8); }},
      {"age of no history", [](GraphDesc& graph) { dispatchOf(graph).historyAges.clear(); }},
      {"age of another history", [](GraphDesc& graph) { dispatchOf(graph).historyAges.front().history = 1; }},
      {"place of the age", [](GraphDesc& graph) { dispatchOf(graph).historyAges.front().offset = 4; }},
      {"buffer of the arguments", [](GraphDesc& graph) { ++dispatchOf(graph).indirect.resource; }},
      {"version of the arguments", [](GraphDesc& graph) { ++dispatchOf(graph).indirect.version; }},
      {"place of the arguments", [](GraphDesc& graph) { dispatchOf(graph).indirectOffset = 4; }},
      {"no work groups along x", [](GraphDesc& graph) { dispatchOf(graph, 1).groups[0] = 0; }},
      {"no work groups along y", [](GraphDesc& graph) { dispatchOf(graph, 1).groups[1] = 0; }},
      {"no work groups along z", [](GraphDesc& graph) { dispatchOf(graph, 1).groups[2] = 0; }},
  });
}

TEST(SameTopology, IsThatOfOtherValuesCountsCallbacksAndLines) {
  const GraphDesc graph = withEveryPart();
  GraphDesc changed = graph;
  dispatchOf(changed).constants.front() = std::byte{7};
  dispatchOf(changed).specialization.front() = 7;
  for (std::uint32_t& groups : dispatchOf(changed, 1).groups) groups += 7;
  changed.passes.back().work = HostCallback{};
  changed.resources.front().where = changed.passes.front().where = changed.exports.front().where = {};
  changed.passes.front().accesses.front().where = changed.histories.front().where = {};
  EXPECT_TRUE(sameTopology(graph, changed));
}

/// One change of every part of a random graph.
TEST(SameTopology, IsAnotherForChangesOfRandomGraphs) {
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
