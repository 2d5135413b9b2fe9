#include "framegraph/verify/verify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <string>
#include <utility>
#include <vector>

#include "framegraph/compile/compile.h"
#include "framegraph/inspect/inspect.h"
#include "framegraph/verify/verify_memory.h"
#include "framegraph/verify/verify_rules.h"
#include "tests/framegraph/chain_graph.h"
#include "tests/framegraph/test_shaders.h"

/// Tests of the verifier on plans and damaged plans that it once judged wrongly. The fuzz test covers the rest.
namespace fg {
namespace {

using test::kColor;
using test::recordNothing;

/// The state in which the C API releases images by default.
constexpr ExternalState kAnyCommand = {VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                       VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
                                       VK_IMAGE_LAYOUT_GENERAL};
/// The host waits for the frame by a fence or semaphore.
constexpr ExternalState kWaitedFor = {VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE,
                                      VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL};

Plan planOf(const Graph& graph) {
  CompileResult result = compile(graph.desc(), TableMemoryModel());
  EXPECT_TRUE(result.ok()) << result.text();
  return std::move(result.plan);
}

std::string faultsOf(const Graph& graph, const Plan& plan) {
  std::string text;
  for (const std::string& fault : verify(graph.desc(), plan)) text += fault + "\n";
  return text;
}

PlannedBarrier& releaseOf(Plan& plan, ResourceVersion resource) {
  return *std::ranges::find(plan.releases, resource.resource, &PlannedBarrier::resource);
}

/// A pass that samples an import, which stays the host's, and writes an export. Both have the same state.
struct HostImages {
  explicit HostImages(const ExternalState& state) {
    input = graph.import("input", kColor, state);
    output = graph.import("output", kColor, state);
    auto pass = graph.callback("pass", recordNothing);
    pass.sample("in", input);
    graph.exported(pass.access(output, Access::ColorWrite), state);
  }
  Graph graph;
  Texture input;
  Texture output;
};

TEST(Verify, AcceptsHostsThatNameAllCommands) {
  const HostImages images(kAnyCommand);
  const Plan plan = planOf(images.graph);
  EXPECT_EQ(faultsOf(images.graph, plan), "") << toText(images.graph.desc(), plan);
}

TEST(Verify, TakesAStageThatStandsForSeveralAsThose) {
  const HostImages images(kAnyCommand);
  Plan plan = planOf(images.graph);
  // The same stages and accesses, one by one.
  for (PlannedBarrier& release : plan.releases) {
    release.dstStage = check::expanded(release.dstStage);
    release.dstAccess = check::expandedAccess(release.dstAccess);
  }
  EXPECT_EQ(faultsOf(images.graph, plan), "");
  PlannedBarrier& release = releaseOf(plan, images.output);
  release.dstStage &= ~VK_PIPELINE_STAGE_2_RAY_TRACING_SHADER_BIT_KHR;
  EXPECT_NE(faultsOf(images.graph, plan), "");
  release.dstStage = VK_PIPELINE_STAGE_2_ALL_GRAPHICS_BIT;  // Lacks the compute shader.
  EXPECT_NE(faultsOf(images.graph, plan), "");
  release.dstStage = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  release.dstAccess = VK_ACCESS_2_MEMORY_READ_BIT;  // The host writes, too.
  EXPECT_NE(faultsOf(images.graph, plan), "");
}

TEST(Verify, AcceptsABarrierThatWaitsForMoreThanItNeeds) {
  const HostImages images(test::kSampled);
  Plan plan = planOf(images.graph);
  for (PlannedBarrier& barrier : plan.passes.front().barriers) {
    barrier.srcStage = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.dstStage = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.srcAccess = VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.dstAccess = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
  }
  EXPECT_EQ(faultsOf(images.graph, plan), "");
}

TEST(Verify, RefusesAReleaseThatTheNextFramesFirstUseDoesNotWaitFor) {
  Graph graph;
  auto pass = graph.callback("pass", recordNothing);
  const Texture written = pass.store("out", graph.texture("texture", kColor));
  graph.exported(written, kWaitedFor);
  Plan plan = planOf(graph);
  EXPECT_EQ(faultsOf(graph, plan), "");
  releaseOf(plan, written).dstStage = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
  EXPECT_NE(faultsOf(graph, plan), "");
}

TEST(Verify, RefusesAReleaseOfAHistoryThatItsUseAsPreviousDoesNotWaitFor) {
  Graph graph;
  const History history = graph.history("history", kColor);
  auto pass = graph.callback("pass", recordNothing);
  pass.access(history.previous, Access::TransferRead);
  const Texture written = pass.store("out", history.current);
  graph.exported(written, kWaitedFor);
  Plan plan = planOf(graph);
  EXPECT_EQ(faultsOf(graph, plan), "");
  releaseOf(plan, written).dstStage = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
  EXPECT_NE(faultsOf(graph, plan), "");
}

TEST(Verify, RefusesAnImportThatIsReturnedToSomeOfItsStagesOnly) {
  const HostImages images(kAnyCommand);
  Plan plan = planOf(images.graph);
  EXPECT_EQ(faultsOf(images.graph, plan), "");
  releaseOf(plan, images.input).dstStage = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
  EXPECT_NE(faultsOf(images.graph, plan), "");
}

/// Processor time to verify a chain of passes, in seconds: the least of three.
double timeToVerify(std::int64_t passes) {
  const Graph graph = test::chainGraph(passes);
  const Plan plan = planOf(graph);
  double least = 0;
  for (int run = 0; run < 3; ++run) {
    const std::clock_t begin = std::clock();
    EXPECT_EQ(faultsOf(graph, plan), "");
    const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    least = run == 0 ? seconds : std::min(least, seconds);
  }
  return least;
}

TEST(Verify, TakesTimeInProportionToThePasses) {
  // 16 times the passes take 16 times as long in linear and 256 times in quadratic time. The limit is the mean ratio of
  // the two.
  EXPECT_LT(timeToVerify(16'000), 64 * timeToVerify(1'000));
}

using Blocks = std::vector<std::uint32_t>;

TEST(SharedMemory, ForgetsTheOthersOnceAllCellsOfABlockHaveChanged) {
  check::SharedMemory memory;
  const std::uint32_t one = memory.add({.allocation = 0, .begin = 0, .end = 100, .firstCell = 0, .cellCount = 1});
  const std::uint32_t two = memory.add({.allocation = 0, .begin = 50, .end = 150, .firstCell = 1, .cellCount = 2});
  memory.change(one, 0, 1);
  EXPECT_EQ(memory.others(two), Blocks{one});
  memory.change(two, 1, 2);
  EXPECT_EQ(memory.others(two), Blocks{one});  // The other cell may change without waiting for `one`.
  EXPECT_EQ(memory.others(one), Blocks{two});
  memory.change(two, 2, 3);
  EXPECT_EQ(memory.others(two), Blocks{});
  EXPECT_EQ(memory.others(one), Blocks{two});
}

TEST(SharedMemory, KeepsBlocksThatChangeAtTheSameTime) {
  check::SharedMemory memory;
  const std::uint32_t one = memory.add({.allocation = 0, .begin = 0, .end = 100, .firstCell = 0, .cellCount = 1});
  const std::uint32_t two = memory.add({.allocation = 0, .begin = 0, .end = 100, .firstCell = 1, .cellCount = 1});
  const std::uint32_t elsewhere = memory.add({.allocation = 1, .begin = 0, .end = 100, .firstCell = 2, .cellCount = 1});
  memory.change(one, 0, 1);
  memory.change(two, 1, 1);
  memory.change(elsewhere, 2, 1);
  EXPECT_EQ(memory.others(two), Blocks{one});
  EXPECT_EQ(memory.others(one), Blocks{two});
}

}  // namespace
}  // namespace fg
