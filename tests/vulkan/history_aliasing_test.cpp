#include <algorithm>
#include <functional>
#include <stdexcept>

#include "framegraph/plan/memory_places.h"
#include "framegraph/verify/verify.h"
#include "framegraph/vulkan/driver_memory_model.h"
#include "framegraph/vulkan/frame_queue.h"
#include "framegraph/vulkan/validation_settings.h"
#include "tests/vulkan/gpu_fixture.h"
#include "tests/vulkan/graph_run.h"
#include "tests/vulkan/test_graphs.h"

/// Tests on a device that transients may use the memory of histories.
namespace fg::test {
namespace {

/// previous -> early -> across -> current -> late -> "out", where each arrow adds 1. All three transients fit into the
/// two images of the history.
struct AliasingGraph {
  static constexpr std::uint32_t kStep = 3;  ///< Increase of `current` from frame to frame.

  /// @param makeOut creates the texture for the result
  explicit AliasingGraph(std::function<Texture(Graph&)> makeOut = [](Graph& g) { return importOutput(g, "out"); }) {
    history = graph.history("history", kTexture);
    out = makeOut(graph);
    early = add(graph, "a", history.previous, graph.texture("early", kTexture), 1);
    across = add(graph, "b", early, graph.texture("across", kTexture), 1);
    const Texture current = add(graph, "c", across, history.current, 1);
    late = add(graph, "d", current, graph.texture("late", kTexture), 1);
    graph.exported(add(graph, "e", late, out, 1), vk::kReadable);
  }
  Graph graph;
  History history;
  Texture early;
  Texture across;
  Texture late;
  Texture out;
};

class HistoryAliasingOnDeviceTest : public GpuTest {
 protected:
  /// Run a frame and check its result.
  /// @param framesBehind number of frames since the history was last invalid
  void expectFrame(GraphRun& run, std::uint32_t framesBehind) {
    run.frame();
    EXPECT_EQ(run.texels<std::uint32_t>(aliasing_.out), constant(AliasingGraph::kStep * (framesBehind + 1) + 2))
        << "after " << framesBehind << " frames";
  }
  static PlannedBarrier& handOver(Plan& plan, Texture texture) {
    for (PlannedPass& pass : plan.passes) {
      for (PlannedBarrier& barrier : pass.barriers) {
        if (barrier.resource == texture.resource && barrier.reason == BarrierReason::AliasHandOver) return barrier;
      }
    }
    throw std::logic_error("the plan has no such barrier");
  }
  /// True if there were validation messages. All of them must be synchronization hazards.
  bool reportsHazard() {
    const std::vector<vk::Message> messages = takeMessages();
    for (const vk::Message& message : messages) EXPECT_TRUE(message.id.starts_with("SYNC-HAZARD")) << message.text;
    return !messages.empty();
  }

  static constexpr std::uint32_t kFramesTogether = 6;

  /// Record several frames of the graph without imported images into one command buffer, and execute it.
  /// @param reset number of the frame before which the history is reset
  void recordTogether(const Plan& plan, bool poison, std::uint32_t reset) {
    vk::Executor executor(context(), alone_.graph.desc(), plan, {.framesInFlight = kFramesTogether, .poison = poison});
    vk::FrameQueue queue(context(), device().queue());
    const vk::Frame together = queue.begin();
    for (std::uint32_t frame = 0; frame < kFramesTogether; ++frame) {
      if (frame == reset) executor.resetAllHistory();
      executor.record(together.commandBuffer, frame);
    }
    queue.submit(together);
    queue.waitAll();
  }

  AliasingGraph aliasing_;
  AliasingGraph alone_{[](Graph& graph) { return graph.texture("out", kTexture); }};
};

TEST_F(HistoryAliasingOnDeviceTest, AllocatesNothingBesidesTheHistory) {
  const GraphDesc& desc = aliasing_.graph.desc();
  const Plan plan = compileFor(context(), aliasing_.graph);
  const auto in = [&](Texture texture) { return aliasedHistoryImages(desc, plan, texture.resource); };
  EXPECT_EQ(in(aliasing_.early), std::vector{aliasing_.history.current.resource});
  EXPECT_EQ(in(aliasing_.across), std::vector{aliasing_.history.previous.resource});
  EXPECT_EQ(in(aliasing_.late), std::vector{aliasing_.history.previous.resource});
  GraphRun run(device(), aliasing_.graph, plan);
  EXPECT_EQ(run.executor().allocatedBytes(), 2 * plan.resources[aliasing_.history.current.resource].size);
}

TEST_F(HistoryAliasingOnDeviceTest, FramesFollowEachOther) {
  GraphRun run(device(), aliasing_.graph);
  for (std::uint32_t i = 0; i < 6; ++i) expectFrame(run, i);
}

TEST_F(HistoryAliasingOnDeviceTest, FramesFollowEachOtherInFlight) {
  GraphRun run(device(), aliasing_.graph);
  for (int i = 0; i < 25; ++i) run.submitFrame();
  run.finish();
  EXPECT_EQ(run.texels<std::uint32_t>(aliasing_.out), constant(25 * AliasingGraph::kStep + 2));
}

TEST_F(HistoryAliasingOnDeviceTest, ResetStartsOverAtEitherParity) {
  GraphRun run(device(), aliasing_.graph);
  for (std::uint32_t framesBefore = 1; framesBefore <= 4; ++framesBefore) {
    for (std::uint32_t i = 0; i < framesBefore; ++i) expectFrame(run, i);
    run.executor().resetHistory(aliasing_.history);
  }
}

TEST_F(HistoryAliasingOnDeviceTest, APredecessorsHistoryIsWhole) {
  for (std::uint32_t framesBefore = 0; framesBefore <= 3; ++framesBefore) {
    GraphRun before(device(), aliasing_.graph);
    for (std::uint32_t i = 0; i < framesBefore; ++i) before.submitFrame();
    GraphRun run(device(), aliasing_.graph, {.predecessor = &before.executor()});
    for (std::uint32_t i = 0; i < 5; ++i) expectFrame(run, framesBefore + i);
    run.executor().resetAllHistory();
    expectFrame(run, 0);
  }
}

TEST_F(HistoryAliasingOnDeviceTest, PoisonOfTransientsLeavesHistoriesAlone) {
  GraphRun run(device(), aliasing_.graph, {.poison = true});
  for (std::uint32_t i = 0; i < 5; ++i) expectFrame(run, i);
  run.executor().resetAllHistory();
  for (std::uint32_t i = 0; i < 3; ++i) expectFrame(run, i);
}

TEST_F(HistoryAliasingOnDeviceTest, ResultIsTheSameWithoutAliasing) {
  CompileResult result =
      compile(aliasing_.graph.desc(), vk::DriverMemoryModel(context()), CompileOptions{.aliasHistories = false});
  ASSERT_TRUE(result.ok()) << result.text();
  GraphRun run(device(), aliasing_.graph, std::move(result.plan));
  for (std::uint32_t i = 0; i < 4; ++i) expectFrame(run, i);
}

/// Within a frame: synchronization validation reports a missing dependency on the previous owner, except for the layer
/// of 1.4.309. The verifier reports it always.
TEST_F(HistoryAliasingOnDeviceTest, MissingAliasBarriersAreReported) {
  for (const Texture texture : {aliasing_.across, aliasing_.history.current, aliasing_.late}) {
    Plan plan = compileFor(context(), aliasing_.graph);
    handOver(plan, texture).srcStage = VK_PIPELINE_STAGE_2_NONE;
    EXPECT_FALSE(verify(aliasing_.graph.desc(), plan).empty());
    GraphRun run(device(), aliasing_.graph, plan);
    for (int i = 0; i < 3; ++i) run.frame();
    const bool reported = reportsHazard();
    if (vk::layerVersion(vk::openLoader(), vk::kValidationLayer) < VK_MAKE_API_VERSION(0, 1, 4, 0)) {
      EXPECT_TRUE(reported) << aliasing_.graph.desc().resources[texture.resource].name;
    }
  }
}

/// Between frames: all frames are in one command buffer, because synchronization validation checks each command buffer
/// on its own.
TEST_F(HistoryAliasingOnDeviceTest, MissingAliasBarriersBetweenFramesAreReported) {
  Plan plan = compileFor(context(), alone_.graph);
  handOver(plan, alone_.early).srcStage = VK_PIPELINE_STAGE_2_NONE;
  EXPECT_FALSE(verify(alone_.graph.desc(), plan).empty());
  recordTogether(plan, false, kFramesTogether);
  EXPECT_TRUE(reportsHazard());
}

TEST_F(HistoryAliasingOnDeviceTest, FramesInOneCommandBufferHaveNoHazard) {
  for (const bool poison : {false, true}) {
    const Plan plan = compileFor(context(), alone_.graph, poison);
    for (std::uint32_t reset = 0; reset < kFramesTogether; ++reset) {
      recordTogether(plan, poison, reset);
      EXPECT_FALSE(reportsHazard()) << "history reset before frame " << reset << (poison ? ", poisoned" : "");
    }
  }
}

}  // namespace
}  // namespace fg::test
