#include "tests/vulkan/gpu_fixture.h"
#include "tests/vulkan/graph_run.h"
#include "tests/vulkan/test_graphs.h"

namespace fg::test {
namespace {

class HistoryTest : public GpuTest {
 protected:
  /// Run a frame and check what it found: `previous` as so many frames left it, and that age.
  static void expectFrame(GraphRun& run, const CountingGraph& counting, std::uint32_t framesBehind) {
    const vk::HistoryStatus status = run.executor().historyStatus(counting.history);
    EXPECT_EQ(status.age, framesBehind);
    EXPECT_EQ(status.valid, framesBehind != 0);
    run.frame();
    EXPECT_EQ(run.texels<std::uint32_t>(counting.count), constant(framesBehind + 1));
    EXPECT_EQ(run.texels<std::uint32_t>(counting.age), constant(framesBehind));
  }
};

TEST_F(HistoryTest, StartsFromZerosAndCarriesFromFrameToFrame) {
  CountingGraph counting;
  GraphRun run(device(), counting.graph);
  for (std::uint32_t i = 0; i < 5; ++i) expectFrame(run, counting, i);
}

TEST_F(HistoryTest, ResetStartsOverAtEitherParity) {
  for (std::uint32_t framesBefore = 1; framesBefore <= 2; ++framesBefore) {
    CountingGraph counting;
    GraphRun run(device(), counting.graph);
    for (std::uint32_t i = 0; i < framesBefore; ++i) expectFrame(run, counting, i);
    run.executor().resetHistory(counting.history);
    for (std::uint32_t i = 0; i < 3; ++i) expectFrame(run, counting, i);
    run.executor().resetAllHistory();
    for (std::uint32_t i = 0; i < 2; ++i) expectFrame(run, counting, i);
  }
}

TEST_F(HistoryTest, CarriesWhileFramesAreInFlight) {
  CountingGraph counting;
  GraphRun run(device(), counting.graph);
  for (int i = 0; i < 25; ++i) run.submitFrame();
  run.finish();
  EXPECT_EQ(run.texels<std::uint32_t>(counting.count), constant(25));
}

TEST_F(HistoryTest, ResizeStartsOver) {
  CountingGraph counting;
  for (int i = 0; i < 2; ++i) {
    GraphRun run(device(), counting.graph);
    expectFrame(run, counting, 0);
    expectFrame(run, counting, 1);
  }
}

TEST_F(HistoryTest, GoesOnFromAPredecessorAtEitherParityAndInFlight) {
  for (std::uint32_t framesBefore = 0; framesBefore <= 3; ++framesBefore) {
    CountingGraph counting;
    GraphRun before(device(), counting.graph);
    for (std::uint32_t i = 0; i < framesBefore; ++i) before.submitFrame();
    GraphRun run(device(), counting.graph, {.predecessor = &before.executor()});
    EXPECT_EQ(run.executor().historyStatus(counting.history).age, framesBefore);
    for (std::uint32_t i = 0; i < 5; ++i) expectFrame(run, counting, framesBefore + i);
    run.executor().resetAllHistory();
    expectFrame(run, counting, 0);
  }
  // What was inherited may be dropped before it is read, and handed on.
  CountingGraph counting;
  GraphRun first(device(), counting.graph);
  first.frame();
  GraphRun second(device(), counting.graph, {.predecessor = &first.executor()});
  second.executor().resetAllHistory();
  for (std::uint32_t i = 0; i < 3; ++i) expectFrame(second, counting, i);
  GraphRun third(device(), counting.graph, {.predecessor = &second.executor()});
  expectFrame(third, counting, 3);
}

TEST_F(HistoryTest, APredecessorMustBeOfTheSameGraph) {
  CountingGraph counting;
  GraphRun before(device(), counting.graph);
  Graph other;
  (void)chain(other, 0, 3);
  EXPECT_FALSE(before.executor().mayPrecede(other.desc()));
  EXPECT_THROW(GraphRun(device(), other, {.predecessor = &before.executor()}), std::invalid_argument);
}

TEST_F(HistoryTest, IsPoisonProof) {
  CountingGraph counting;
  GraphRun run(device(), counting.graph, {.poison = true});
  for (std::uint32_t i = 0; i < 3; ++i) expectFrame(run, counting, i);
}

}  // namespace
}  // namespace fg::test
