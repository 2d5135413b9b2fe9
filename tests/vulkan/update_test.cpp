#include "framegraph/vulkan/error.h"
#include "tests/vulkan/function_hooks.h"
#include "tests/vulkan/gpu_fixture.h"
#include "tests/vulkan/graph_run.h"
#include "tests/vulkan/test_graphs.h"

namespace fg::test {
namespace {

/// A frame counter in a history, and a result that depends on a push constant and a specialization constant.
struct AdjustableGraph : CountingGraph {
  AdjustableGraph(std::uint32_t added, std::uint32_t factor) {
    const Buffer upload = graph.upload("frame", 8);
    auto write = graph.compute("write", shaders::writeUniform).uniform("frame", upload).specialize("factor", factor);
    const Texture scaled = write.store("target", graph.texture("scaled", kTexture));
    write.dispatch(kTexture.extent);
    frame = upload;
    out = importOutput(graph, "sum");
    graph.exported(add(graph, "add", scaled, out, added), vk::kReadable);
  }
  Buffer frame;
  Texture out;
};

class UpdateTest : public GpuTest {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    hookState = {};
    tampered_ = context();
  }
  /// A run of the graph after two frames.
  std::unique_ptr<GraphRun> startedRun(const AdjustableGraph& adjustable) {
    auto run = std::make_unique<GraphRun>(GpuQueue(tampered_, device().queue()), adjustable.graph);
    run->executor().upload(adjustable.frame, std::uint64_t{10} << 32U);
    run->frame();
    run->frame();
    EXPECT_EQ(run->texels<std::uint32_t>(adjustable.out), constant(10 * 2 + 1));
    return run;
  }
  vk::DeviceContext tampered_;
};

TEST_F(UpdateTest, ChangesConstantsWithoutNewObjectsAndKeepsHistory) {
  const AdjustableGraph adjustable(1, 2);
  hookCreation(tampered_);
  const auto run = startedRun(adjustable);
  hookState.calls = 0;
  run->executor().update(AdjustableGraph(5, 2).graph.desc());
  run->frame();
  EXPECT_EQ(hookState.calls, 0U);
  EXPECT_EQ(run->texels<std::uint32_t>(adjustable.out), constant(10 * 2 + 5));
  EXPECT_EQ(run->texels<std::uint32_t>(adjustable.count), constant(3));
}

TEST_F(UpdateTest, CreatesPipelinesOnlyForNewSpecializationConstants) {
  const AdjustableGraph adjustable(1, 2);
  hook<&vk::DeviceFunctions::vkAllocateMemory, &vk::DeviceFunctions::vkCreateComputePipelines>(tampered_);
  const auto run = startedRun(adjustable);
  hookState.calls = 0;
  const std::vector<std::uint32_t> factors = {3, 2, 3};
  for (std::size_t i = 0; i < factors.size(); ++i) {
    run->executor().update(AdjustableGraph(1, factors[i]).graph.desc());
    run->submitFrame();  // The previous frame may still be running.
    EXPECT_EQ(hookState.calls, 1U) << "the pipelines of both factors must be kept";
  }
  run->finish();
  EXPECT_EQ(run->texels<std::uint32_t>(adjustable.out), constant(10 * 3 + 1));
  EXPECT_EQ(run->texels<std::uint32_t>(adjustable.count), constant(5));
}

TEST_F(UpdateTest, LeavesTheExecutorUnchangedIfItFails) {
  const AdjustableGraph adjustable(1, 2);
  hook<&vk::DeviceFunctions::vkCreateComputePipelines>(tampered_);
  const auto run = startedRun(adjustable);
  hookState = {.calls = 0, .failAt = 0, .failure = VK_ERROR_INITIALIZATION_FAILED};
  EXPECT_THROW(run->executor().update(AdjustableGraph(5, 3).graph.desc()), vk::PipelineFailed);
  run->frame();
  EXPECT_EQ(run->texels<std::uint32_t>(adjustable.out), constant(10 * 2 + 1));
  EXPECT_EQ(run->texels<std::uint32_t>(adjustable.count), constant(3));
}

TEST_F(UpdateTest, RefusesAnotherTopology) {
  const AdjustableGraph adjustable(1, 2);
  const auto run = startedRun(adjustable);
  Graph other;
  chain(other, 0, 3);
  EXPECT_THROW(run->executor().update(other.desc()), std::invalid_argument);
  run->frame();
  EXPECT_EQ(run->texels<std::uint32_t>(adjustable.count), constant(3));
}

}  // namespace
}  // namespace fg::test
