#include "tests/vulkan/function_hooks.h"
#include "tests/vulkan/gpu_fixture.h"
#include "tests/vulkan/graph_run.h"
#include "tests/vulkan/test_graphs.h"

namespace fg::test {
namespace {

class HistoryTest : public GpuTest {
 protected:
  /// Run a frame and check what it found: `previous` as so many frames left it, and that age.
  static void expectFrame(GraphRun& run, const CountingGraph& counting, std::uint32_t framesBehind,
                          Extent extent = kTexture.extent) {
    const vk::HistoryStatus status = run.executor().historyStatus(counting.history);
    EXPECT_EQ(status.age, framesBehind);
    EXPECT_EQ(status.valid, framesBehind != 0);
    run.frame();
    EXPECT_EQ(run.texels<std::uint32_t>(counting.count), constant(framesBehind + 1, extent));
    EXPECT_EQ(run.texels<std::uint32_t>(counting.age), constant(framesBehind, extent));
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

/// Half as large as `kTexture`, which is cropped and not scaled: the passes read texel by texel.
constexpr TextureDesc kHalf{kTexture.format, {kTexture.extent.width / 2, kTexture.extent.height / 2}};

TEST_F(HistoryTest, ResizeGoesOnFromAPredecessorOfAnotherExtent) {
  for (std::uint32_t framesBefore = 0; framesBefore <= 3; ++framesBefore) {
    CountingGraph whole;
    CountingGraph half(kHalf);
    GraphRun before(device(), whole.graph);
    for (std::uint32_t i = 0; i < framesBefore; ++i) before.submitFrame();
    GraphRun run(device(), half.graph, {.predecessor = &before.executor()});
    // The first frame reads the image of the old extent, the later ones those of the new.
    for (std::uint32_t i = 0; i < 3; ++i) expectFrame(run, half, framesBefore + i, kHalf.extent);
    run.executor().resetAllHistory();
    expectFrame(run, half, 0, kHalf.extent);
  }
}

TEST_F(HistoryTest, ResizeStartsOverWithoutAPredecessorOrWhereItIsAskedTo) {
  CountingGraph whole;
  CountingGraph half(kHalf);
  GraphRun before(device(), whole.graph);
  for (std::uint32_t i = 0; i < 2; ++i) expectFrame(before, whole, i);
  GraphRun anew(device(), half.graph, {.predecessor = &before.executor(), .inheritHistories = false});
  for (std::uint32_t i = 0; i < 2; ++i) expectFrame(anew, half, i, kHalf.extent);
  GraphRun unrelated(device(), whole.graph);
  for (std::uint32_t i = 0; i < 2; ++i) expectFrame(unrelated, whole, i);
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

/// The same with a second counter, which goes by another name.
struct TwoCounters : CountingGraph {
  TwoCounters() {
    second = graph.history("second", kTexture);
    secondCount = importOutput(graph, "second count");
    auto pass = graph.compute("accumulate second", shaders::accumulate)
                    .sample("previous", second.previous)
                    .constants(std::uint64_t{0});
    const Texture current = pass.store("current", second.current);
    static_cast<void>(pass.store("toldAge", graph.texture("no age", kTexture)));
    pass.dispatch(kTexture.extent);
    graph.exported(add(graph, "show second", current, secondCount, 0), vk::kReadable);
  }
  History second;
  Texture secondCount;
};

/// A counter that no pass shows: a frame leaves it in another state than that of `CountingGraph`.
struct HiddenCounter {
  HiddenCounter() {
    history = graph.history("counter", kTexture);
    auto pass = graph.compute("accumulate", shaders::accumulate)
                    .sample("previous", history.previous)
                    .constants(std::uint64_t{0});
    static_cast<void>(pass.store("current", history.current));
    graph.exported(pass.store("toldAge", importOutput(graph, "age")), vk::kReadable);
    pass.dispatch(kTexture.extent);
  }
  Graph graph;
  History history;
};

TEST_F(HistoryTest, GoesOnFromAnotherGraphWhereTheNameIsTheSame) {
  CountingGraph counting;
  TwoCounters two;
  HiddenCounter hidden;
  GraphRun first(device(), counting.graph);
  for (std::uint32_t i = 0; i < 3; ++i) first.submitFrame();
  GraphRun second(device(), two.graph, {.predecessor = &first.executor()});
  EXPECT_EQ(second.executor().historyStatus(two.second).age, 0U);
  expectFrame(second, two, 3);
  EXPECT_EQ(second.texels<std::uint32_t>(two.secondCount), constant(1));
  expectFrame(second, two, 4);
  EXPECT_EQ(second.texels<std::uint32_t>(two.secondCount), constant(2));
  GraphRun third(device(), hidden.graph, {.predecessor = &second.executor()});
  EXPECT_EQ(third.executor().historyStatus(hidden.history).age, 5U);
  third.submitFrame();
  GraphRun fourth(device(), two.graph, {.predecessor = &third.executor()});
  EXPECT_EQ(fourth.executor().historyStatus(two.second).age, 0U) << "the frame before had none";
  expectFrame(fourth, two, 6);
  EXPECT_EQ(fourth.texels<std::uint32_t>(two.secondCount), constant(1));
  GraphRun unrecorded(device(), counting.graph, {.predecessor = &fourth.executor()});
  GraphRun last(device(), counting.graph, {.predecessor = &unrecorded.executor()});
  expectFrame(last, counting, 0);
}

/// A history that goes by the name of the counter and is used like it, so that only its description differs.
struct OtherImages {
  explicit OtherImages(const TextureDesc& desc) {
    const History history = graph.history("counter", desc);
    auto pass = graph.callback("write", [](const RecordContext&) {});
    pass.sample("i", history.previous).sideEffects();
    static_cast<void>(pass.store("o", history.current));
  }
  Graph graph;
};

TEST_F(HistoryTest, StartsOverWhereFormatMipLevelsOrLayersAreOthersOrWhereItIsAskedTo) {
  CountingGraph counting;
  for (const TextureDesc& desc :
       {TextureDesc{VK_FORMAT_R32_SFLOAT, kTexture.extent}, TextureDesc{kTexture.format, kTexture.extent, 2},
        TextureDesc{kTexture.format, kTexture.extent, 1, 2}}) {
    const OtherImages other(desc);
    GraphRun before(device(), other.graph);
    before.frame();
    GraphRun run(device(), counting.graph, {.predecessor = &before.executor()});
    expectFrame(run, counting, 0);
    GraphRun anew(device(), counting.graph, {.predecessor = &run.executor(), .inheritHistories = false});
    expectFrame(anew, counting, 0);
  }
  const OtherImages same(kTexture);
  GraphRun before(device(), same.graph);
  before.frame();
  GraphRun run(device(), counting.graph, {.predecessor = &before.executor()});
  EXPECT_EQ(run.executor().historyStatus(counting.history).age, 1U) << "nothing but the description stood against it";
}

TEST_F(HistoryTest, PipelinesOfAPredecessorAreShared) {
  hookState = {};
  vk::DeviceContext tampered = context();
  hook<&vk::DeviceFunctions::vkCreateComputePipelines>(tampered);
  const GpuQueue gpu(tampered, device().queue());
  CountingGraph counting;
  GraphRun before(gpu, counting.graph);
  EXPECT_EQ(hookState.calls, 2U);
  TwoCounters two;
  GraphRun more(gpu, two.graph, {.predecessor = &before.executor()});
  Graph other;
  (void)chain(other, 0, 3);
  GraphRun others(gpu, other, {.predecessor = &more.executor(), .inheritHistories = false});
  EXPECT_EQ(hookState.calls, 3U) << "all but that of 'fill' are there";
}

TEST_F(HistoryTest, IsPoisonProof) {
  CountingGraph counting;
  GraphRun run(device(), counting.graph, {.poison = true});
  for (std::uint32_t i = 0; i < 3; ++i) expectFrame(run, counting, i);
}

}  // namespace
}  // namespace fg::test
