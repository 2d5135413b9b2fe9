#include "samples/denoise/gpu_denoiser.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <deque>
#include <numeric>
#include <span>
#include <stdexcept>
#include <utility>

#include "framegraph/vulkan/device.h"
#include "framegraph/vulkan/executor.h"
#include "framegraph/vulkan/frame_queue.h"
#include "framegraph/vulkan/staged_buffer.h"
#include "framegraph/vulkan/staged_image.h"

namespace walr {
namespace {

/// A picture on its way to the device: the graph's texture and the image behind it.
class UploadedTexture {
 public:
  UploadedTexture(const fg::vk::DeviceContext& device, const fg::Graph& graph, fg::vk::Executor& executor,
                  fg::Texture texture, std::uint32_t slots)
      : image_(device, graph.textureDesc(texture), executor.usage(texture), fg::vk::StagedImage::Direction::Upload,
               slots, graph.desc().resources[texture.resource].name) {
    executor.bind(texture, image_.external());
  }

  template <typename Texels>
  void upload(const fg::vk::Frame& frame, const Texels& texels) const {
    const auto bytes = std::as_bytes(std::span(texels));
    std::ranges::copy(bytes, image_.staging(frame.slot).begin());
    image_.recordUpload(frame.commandBuffer, frame.slot);
  }

 private:
  fg::vk::StagedImage image_;
};

/// The usual formats, and that of the object numbers where there are some.
std::array<VkFormat, kHostInputs.size()> formatsOf(bool objectIds) {
  std::array<VkFormat, kHostInputs.size()> formats{};
  std::ranges::transform(kHostInputs, formats.begin(), [&](const HostInput& input) {
    return input.optional && !objectIds ? VK_FORMAT_UNDEFINED : input.format;
  });
  return formats;
}

/// A buffer of counters as a finished frame left it.
std::vector<std::uint32_t> wordsOf(const fg::vk::StagedBuffer& counters, std::uint32_t slot) {
  std::vector<std::uint32_t> words(kCounterWords);
  std::ranges::copy(counters.staging(slot), std::as_writable_bytes(std::span(words)).begin());
  return words;
}

/// The first three components of RGBA32F texels.
Image viewImage(std::span<const std::byte> texels, int width, int height) {
  Image image(width, height, 3);
  for (std::size_t i = 0; i < image.pixelCount(); ++i) {
    std::memcpy(image.pixel(i).data(), texels.data() + i * 4 * sizeof(float), 3 * sizeof(float));
  }
  return image;
}

}  // namespace

struct GpuDenoiser::State {
  State(const GpuDevice& gpu, Denoiser& method, fg::Extent extent, const Layout& frameLayout,
        const InspectionWish& wanted, std::uint32_t slots, bool objectIds)
      : framesInFlight(slots),
        device(gpu.device()),
        layout(frameLayout),
        declared(declareDenoiseGraph(
            method, extent, layout.conventions,
            {.inputs = fg::vk::kUploaded, .outputBefore = fg::vk::kOverwritable, .outputAfter = fg::vk::kReadable},
            formatsOf(objectIds), {}, wanted)),
        executor(device.context(), declared.graph.desc(), compileFor(gpu, declared.graph),
                 {.framesInFlight = slots, .timestamps = device.context().timestampBits > 0}),
        lighting(makeUpload(declared.inputs.lighting)),
        depth(makeUpload(declared.inputs.depth)),
        normal(makeUpload(declared.inputs.normal)),
        motion(makeUpload(declared.inputs.motion)),
        albedo(makeUpload(declared.inputs.albedo)),
        output(device.context(), declared.graph.textureDesc(declared.output), executor.usage(declared.output),
               fg::vk::StagedImage::Direction::Readback, slots, "denoised"),
        queue(device.context(), device.queue(), slots) {
    executor.bind(declared.output, output.external());
    if (objectIds) objectId.emplace(device.context(), declared.graph, executor, declared.inputs.objectId, slots);
    for (const DebugView& view : declared.inspection.views()) {
      views.emplace_back(device.context(), declared.graph.textureDesc(view.texture), executor.usage(view.texture),
                         fg::vk::StagedImage::Direction::Readback, slots, "view of " + view.name);
      executor.bind(view.texture, views.back().external());
    }
    if (!declared.inspection.counters().empty()) makeReadback(counters, declared.inspection.counterBuffer());
    if (declared.lint.valid()) makeReadback(lint, declared.lint);
  }

  void makeReadback(std::optional<fg::vk::StagedBuffer>& counts, fg::Buffer buffer) {
    counts.emplace(device.context(), fg::BufferDesc{kCounterBytes}, executor.usage(buffer), framesInFlight,
                   declared.graph.desc().resources[buffer.resource].name);
    executor.bind(buffer, counts->handle());
  }

  UploadedTexture makeUpload(fg::Texture texture) {
    return {device.context(), declared.graph, executor, texture, framesInFlight};
  }

  /// Record and submit a frame. @returns its slot
  std::uint32_t submit(const PackedFrame& packed);
  /// Wait for the frame of a slot and read it back.
  DenoisedPicture finish(std::uint32_t slot);

  /// A frame that the device has not been waited for.
  struct InFlight {
    Frame frame;
    std::uint32_t slot;
  };

  std::uint32_t framesInFlight;
  const fg::vk::Device& device;
  const Layout& layout;
  DenoiseGraph declared;
  fg::vk::Executor executor;
  UploadedTexture lighting;
  UploadedTexture depth;
  UploadedTexture normal;
  UploadedTexture motion;
  UploadedTexture albedo;
  std::optional<UploadedTexture> objectId;
  fg::vk::StagedImage output;
  std::vector<fg::vk::StagedImage> views;
  std::optional<fg::vk::StagedBuffer> counters;
  std::optional<fg::vk::StagedBuffer> lint;
  fg::vk::FrameQueue queue;
  std::deque<InFlight> inFlight;
};

std::optional<double> DenoisedPicture::milliseconds() const {
  if (passes.empty()) {
    return std::nullopt;
  }
  return std::accumulate(passes.begin(), passes.end(), 0.0,
                         [](double sum, const fg::vk::PassTime& time) { return sum + time.milliseconds; });
}

std::uint32_t GpuDenoiser::State::submit(const PackedFrame& packed) {
  if (inFlight.size() == framesInFlight) throw std::logic_error("GpuDenoiser::submit: finish a frame first");
  const Frame& frame = packed.frame;
  executor.upload(declared.inputs.frame, frameConstantsOf(frame, layout.motionScale));
  if (frame.resetHistory) {
    executor.resetAllHistory();
  }
  const fg::vk::Frame recorded = queue.begin();
  lighting.upload(recorded, packed.lighting);
  depth.upload(recorded, frame.depth.values());
  normal.upload(recorded, packed.normal);
  motion.upload(recorded, packed.motion);
  albedo.upload(recorded, packed.albedo);
  if (objectId) objectId->upload(recorded, packed.objectId);
  executor.record(recorded.commandBuffer, recorded.slot);
  output.recordReadback(recorded.commandBuffer, recorded.slot);
  for (const fg::vk::StagedImage& view : views) view.recordReadback(recorded.commandBuffer, recorded.slot);
  for (const auto* counts : {&counters, &lint}) {
    if (*counts) (*counts)->recordReadback(recorded.commandBuffer, recorded.slot);
  }
  queue.submit(recorded);
  return recorded.slot;
}

DenoisedPicture GpuDenoiser::State::finish(std::uint32_t slot) {
  queue.wait(slot);
  const fg::Extent extent = declared.graph.textureDesc(declared.output).extent;
  const auto width = static_cast<int>(extent.width);
  const auto height = static_cast<int>(extent.height);
  std::vector<Rgba16> texels(std::size_t{extent.width} * extent.height);
  std::ranges::copy(output.staging(slot), std::as_writable_bytes(std::span(texels)).begin());
  const std::span<const fg::vk::PassTime> times = executor.passTimes(slot);
  DenoisedPicture picture{unpackRgb(texels, width, height), {times.begin(), times.end()}, {}, {}, {}};
  for (std::size_t i = 0; i < views.size(); ++i)
    picture.views.push_back({declared.inspection.views()[i].name, viewImage(views[i].staging(slot), width, height)});
  if (lint) picture.lint = wordsOf(*lint, slot);
  if (counters) {
    const std::vector<std::uint32_t> words = wordsOf(*counters, slot);
    for (const Counter& counter : declared.inspection.counters())
      picture.counters.push_back({counter.name, counter.value(words)});
  }
  return picture;
}

GpuDenoiser::GpuDenoiser(const GpuDevice& device, Denoiser& method, fg::Extent extent, const Layout& layout,
                         const InspectionWish& wanted, std::uint32_t framesInFlight, bool objectIds)
    : state_(std::make_unique<State>(device, method, extent, layout, wanted, framesInFlight, objectIds)) {}
GpuDenoiser::~GpuDenoiser() = default;
GpuDenoiser::GpuDenoiser(GpuDenoiser&&) noexcept = default;
GpuDenoiser& GpuDenoiser::operator=(GpuDenoiser&&) noexcept = default;

bool GpuDenoiser::full() const {
  return state_->inFlight.size() == state_->framesInFlight;
}

void GpuDenoiser::submit(PackedFrame packed) {
  const std::uint32_t slot = state_->submit(packed);
  state_->inFlight.push_back({std::move(packed.frame), slot});
}

std::optional<DenoisedFrame> GpuDenoiser::finish() {
  if (state_->inFlight.empty()) return std::nullopt;
  State::InFlight oldest = std::move(state_->inFlight.front());
  state_->inFlight.pop_front();
  DenoisedPicture picture = state_->finish(oldest.slot);
  DenoisedFrame denoised;
  denoised.gpuMilliseconds = picture.milliseconds();
  denoised.indirect = std::move(picture.indirect);
  denoised.views = std::move(picture.views);
  denoised.counters = std::move(picture.counters);
  denoised.frame = std::move(oldest.frame);
  return denoised;
}

DenoisedPicture GpuDenoiser::run(const PackedFrame& packed) {
  if (!state_->inFlight.empty()) throw std::logic_error("GpuDenoiser::run: finish the frames in flight first");
  return state_->finish(state_->submit(packed));
}

DenoisedFrame GpuDenoiser::denoise(PackedFrame packed) {
  if (!state_->inFlight.empty()) throw std::logic_error("GpuDenoiser::denoise: finish the frames in flight first");
  submit(std::move(packed));
  return *finish();
}

}  // namespace walr
