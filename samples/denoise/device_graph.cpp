#include "samples/denoise/device_graph.h"

#include <stdexcept>

namespace walr {
namespace {

fg::vk::ExecutorOptions optionsOf(const GpuDevice& gpu, std::uint32_t framesInFlight, DeviceGraph* predecessor,
                                  const fg::vk::Membership& shared) {
  return {.framesInFlight = framesInFlight,
          .timestamps = gpu.device().context().timestampBits > 0,
          .pipelines = gpu.pipelines(),
          .shared = shared,
          .predecessor = predecessor != nullptr ? &predecessor->executor() : nullptr};
}

}  // namespace

DeviceGraph::DeviceGraph(const GpuDevice& gpu, const fg::Graph& graph, std::uint32_t framesInFlight,
                         DeviceGraph* predecessor, const fg::vk::Membership& shared)
    : plan_(compileFor(gpu, graph)),
      executor_(gpu.device().context(), graph.desc(), plan_, optionsOf(gpu, framesInFlight, predecessor, shared)) {}

ReadbackGraph::ReadbackGraph(const GpuDevice& gpu, const fg::Graph& graph, std::uint32_t framesInFlight,
                             const fg::vk::Membership& shared)
    : gpu_(gpu),
      declared_(graph),
      framesInFlight_(framesInFlight),
      graph_(gpu, graph, framesInFlight, nullptr, shared),
      queue_(gpu.device().context(), gpu.device().queue(), framesInFlight) {}

UploadedTexture& ReadbackGraph::addUpload(fg::Texture texture) {
  return uploads_.emplace_back(gpu_.device().context(), declared_, executor(), texture, framesInFlight_);
}

ReadbackGraph::Index ReadbackGraph::readBack(fg::Texture texture) {
  const fg::vk::StagedImage& image = std::get<fg::vk::StagedImage>(readbacks_.emplace_back(
      std::in_place_type<fg::vk::StagedImage>, gpu_.device().context(), declared_.textureDesc(texture),
      executor().usage(texture), fg::vk::StagedImage::Direction::Readback, framesInFlight_,
      declared_.desc().resources[texture.resource].name));
  executor().bind(texture, image.external());
  return readbacks_.size() - 1;
}

ReadbackGraph::Index ReadbackGraph::readBack(fg::Buffer buffer) {
  const fg::ResourceDecl& declared = declared_.desc().resources[buffer.resource];
  const fg::vk::StagedBuffer& staged = std::get<fg::vk::StagedBuffer>(readbacks_.emplace_back(
      std::in_place_type<fg::vk::StagedBuffer>, gpu_.device().context(), std::get<fg::BufferDesc>(declared.desc),
      executor().usage(buffer), framesInFlight_, declared.name));
  executor().bind(buffer, staged.handle());
  return readbacks_.size() - 1;
}

fg::vk::Frame ReadbackGraph::begin() {
  if (full()) throw std::logic_error("the largest number of frames is in flight: finish one first");
  return queue_.begin();
}

void ReadbackGraph::submit(const fg::vk::Frame& frame) {
  executor().record(frame.commandBuffer, frame.slot);
  for (const Readback& readback : readbacks_) {
    std::visit([&](const auto& staged) { staged.recordReadback(frame.commandBuffer, frame.slot); }, readback);
  }
  queue_.submit(frame);
  inFlight_.push_back(frame.slot);
}

std::uint32_t ReadbackGraph::finish() {
  const std::uint32_t slot = inFlight_.front();
  inFlight_.pop_front();
  queue_.wait(slot);
  return slot;
}

std::span<const std::byte> ReadbackGraph::staging(Index index, std::uint32_t slot) const {
  return std::visit([&](const auto& staged) -> std::span<const std::byte> { return staged.staging(slot); },
                    readbacks_.at(index));
}

}  // namespace walr
