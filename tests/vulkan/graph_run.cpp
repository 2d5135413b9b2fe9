#include "tests/vulkan/graph_run.h"

#include <algorithm>
#include <stdexcept>

#include "framegraph/vulkan/driver_memory_model.h"

namespace fg::test {

Plan compileFor(const vk::DeviceContext& device, const Graph& graph, bool poison) {
  CompileResult result = compile(graph.desc(), vk::DriverMemoryModel(device, poison));
  if (!result.ok()) throw std::runtime_error(result.text());
  return std::move(result.plan);
}

GraphRun::GraphRun(const GpuQueue& gpu, const Graph& graph, const vk::ExecutorOptions& options)
    : GraphRun(gpu, graph, compileFor(gpu.context, graph, options.poison), options) {}

GraphRun::GraphRun(const GpuQueue& gpu, const Graph& graph, Plan plan, const vk::ExecutorOptions& options)
    : executor_(gpu.context, graph.desc(), std::move(plan), options), queue_(gpu.context, gpu.queue, kFramesInFlight) {
  using Direction = vk::StagedImage::Direction;
  const auto& resources = graph.desc().resources;
  for (std::uint32_t i = 0; i < resources.size(); ++i) {
    const ResourceDecl& decl = resources[i];
    const bool fromTest = decl.acquire == vk::kUploaded || decl.acquire == vk::kOverwritable;
    if (decl.lifetime != Lifetime::Imported || !fromTest) continue;
    if (const auto* bytes = std::get_if<BufferDesc>(&decl.desc)) {
      const Buffer buffer{{i, 0}};
      bufferReadbacks_[i] =
          std::make_unique<vk::StagedBuffer>(gpu.context, *bytes, executor_.usage(buffer), kFramesInFlight, decl.name);
      executor_.bind(buffer, bufferReadbacks_[i]->handle());
      continue;
    }
    const auto* desc = std::get_if<TextureDesc>(&decl.desc);
    const Texture texture{{i, 0}};
    const Direction direction = decl.acquire == vk::kUploaded ? Direction::Upload : Direction::Readback;
    auto image = std::make_unique<vk::StagedImage>(gpu.context, *desc, executor_.usage(texture), direction,
                                                   kFramesInFlight, decl.name);
    executor_.bind(texture, image->external());
    if (direction == Direction::Upload) {
      uploads_[i].image = std::move(image);
    } else {
      readbacks_[i] = std::move(image);
    }
  }
}

std::uint32_t GraphRun::submitFrame() {
  const vk::Frame frame = queue_.begin();
  for (const auto& [resource, upload] : uploads_) {
    std::ranges::copy(upload.bytes, upload.image->staging(frame.slot).begin());
    upload.image->recordUpload(frame.commandBuffer, frame.slot);
  }
  executor_.record(frame.commandBuffer, frame.slot);
  for (const auto& [resource, image] : readbacks_) image->recordReadback(frame.commandBuffer, frame.slot);
  for (const auto& [resource, buffer] : bufferReadbacks_) buffer->recordReadback(frame.commandBuffer, frame.slot);
  queue_.submit(frame);
  lastSlot_ = frame.slot;
  return frame.slot;
}

void GraphRun::frame() {
  submitFrame();
  finish();
}

}  // namespace fg::test
