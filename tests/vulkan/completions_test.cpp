// A host that tells when its frames are finished gets an error if it uses a slot too early.
#include <memory>
#include <stdexcept>

#include "framegraph/compile/compile.h"
#include "framegraph/vulkan/driver_memory_model.h"
#include "framegraph/vulkan/error.h"
#include "framegraph/vulkan/executor.h"
#include "framegraph/vulkan/frame_queue.h"
#include "tests/error_text.h"
#include "tests/vulkan/gpu_fixture.h"
#include "tests/vulkan/test_graphs.h"
#include "tests/vulkan/timeline.h"

namespace fg::test {
namespace {

constexpr std::uint32_t kSlots = 2;

/// Frames of an executor with two slots. The host has more command buffers, so that nothing but the timeline tells that
/// it uses a slot too early.
class Completions : public GpuTest {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    Graph graph;
    const Texture kept = fill(graph, "fill", graph.texture("kept", kTexture), 9);
    graph.exported(
        kept, {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT, VK_IMAGE_LAYOUT_GENERAL});
    executor_ = std::make_unique<vk::Executor>(context(), graph.desc(),
                                               compile(graph.desc(), vk::DriverMemoryModel(context())).plan,
                                               vk::ExecutorOptions{.framesInFlight = kSlots});
    finished_ = std::make_unique<Timeline>(context());
    gate_ = std::make_unique<Timeline>(context());
    queue_ = std::make_unique<vk::FrameQueue>(context(), device().queue(), 8);
  }
  void TearDown() override {
    if (gate_ != nullptr && gate_->value() == 0) gate_->signal(1);
    queue_.reset();
    executor_.reset();
    finished_.reset();
    gate_.reset();
    GpuTest::TearDown();
  }

  /// Record and submit a frame, which the GPU starts when the gate is at 1.
  void frame(std::uint32_t slot, const vk::TimelinePoint& finished) {
    const vk::Frame recorded = queue_->begin();
    executor_->record(recorded.commandBuffer, slot, finished);
    queue_->submit(recorded, {.after = gate_->at(1), .finished = finished});
  }
  void openGate() { gate_->signal(1); }
  [[nodiscard]] const Timeline& finished() const { return *finished_; }

 private:
  std::unique_ptr<vk::Executor> executor_;
  std::unique_ptr<Timeline> finished_;
  std::unique_ptr<Timeline> gate_;
  std::unique_ptr<vk::FrameQueue> queue_;
};

TEST_F(Completions, ASlotThatIsStillInUseIsAnErrorUntilTheGpuHasFinished) {
  frame(0, finished().at(10));
  frame(1, finished().at(11));
  for (int attempt = 0; attempt < 2; ++attempt) {
    expectError<vk::FrameInFlight>(
        [&] { frame(0, finished().at(12)); },
        {"frame 2 uses slot 0 of 2 again", "not finished frame 0", "must be at 10 and is at 0"});
  }
  openGate();
  finished().wait(10);
  frame(0, finished().at(12));
  finished().wait(11);
  frame(1, {});
  // Frame 3 has not told, so frame 4 is not checked. Frame 2 is.
  frame(1, finished().at(13));
  finished().wait(12);
  frame(0, finished().at(14));
  finished().wait(14);
}

TEST_F(Completions, AValueThatTellsNothingIsAnError) {
  expectError<std::invalid_argument>([&] { frame(0, finished().at(0)); }, {"is 0, which no submission signals"});
  frame(0, finished().at(5));
  expectError<std::invalid_argument>([&] { frame(1, finished().at(4)); }, {"is 4, but frame 0 had 5"});
  openGate();
  finished().wait(5);
}

}  // namespace
}  // namespace fg::test
