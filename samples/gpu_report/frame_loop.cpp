#include "samples/gpu_report/frame_loop.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <span>
#include <vector>

#include "framegraph/vulkan/frame_queue.h"
#include "framegraph/vulkan/image.h"
#include "framegraph/vulkan/memory_barrier.h"
#include "framegraph/vulkan/staged_image.h"
#include "integration/denoise_graph.h"
#include "samples/denoise/device_graph.h"
#include "samples/estimate/plan_work.h"

namespace walr {
namespace {

constexpr std::uint32_t kFramesInFlight = 2;
constexpr VkImageLayout kResidentLayout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
constexpr fg::ExternalState kResident{VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
                                      kResidentLayout};

/// Record that an image is sampled from now on, after its upload.
void recordResident(const fg::vk::DeviceContext& device, VkCommandBuffer commandBuffer, VkImage image) {
  VkImageMemoryBarrier2 barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
  barrier.srcStageMask = fg::vk::kUploaded.stage;
  barrier.srcAccessMask = fg::vk::kUploaded.access;
  barrier.dstStageMask = kResident.stage;
  barrier.dstAccessMask = kResident.access;
  barrier.oldLayout = fg::vk::kUploaded.layout;
  barrier.newLayout = kResidentLayout;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image;
  barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  VkDependencyInfo dependency{};
  dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  dependency.imageMemoryBarrierCount = 1;
  dependency.pImageMemoryBarriers = &barrier;
  device.functions.vkCmdPipelineBarrier2(commandBuffer, &dependency);
}

/// An input texture of one frame.
struct ResidentInput {
  fg::Texture texture;
  fg::vk::StagedImage image;
};

/// The inputs of one frame, in device memory.
struct ResidentFrame {
  FrameConstants constants;
  std::vector<ResidentInput> inputs;
};

}  // namespace

struct FrameLoop::State {
  State(const GpuDevice& device, const Variant& variant, const TimedContent& content)
      : gpu(device),
        declared(declareDenoiseGraph(
            *makeVariant(variant), content.extent, content.layout->conventions,
            {.inputs = kResident, .outputBefore = kComputeHost.outputBefore, .outputAfter = kComputeHost.outputAfter})),
        graph(device, declared.graph, kFramesInFlight),
        output(fg::vk::createImage(device.device().context(),
                                   declared.graph.textureDesc(declared.lights.front().output),
                                   graph.executor().usage(declared.lights.front().output), "result")),
        outputMemory(device.device().context(), VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, "result"),
        work(workOf(declared.graph.desc(), graph.plan())),
        queue(device.device().context(), device.device().queue(), kFramesInFlight) {
    outputMemory.add(output.get());
    outputMemory.allocate();
    graph.executor().bind(declared.lights.front().output, {output.get(), 0});
    for (const PackedFrame& frame : content.frames) addFrame(frame, content.layout->motionScale);
    upload();
  }

  void addInput(ResidentFrame& frame, fg::Texture texture, std::span<const std::byte> texels) {
    const std::string& name = declared.graph.desc().resources[texture.resource].name;
    ResidentInput& input = frame.inputs.emplace_back(ResidentInput{
        texture,
        fg::vk::StagedImage(gpu.device().context(), declared.graph.textureDesc(texture),
                            graph.executor().usage(texture), fg::vk::StagedImage::Direction::Upload, 1, name)});
    std::ranges::copy(texels, input.image.staging(0).begin());
  }

  void addFrame(const PackedFrame& packed, glm::vec2 motionScale) {
    ResidentFrame& frame = frames.emplace_back(ResidentFrame{frameConstantsOf(packed.frame, motionScale), {}});
    const auto add = [&](fg::Texture texture, const auto& texels) {
      addInput(frame, texture, std::as_bytes(std::span(texels)));
    };
    add(declared.inputs.lighting, packed.lighting);
    add(declared.inputs.depth, packed.frame.depth.values());
    add(declared.inputs.normal, packed.normal);
    add(declared.inputs.motion, packed.motion);
    add(declared.inputs.albedo, packed.lobe.albedo);
  }

  void upload() {
    const fg::vk::Frame recorded = queue.begin();
    for (const ResidentFrame& frame : frames) {
      for (const ResidentInput& input : frame.inputs) {
        input.image.recordUpload(recorded.commandBuffer, 0);
        recordResident(gpu.device().context(), recorded.commandBuffer, input.image.external().image);
      }
    }
    queue.submit(recorded);
    queue.waitAll();
  }

  void submit(const fg::vk::Frame& recorded) {
    const ResidentFrame& frame = frames[next++ % frames.size()];
    graph.executor().upload(declared.inputs.frame, frame.constants);
    for (const ResidentInput& input : frame.inputs) graph.executor().bind(input.texture, input.image.external());
    // Otherwise the first pass could run beside the last one of the frame before, and take some of its time.
    constexpr fg::ExternalState kEverything{VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                            VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT};
    fg::vk::recordMemoryBarrier(gpu.device().context(), recorded.commandBuffer, kEverything, kEverything);
    graph.executor().record(recorded.commandBuffer, recorded.slot);
    queue.submit(recorded);
  }

  /// Times of the frame that a slot ran last.
  void addTimes(std::uint32_t slot, FrameTimes& times) {
    const std::span<const fg::vk::PassTime> all = graph.executor().passTimes(slot);
    if (all.empty()) return;
    std::vector<fg::vk::PassTime> merged;
    for (const PassWork& pass : work) {
      fg::vk::PassTime& sum = merged.emplace_back(fg::vk::PassTime{pass.pass, 0.0});
      for (const std::size_t planned : pass.planned) sum.milliseconds += all[planned].milliseconds;
    }
    times.add(merged);
  }

  const GpuDevice& gpu;
  DenoiseGraph declared;
  DeviceGraph graph;
  fg::vk::Owned<VkImage> output;
  fg::vk::MemoryArena outputMemory;
  std::vector<PassWork> work;
  std::vector<ResidentFrame> frames;
  std::size_t next = 0;
  fg::vk::FrameQueue queue;  // The last: its destructor waits for the device.
};

FrameLoop::FrameLoop(const GpuDevice& device, const Variant& variant, const TimedContent& content)
    : state_(std::make_unique<State>(device, variant, content)) {}
FrameLoop::~FrameLoop() = default;
FrameLoop::FrameLoop(FrameLoop&&) noexcept = default;
FrameLoop& FrameLoop::operator=(FrameLoop&&) noexcept = default;

std::size_t FrameLoop::run(const LoopLength& length, FrameTimes* times) {
  using Clock = std::chrono::steady_clock;
  const auto end =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(length.seconds));
  std::array<bool, kFramesInFlight> inFlight{};
  std::size_t count = 0;
  const auto collect = [&](std::uint32_t slot) {
    if (inFlight.at(slot) && times != nullptr) state_->addTimes(slot, *times);
  };
  for (; count < length.most && (count < length.least || Clock::now() < end); ++count) {
    const fg::vk::Frame frame = state_->queue.begin();  // Waits for the frame that the slot ran last.
    collect(frame.slot);
    state_->submit(frame);
    inFlight.at(frame.slot) = true;
  }
  state_->queue.waitAll();
  for (std::uint32_t slot = 0; slot < kFramesInFlight; ++slot) collect(slot);
  return count;
}

}  // namespace walr
