#include "samples/host/renderer.h"

#include <algorithm>
#include <span>
#include <stdexcept>

namespace walr::host {
namespace {

HostTargets targetsOf(const Renderer::Options& options) {
  constexpr HostTargets::Target kReadBack{fg::vk::kOverwritable, fg::vk::kReadable};
  HostTargets targets;
  targets.display = kReadBack;
  if (options.readComposite) {
    targets.composite = kReadBack;
  }
  if (options.readDenoised) {
    targets.denoised = kReadBack;
  }
  return targets;
}

template <typename Texel>
std::vector<Texel> texelsOf(const fg::vk::StagedImage& image, std::uint32_t slot) {
  const std::span<const std::byte> bytes = image.staging(slot);
  std::vector<Texel> texels(bytes.size() / sizeof(Texel));
  std::ranges::copy(bytes, std::as_writable_bytes(std::span(texels)).begin());
  return texels;
}

}  // namespace

Renderer::Renderer(const GpuDevice& gpu, Denoiser& method, fg::Extent extent, const Options& options)
    : gpu_(gpu),
      extent_(extent),
      options_(options),
      host_(declareHostGraph(gpu.device().context(), method, extent, options.view, targetsOf(options))),
      plan_(compileFor(gpu, host_.graph)),
      executor_(gpu.device().context(), host_.graph.desc(), plan_,
                {.framesInFlight = options.framesInFlight, .timestamps = gpu.device().context().timestampBits > 0}),
      queue_(gpu.device().context(), gpu.device().queue(), options.framesInFlight) {
  makeReadback(display_, host_.display, "display");
  if (options.readComposite) {
    makeReadback(composite_, host_.composite, "lit");
  }
  if (options.readDenoised) {
    makeReadback(denoised_, host_.denoised, "denoised");
  }
}

void Renderer::makeReadback(Readback& image, fg::Texture texture, const char* name) {
  image.emplace(gpu_.device().context(), host_.graph.textureDesc(texture), executor_.usage(texture),
                fg::vk::StagedImage::Direction::Readback, options_.framesInFlight, name);
  executor_.bind(texture, image->external());
}

void Renderer::submit(const HostFrame& frame) {
  if (full()) {
    throw std::logic_error("Renderer::submit: finish a frame first");
  }
  uploadFrame(executor_, host_, frame, options_.viewConstants);
  const fg::vk::Frame recorded = queue_.begin();
  executor_.record(recorded.commandBuffer, recorded.slot);
  for (const Readback* image : {&display_, &composite_, &denoised_}) {
    if (*image) {
      (*image)->recordReadback(recorded.commandBuffer, recorded.slot);
    }
  }
  queue_.submit(recorded);
  inFlight_.push_back({frame.inputs.frame.number, recorded.slot});
}

std::optional<RenderedFrame> Renderer::finish() {
  if (inFlight_.empty()) {
    return std::nullopt;
  }
  const InFlight oldest = inFlight_.front();
  inFlight_.pop_front();
  queue_.wait(oldest.slot);
  RenderedFrame frame;
  frame.number = oldest.number;
  frame.display = texelsOf<std::uint32_t>(*display_, oldest.slot);
  const auto readImage = [&](const Readback& image) {
    return image ? unpackRgb(texelsOf<Rgba16>(*image, oldest.slot), static_cast<int>(extent_.width),
                             static_cast<int>(extent_.height))
                 : Image();
  };
  frame.composite = readImage(composite_);
  frame.denoised = readImage(denoised_);
  const auto times = executor_.passTimes(oldest.slot);
  frame.passTimes.assign(times.begin(), times.end());
  return frame;
}

void uploadFrame(fg::vk::Executor& executor, const HostGraph& graph, const HostFrame& frame,
                 const ViewConstants& view) {
  const PackedFrame& inputs = frame.inputs;
  const auto upload = [&](const UploadedPicture& picture, auto texels) {
    executor.upload(picture.bytes, std::as_bytes(std::span(texels.data(), texels.size())));
  };
  upload(graph.lighting, std::span(inputs.lighting));
  upload(graph.depth, inputs.frame.depth.values());
  upload(graph.normal, std::span(inputs.normal));
  upload(graph.motion, std::span(inputs.motion));
  upload(graph.albedo, std::span(inputs.albedo));
  upload(graph.objectId, std::span(inputs.objectId));
  upload(graph.direct, std::span(frame.direct));
  upload(graph.emission, std::span(frame.emission));
  if (graph.referenceIndirect) {
    upload(*graph.referenceIndirect, std::span(frame.referenceIndirect));
    upload(*graph.referenceDirect, std::span(frame.referenceDirect));
  }
  executor.upload(graph.frameConstants, frameConstantsOf(inputs.frame, glm::vec2(1.0F)));
  if (graph.viewConstants) {
    executor.upload(*graph.viewConstants, view);
  }
  if (inputs.frame.resetHistory) {
    executor.resetAllHistory();
  }
}

}  // namespace walr::host
