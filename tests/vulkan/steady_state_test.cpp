#include <atomic>
#include <cstdlib>
#include <memory>
#include <new>

#include "tests/vulkan/function_hooks.h"
#include "tests/vulkan/gpu_fixture.h"
#include "tests/vulkan/graph_run.h"
#include "tests/vulkan/test_graphs.h"

namespace {
std::atomic<std::uint64_t> allocations{0};
}  // namespace

// All other forms of new and delete end here, but under AddressSanitizer, which has a nothrow form of its own.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* const memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
  ++allocations;
  return std::malloc(size);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t /*size*/) noexcept {
  std::free(memory);
}

namespace fg::test {
namespace {

/// A graph with everything that recording must handle: a history with an age, an upload, a chain of transients, an
/// indirect dispatch, a callback, and an import whose image changes from frame to frame.
struct BusyGraph : CountingGraph {
  BusyGraph() {
    upload = graph.upload("frame", 8);
    auto write = graph.compute("write", shaders::writeUniform).uniform("frame", upload).specialize("factor", 2u);
    Texture link = write.store("target", graph.texture("link", kTexture));
    write.dispatch(kTexture.extent);
    const Buffer arguments = groupCount(graph, "arguments", 2, 1);
    auto twice = graph.compute("double", shaders::doubleInPlace);
    link = twice.update("image", link);
    twice.dispatchIndirect(arguments);
    auto callback = graph.callback(
        "callback", [this](const RecordContext& record) { calls += record.view(watched) != VK_NULL_HANDLE ? 1 : 0; });
    watched = callback.access(link, Access::SampledRead);
    callback.sideEffects();
    out = importOutput(graph, "turning");
    graph.exported(add(graph, "add", link, out, 1), vk::kReadable);
  }
  Buffer upload;
  Texture watched;
  Texture out;
  int calls = 0;
};

class SteadyStateTest : public GpuTest {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    hookState = {};
    tampered_ = context();
    hookCreation(tampered_);
  }
  [[nodiscard]] GpuQueue gpu() const { return {tampered_, device().queue()}; }
  vk::DeviceContext tampered_;
};

const vk::ExecutorOptions kEverything{.timestamps = true, .poison = true};

TEST_F(SteadyStateTest, FramesCreateNoVulkanObjects) {
  BusyGraph busy;
  GraphRun run(gpu(), busy.graph, kEverything);
  const vk::StagedImage other(context(), kTexture, run.executor().usage(busy.out), vk::StagedImage::Direction::Readback,
                              kFramesInFlight, "other");
  EXPECT_GT(hookState.calls, 0u) << "the hooks must count the objects that are created";
  run.frame();
  run.executor().bind(busy.out, other.external());
  run.executor().bind(busy.out, run.external(busy.out));
  hookState.calls = 0;
  for (std::uint32_t i = 0; i < 10; ++i) {
    run.executor().upload(busy.upload, std::uint64_t{i});
    run.executor().bind(busy.out, other.external());
    run.executor().bind(busy.out, run.external(busy.out));
    if (i == 5) run.executor().resetAllHistory();
    run.submitFrame();
  }
  run.finish();
  EXPECT_EQ(hookState.calls, 0u);
  EXPECT_EQ(busy.calls, 11);
}

TEST_F(SteadyStateTest, FramesAllocateNothingOnTheHeap) {
  BusyGraph busy;
  GraphRun run(gpu(), busy.graph, kEverything);
  run.frame();
  // Layers and drivers may allocate, so that they must not be called here.
  silenceRecording(tampered_);
  tampered_.functions.vkGetSemaphoreCounterValue = [](VkDevice, VkSemaphore, std::uint64_t* value) {
    *value = ~std::uint64_t{0};
    return VK_SUCCESS;
  };
  const auto semaphore = reinterpret_cast<VkSemaphore>(std::uintptr_t{1});
  const std::uint64_t before = allocations;
  for (std::uint32_t i = 0; i < 10; ++i) {
    run.executor().upload(busy.upload, std::uint64_t{i});
    run.executor().bind(busy.out, run.external(busy.out));
    if (i == 5) run.executor().resetAllHistory();
    run.executor().record(VK_NULL_HANDLE, i % kFramesInFlight, {semaphore, i + 1});
    EXPECT_TRUE(run.executor().historyStatus(busy.history).valid);
  }
  EXPECT_EQ(allocations - before, 0u);
  EXPECT_EQ(busy.calls, 11);
  const auto counted = std::make_unique<int>(0);
  EXPECT_GT(allocations - before, 0u) << "the counter must count allocations";
}

}  // namespace
}  // namespace fg::test
