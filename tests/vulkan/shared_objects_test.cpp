// Executors that share memory of transients wait for each other's writes to it.
#include <array>
#include <memory>

#include "framegraph/vulkan/shared_objects.h"
#include "tests/vulkan/function_hooks.h"
#include "tests/vulkan/gpu_fixture.h"
#include "tests/vulkan/graph_run.h"
#include "tests/vulkan/test_graphs.h"

namespace fg::test {
namespace {

std::uint32_t handOvers = 0;  ///< Global barriers that end all writes before all commands.
PFN_vkCmdPipelineBarrier2 realBarrier = nullptr;

void countHandOvers(VkCommandBuffer commandBuffer, const VkDependencyInfo* info) {
  for (std::uint32_t i = 0; i < info->memoryBarrierCount; ++i) {
    const VkMemoryBarrier2& barrier = info->pMemoryBarriers[i];
    const bool all = barrier.srcStageMask == VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT &&
                     barrier.srcAccessMask == VK_ACCESS_2_MEMORY_WRITE_BIT &&
                     barrier.dstStageMask == VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    handOvers += all ? 1 : 0;
  }
  realBarrier(commandBuffer, info);
}

class ExecutorsThatShare : public GpuTest {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    hookState = {};
    handOvers = 0;
    tampered_ = context();
    hook<&vk::DeviceFunctions::vkCreateComputePipelines, &vk::DeviceFunctions::vkCreateShaderModule,
         &vk::DeviceFunctions::vkCreatePipelineLayout, &vk::DeviceFunctions::vkCreateDescriptorSetLayout>(tampered_);
    realBarrier = tampered_.functions.vkCmdPipelineBarrier2;
    tampered_.functions.vkCmdPipelineBarrier2 = countHandOvers;
    shared_ = std::make_shared<vk::SharedObjects>(tampered_);
  }
  void TearDown() override {
    shared_.reset();
    GpuTest::TearDown();
  }
  [[nodiscard]] std::unique_ptr<GraphRun> run(const Graph& graph) {
    return std::make_unique<GraphRun>(GpuQueue(tampered_, device().queue()), graph,
                                      vk::ExecutorOptions{.shared = {shared_, shared_->addMember()}});
  }

 private:
  vk::DeviceContext tampered_;
  std::shared_ptr<vk::SharedObjects> shared_;
};

TEST_F(ExecutorsThatShare, HandOverTheMemoryOfTransientsAndCreateNoPipelineTwice) {
  std::array<Graph, 2> graphs;
  const std::array<Texture, 2> outputs{chain(graphs[0], 5, 6), chain(graphs[1], 70, 6)};
  std::array<std::unique_ptr<GraphRun>, 2> runs{run(graphs[0]), nullptr};
  runs[0]->frame();
  EXPECT_EQ(handOvers, 0U) << "nothing is shared yet";
  EXPECT_EQ(runs[0]->executor().sharedBytes(), 0U);

  EXPECT_GT(hookState.calls, 0U) << "the calls must be seen";
  hookState = {};
  runs[1] = run(graphs[1]);
  EXPECT_EQ(hookState.calls, 0U);
  EXPECT_GT(runs[1]->executor().sharedBytes(), 0U);
  EXPECT_EQ(runs[1]->executor().sharedBytes(), runs[0]->executor().sharedBytes());
  for (std::uint32_t i = 0; i < 3; ++i) {
    for (const auto& each : runs) each->submitFrame();
  }
  EXPECT_EQ(handOvers, 6U);
  for (const auto& each : runs) each->finish();
  EXPECT_EQ(runs[0]->texels<std::uint32_t>(outputs[0]), filled(5 + 6));
  EXPECT_EQ(runs[1]->texels<std::uint32_t>(outputs[1]), filled(70 + 6));

  runs[0].reset();
  runs[1]->frame();
  EXPECT_EQ(handOvers, 6U) << "nothing is shared any more";
  EXPECT_EQ(runs[1]->texels<std::uint32_t>(outputs[1]), filled(70 + 6));
}

TEST_F(ExecutorsThatShare, OfOneMemberShareNoMemory) {
  vk::SharedObjects objects(context());
  const MemoryRequirements needed{.size = 4096, .alignment = 256, .memoryTypeBits = ~0U};
  const MemoryRequirements larger{.size = 8192, .alignment = 256, .memoryTypeBits = ~0U};
  const std::uint32_t first = objects.addMember();
  const std::uint32_t second = objects.addMember();
  const auto memory = objects.transientMemory(needed, first);
  EXPECT_NE(objects.transientMemory(needed, first), memory);
  EXPECT_EQ(objects.transientMemory(needed, second), memory);
  EXPECT_NE(objects.transientMemory(larger, second), memory);
}

TEST_F(ExecutorsThatShare, ShareAgainOnceAllAreReplaced) {
  vk::SharedObjects objects(context());
  const MemoryRequirements needed{.size = 4096, .alignment = 256, .memoryTypeBits = ~0U};
  const std::uint32_t first = objects.addMember();
  const std::uint32_t second = objects.addMember();
  const auto replaced = objects.transientMemory(needed, first);
  EXPECT_EQ(objects.transientMemory(needed, second), replaced);
  const auto memory = objects.transientMemory(needed, first);
  EXPECT_NE(memory, replaced);
  EXPECT_EQ(objects.transientMemory(needed, second), memory);
}

}  // namespace
}  // namespace fg::test
