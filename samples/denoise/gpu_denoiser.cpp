#include "samples/denoise/gpu_denoiser.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <span>
#include <utility>

#include "framegraph/vulkan/device.h"
#include "framegraph/vulkan/executor.h"
#include "framegraph/vulkan/frame_queue.h"
#include "framegraph/vulkan/staged_buffer.h"
#include "framegraph/vulkan/staged_image.h"

namespace walr {
namespace {

// Frames are read, denoised and written side by side already; one on the device at a time keeps their order plain.
constexpr std::uint32_t kFramesInFlight = 1;

/// A picture on its way to the device: the graph's texture and the image behind it.
class UploadedTexture {
 public:
  UploadedTexture(const fg::vk::DeviceContext& device, const fg::Graph& graph, fg::vk::Executor& executor,
                  fg::Texture texture)
      : image_(device, graph.textureDesc(texture), executor.usage(texture), fg::vk::StagedImage::Direction::Upload,
               kFramesInFlight, graph.desc().resources[texture.resource].name) {
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
        const InspectionWish& wanted)
      : device(gpu.device()),
        layout(frameLayout),
        declared(declareDenoiseGraph(
            method, extent, layout.conventions,
            {.inputs = fg::vk::kUploaded, .outputBefore = fg::vk::kOverwritable, .outputAfter = fg::vk::kReadable}, {},
            {}, wanted)),
        executor(device.context(), declared.graph.desc(), compileFor(gpu, declared.graph),
                 {.framesInFlight = kFramesInFlight, .timestamps = device.context().timestampBits > 0}),
        lighting(makeUpload(declared.inputs.lighting)),
        depth(makeUpload(declared.inputs.depth)),
        normal(makeUpload(declared.inputs.normal)),
        motion(makeUpload(declared.inputs.motion)),
        albedo(makeUpload(declared.inputs.albedo)),
        output(device.context(), declared.graph.textureDesc(declared.output), executor.usage(declared.output),
               fg::vk::StagedImage::Direction::Readback, kFramesInFlight, "denoised"),
        queue(device.context(), device.queue(), kFramesInFlight) {
    executor.bind(declared.output, output.external());
    for (const DebugView& view : declared.inspection.views()) {
      views.emplace_back(device.context(), declared.graph.textureDesc(view.texture), executor.usage(view.texture),
                         fg::vk::StagedImage::Direction::Readback, kFramesInFlight, "view of " + view.name);
      executor.bind(view.texture, views.back().external());
    }
    if (!declared.inspection.counters().empty()) {
      const fg::Buffer buffer = declared.inspection.counterBuffer();
      counters.emplace(device.context(), fg::BufferDesc{kCounterBytes}, executor.usage(buffer), kFramesInFlight,
                       "counters");
      executor.bind(buffer, counters->handle());
    }
  }

  UploadedTexture makeUpload(fg::Texture texture) { return {device.context(), declared.graph, executor, texture}; }

  const fg::vk::Device& device;
  const Layout& layout;
  DenoiseGraph declared;
  fg::vk::Executor executor;
  UploadedTexture lighting;
  UploadedTexture depth;
  UploadedTexture normal;
  UploadedTexture motion;
  UploadedTexture albedo;
  fg::vk::StagedImage output;
  std::vector<fg::vk::StagedImage> views;
  std::optional<fg::vk::StagedBuffer> counters;
  fg::vk::FrameQueue queue;
};

std::optional<double> DenoisedPicture::milliseconds() const {
  if (passes.empty()) {
    return std::nullopt;
  }
  return std::accumulate(passes.begin(), passes.end(), 0.0,
                         [](double sum, const fg::vk::PassTime& time) { return sum + time.milliseconds; });
}

GpuDenoiser::GpuDenoiser(const GpuDevice& device, Denoiser& method, fg::Extent extent, const Layout& layout,
                         const InspectionWish& wanted)
    : state_(std::make_unique<State>(device, method, extent, layout, wanted)) {}
GpuDenoiser::~GpuDenoiser() = default;
GpuDenoiser::GpuDenoiser(GpuDenoiser&&) noexcept = default;
GpuDenoiser& GpuDenoiser::operator=(GpuDenoiser&&) noexcept = default;

DenoisedPicture GpuDenoiser::run(const PackedFrame& packed) {
  State& state = *state_;
  const Frame& frame = packed.frame;
  state.executor.upload(state.declared.inputs.frame, frameConstantsOf(frame, state.layout.motionScale));
  if (frame.resetHistory) {
    state.executor.resetAllHistory();
  }
  const fg::vk::Frame recorded = state.queue.begin();
  state.lighting.upload(recorded, packed.lighting);
  state.depth.upload(recorded, frame.depth.values());
  state.normal.upload(recorded, packed.normal);
  state.motion.upload(recorded, packed.motion);
  state.albedo.upload(recorded, packed.albedo);
  state.executor.record(recorded.commandBuffer, recorded.slot);
  state.output.recordReadback(recorded.commandBuffer, recorded.slot);
  for (const fg::vk::StagedImage& view : state.views) view.recordReadback(recorded.commandBuffer, recorded.slot);
  if (state.counters) state.counters->recordReadback(recorded.commandBuffer, recorded.slot);
  state.queue.submit(recorded);
  state.queue.wait(recorded.slot);

  std::vector<Rgba16> texels(frame.depth.pixelCount());
  std::ranges::copy(state.output.staging(recorded.slot), std::as_writable_bytes(std::span(texels)).begin());
  const std::span<const fg::vk::PassTime> times = state.executor.passTimes(recorded.slot);
  DenoisedPicture picture{
      unpackRgb(texels, frame.depth.width(), frame.depth.height()), {times.begin(), times.end()}, {}, {}};
  for (std::size_t i = 0; i < state.views.size(); ++i) {
    picture.views.push_back(
        {state.declared.inspection.views()[i].name,
         viewImage(state.views[i].staging(recorded.slot), frame.depth.width(), frame.depth.height())});
  }
  if (state.counters) {
    std::array<std::uint32_t, kCounterWords> words{};
    std::ranges::copy(state.counters->staging(recorded.slot), std::as_writable_bytes(std::span(words)).begin());
    for (const Counter& counter : state.declared.inspection.counters())
      picture.counters.push_back({counter.name, counter.value(words)});
  }
  return picture;
}

DenoisedFrame GpuDenoiser::denoise(PackedFrame packed) {
  DenoisedPicture picture = run(packed);
  DenoisedFrame denoised;
  denoised.indirect = std::move(picture.indirect);
  denoised.gpuMilliseconds = picture.milliseconds();
  denoised.views = std::move(picture.views);
  denoised.counters = std::move(picture.counters);
  denoised.frame = std::move(packed.frame);
  return denoised;
}

}  // namespace walr
