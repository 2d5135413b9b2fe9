#include <optional>

#include "framegraph/vulkan/error.h"
#include "tests/error_text.h"
#include "tests/vulkan/function_hooks.h"
#include "tests/vulkan/gpu_fixture.h"
#include "tests/vulkan/graph_run.h"
#include "tests/vulkan/test_graphs.h"

namespace fg::test {
namespace {

/// Injects failures into the function table. The validation layer reports objects that have not been released when the
/// fixture destroys the device.
class FailureTest : public GpuTest {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    hookState = {};
    tampered_ = context();
  }
  vk::DeviceContext tampered_;
};

TEST_F(FailureTest, EveryStepOfConstructionMayRunOutOfMemory) {
  CountingGraph counting;
  const Buffer upload = counting.graph.upload("frame", 8);
  auto pass = counting.graph.compute("write", shaders::writeUniform).uniform("frame", upload).specialize("factor", 1u);
  counting.graph.exported(pass.store("target", importOutput(counting.graph, "out")), vk::kReadable);
  pass.dispatch(kTexture.extent);
  const Plan plan = compileFor(context(), counting.graph);
  hookCreation(tampered_);

  std::uint32_t failures = 0;
  std::optional<vk::Executor> executor;
  for (; !executor; ++failures) {
    ASSERT_LT(failures, 1000u) << "construction never succeeds";
    hookState = {.calls = 0, .failAt = failures, .failure = VK_ERROR_OUT_OF_DEVICE_MEMORY};
    try {
      executor.emplace(tampered_, counting.graph.desc(), plan, vk::ExecutorOptions{.timestamps = true});
      break;
    } catch (const vk::OutOfMemory& error) {
      EXPECT_EQ(error.result(), VK_ERROR_OUT_OF_DEVICE_MEMORY);
      EXPECT_NE(std::string(error.what()).find("VK_ERROR_OUT_OF_DEVICE_MEMORY; try smaller textures"),
                std::string::npos)
          << error.what();
    }
  }
  EXPECT_GT(failures, 20u) << "expected steps for memory, images, views, buffers, pipelines, descriptors and queries";

  hookState = {};
  GraphRun run(device(), counting.graph);
  run.executor().upload(upload, std::uint64_t{0});
  run.frame();
  EXPECT_EQ(run.texels<std::uint32_t>(counting.count), constant(1));
}

TEST_F(FailureTest, PipelineFailureNamesTheShader) {
  Graph graph;
  const Texture out = chain(graph, 0, 2);
  const Plan plan = compileFor(context(), graph);
  hook<&vk::DeviceFunctions::vkCreateComputePipelines>(tampered_);
  hookState = {.calls = 0, .failAt = 1, .failure = VK_ERROR_INITIALIZATION_FAILED};
  EXPECT_EQ(errorText<vk::PipelineFailed>([&] { const vk::Executor executor(tampered_, graph.desc(), plan); }),
            "creating the pipeline of shader 'add': VK_ERROR_INITIALIZATION_FAILED; update the driver");
  hookState = {};
  GraphRun run({tampered_, device().queue()}, graph, plan);
  run.frame();
  EXPECT_EQ(run.texels<std::uint32_t>(out), filled(2));
}

TEST_F(FailureTest, AnImportKeepsItsImageIfAViewOfAnotherOneFails) {
  Graph graph;
  const Texture out = chain(graph, 0, 2);
  hook<&vk::DeviceFunctions::vkCreateImageView>(tampered_);
  GraphRun run({tampered_, device().queue()}, graph);
  const vk::StagedImage other(context(), kTexture, run.executor().usage(out), vk::StagedImage::Direction::Readback,
                              kFramesInFlight, "other");
  run.frame();
  hookState = {.calls = 0, .failAt = 0, .failure = VK_ERROR_OUT_OF_DEVICE_MEMORY};
  EXPECT_THROW(run.executor().bind(out, other.external()), vk::OutOfMemory);
  hookState = {};
  run.frame();
  EXPECT_EQ(run.texels<std::uint32_t>(out), filled(2)) << "the image that was bound before";
  // A second attempt must not be taken for a repetition of the first.
  run.executor().bind(out, other.external());
  EXPECT_EQ(hookState.calls, 1U) << "the missing view is created";
  run.executor().bind(out, run.external(out));
  run.executor().forget(other.external());
}

TEST_F(FailureTest, LostDeviceThrowsDeviceLost) {
  CountingGraph counting;
  hook<&vk::DeviceFunctions::vkQueueSubmit>(tampered_);
  GraphRun run({tampered_, device().queue()}, counting.graph);
  run.frame();
  hookState = {.calls = 0, .failAt = 0, .failure = VK_ERROR_DEVICE_LOST};
  EXPECT_THROW(run.frame(), vk::DeviceLost);
  // As with a new device: the contents of histories are lost.
  run.executor().resetAllHistory();
  for (std::uint32_t i = 1; i <= 3; ++i) {
    run.frame();
    EXPECT_EQ(run.texels<std::uint32_t>(counting.count), constant(i));
  }
}

/// Every call that records, submits or waits for a frame fails once. The error must have the failing result, and after
/// a reset the graph must count from one again.
TEST_F(FailureTest, EveryStepOfAFrameMayFailAndAResetRecovers) {
  CountingGraph counting;
  using F = vk::DeviceFunctions;
  hook<&F::vkResetCommandPool, &F::vkBeginCommandBuffer, &F::vkEndCommandBuffer, &F::vkQueueSubmit, &F::vkWaitForFences,
       &F::vkResetFences>(tampered_);
  GraphRun run({tampered_, device().queue()}, counting.graph);
  for (const VkResult failure : {VK_ERROR_DEVICE_LOST, VK_ERROR_OUT_OF_DEVICE_MEMORY, VK_ERROR_OUT_OF_HOST_MEMORY}) {
    std::uint32_t steps = 0;
    for (bool failed = true; failed; ++steps) {
      ASSERT_LT(steps, 100U) << "a frame never succeeds";
      failed = false;
      hookState = {.calls = 0, .failAt = steps, .failure = failure};
      try {
        run.frame();
      } catch (const vk::DeviceLost& error) {
        failed = true;
        EXPECT_EQ(failure, VK_ERROR_DEVICE_LOST) << error.what();
      } catch (const vk::OutOfMemory& error) {
        failed = true;
        EXPECT_EQ(error.result(), failure) << error.what();
      }
      hookState = {};
      run.executor().resetAllHistory();
      for (std::uint32_t i = 1; i <= 2; ++i) {
        run.frame();
        EXPECT_EQ(run.texels<std::uint32_t>(counting.count), constant(i)) << "after a failure of step " << steps;
      }
    }
    EXPECT_GE(steps, 7U) << "expected six failing steps and one frame that succeeds";
  }
}

}  // namespace
}  // namespace fg::test
