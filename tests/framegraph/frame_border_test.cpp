#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "framegraph/compile/compile.h"
#include "framegraph/compile/frame_border.h"
#include "tests/framegraph/random_graph.h"
#include "tests/framegraph/test_shaders.h"

/// Tests the states in which a frame finds and leaves resources.
namespace fg {
namespace {

using test::kColor;
using test::recordNothing;

constexpr ExternalState kStored = {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                                   VK_IMAGE_LAYOUT_GENERAL};

std::vector<FrameBorder> bordersOf(const Graph& graph) {
  const CompileResult result = compile(graph.desc(), TableMemoryModel());
  EXPECT_TRUE(result.ok()) << result.text();
  return frameBorders(graph.desc(), result.plan);
}

TEST(FrameBorder, NamesTheFirstUseIfTheHostHasWaited) {
  Graph graph;
  const Texture in = graph.import("in", kColor, {.layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL});
  const Texture out = graph.import("out", kColor, {.layout = VK_IMAGE_LAYOUT_GENERAL});
  auto pass = graph.callback("pass", recordNothing);
  pass.sample("in", in);
  graph.exported(pass.store("out", out), {.layout = VK_IMAGE_LAYOUT_GENERAL});
  const std::vector<FrameBorder> borders = bordersOf(graph);
  EXPECT_EQ(borders[in.resource].entry, std::vector{test::kSampled});
  EXPECT_EQ(borders[out.resource].entry, std::vector{kStored});
  EXPECT_EQ(borders[out.resource].exit, std::vector{kStored});
  // Reads leave nothing to be made available.
  EXPECT_EQ(borders[in.resource].exit.at(0).stage, test::kSampled.stage);
  EXPECT_EQ(borders[in.resource].exit.at(0).access, VK_ACCESS_2_NONE);
}

TEST(FrameBorder, IsThatOfTheBarriersToAndFromTheHost) {
  // A copy, and a write that only an extension has.
  const ExternalState states[] = {
      {VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL},
      {VK_PIPELINE_STAGE_2_OPTICAL_FLOW_BIT_NV, VK_ACCESS_2_OPTICAL_FLOW_WRITE_BIT_NV, VK_IMAGE_LAYOUT_GENERAL}};
  for (const ExternalState& written : states) {
    Graph graph;
    const Texture in = graph.import("in", kColor, written);
    const Texture out = graph.import("out", kColor, test::kTransferSource);
    auto pass = graph.callback("pass", recordNothing);
    pass.sample("in", in);
    graph.exported(pass.store("out", out), test::kTransferSource);
    const std::vector<FrameBorder> borders = bordersOf(graph);
    EXPECT_EQ(borders[in.resource].entry, std::vector{written});
    EXPECT_EQ(borders[in.resource].exit, std::vector{written});
    EXPECT_EQ(borders[out.resource].exit, std::vector{test::kTransferSource});
  }
}

TEST(FrameBorder, HasAStateForEveryMipLevel) {
  Graph graph;
  const Texture chain = graph.texture("chain", {kColor.format, kColor.extent, 2});
  const Texture out = graph.import("out", kColor, test::kTransferSource);
  auto fill = graph.callback("fill", recordNothing);
  const Texture filled = fill.access(chain, Access::StorageWrite);
  auto reduce = graph.callback("reduce", recordNothing);
  reduce.access(filled, Access::SampledRead, {1, 1, 0, 1});
  graph.exported(reduce.store("out", out), test::kTransferSource);
  const FrameBorder border = bordersOf(graph)[chain.resource];
  ASSERT_EQ(border.entry.size(), 2);
  ASSERT_EQ(border.exit.size(), 2);
  for (const ExternalState& entry : border.entry) EXPECT_EQ(entry.layout, VK_IMAGE_LAYOUT_UNDEFINED);
  EXPECT_EQ(border.exit[0].layout, VK_IMAGE_LAYOUT_GENERAL);
  EXPECT_EQ(border.exit[1].layout, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

TEST(FrameBorder, LeadsFromOneFrameToTheNextInRandomGraphs) {
  std::uint32_t carried = 0;
  std::uint32_t released = 0;
  for (std::uint64_t seed = 1; seed <= 2'000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Graph graph = test::randomGraph(seed);
    const GraphDesc& desc = graph.desc();
    const CompileResult result = compile(desc, TableMemoryModel());
    ASSERT_TRUE(result.ok()) << result.text();
    const std::vector<FrameBorder> borders = frameBorders(desc, result.plan);
    for (const HistoryDecl& history : desc.histories) {
      if (!result.plan.resources[history.previous].used) continue;
      ASSERT_EQ(borders[history.previous].entry, borders[history.current].exit);
      ++carried;
    }
    for (const ExportDecl& exported : desc.exports) {
      const ResourceDecl& decl = desc.resources[exported.resource.resource];
      if (std::holds_alternative<BufferDesc>(decl.desc) || decl.history != kNone) continue;
      for (const ExternalState& exit : borders[exported.resource.resource].exit) {
        ASSERT_EQ(exit.layout, exported.release.layout) << decl.name;
        ++released;
      }
    }
    for (std::uint32_t i = 0; i < borders.size(); ++i) {
      ASSERT_EQ(borders[i].entry.empty(), !result.plan.resources[i].used);
    }
  }
  EXPECT_GT(carried, 100);
  EXPECT_GT(released, 100);
}

}  // namespace
}  // namespace fg
