#include "samples/denoise/gpu_denoiser.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <numeric>
#include <span>
#include <stdexcept>
#include <utility>

#include "passes/conventions/light_direction.h"
#include "samples/denoise/device_graph.h"

namespace walr {
namespace {

bool isGiven(const HostInput& input, const OptionalImages& given, bool specular) {
  if (input.texture == &DenoiserInputs::objectId) return given.objectIds;
  if (input.texture == &DenoiserInputs::specularMotion) return given.specularMotion && specular;
  return !input.optional;
}

/// Formats of the host's inputs; undefined for those that frames do not have.
std::array<VkFormat, kHostInputs.size()> formatsOf(const OptionalImages& given, bool specular) {
  std::array<VkFormat, kHostInputs.size()> formats{};
  std::ranges::transform(kHostInputs, formats.begin(), [&](const HostInput& input) {
    return isGiven(input, given, specular) ? input.format : VK_FORMAT_UNDEFINED;
  });
  return formats;
}

/// The lights of a layout's kind that methods denoise.
std::vector<DenoisedLight> lightsOf(std::span<Denoiser* const> methods, const Layout& layout) {
  std::vector<DenoisedLight> lights;
  for (Denoiser* const method : methods) lights.push_back({method, layout.conventions.specular});
  return lights;
}

/// The first three components of RGBA32F texels.
Image viewImage(std::span<const std::array<float, 4>> texels, int width, int height) {
  Image image(width, height, 3);
  for (std::size_t i = 0; i < image.pixelCount(); ++i) std::copy_n(texels[i].begin(), 3, image.pixel(i).begin());
  return image;
}

LightSlopes slopeImages(std::span<const glm::uvec2> texels, int width, int height) {
  LightSlopes images;
  images.fill(Image(width, height, 3));
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const glm::mat3 slopes = lightSlopes(texels[i]);
    for (int axis = 0; axis < 3; ++axis) {
      for (int c = 0; c < 3; ++c) images.at(axis).pixel(i)[c] = slopes[axis][c];
    }
  }
  return images;
}

}  // namespace

struct GpuDenoiser::State {
  State(const GpuDevice& gpu, std::span<Denoiser* const> methods, fg::Extent extent, const Layout& frameLayout,
        const InspectionWish& wanted, std::uint32_t framesInFlight, const OptionalImages& given,
        const fg::vk::Membership& shared)
      : layout(frameLayout),
        declared(declareDenoiseGraph(
            lightsOf(methods, frameLayout), extent, layout.conventions,
            {.inputs = fg::vk::kUploaded, .outputBefore = fg::vk::kOverwritable, .outputAfter = fg::vk::kReadable},
            formatsOf(given, layout.conventions.specular), {}, wanted)),
        graph(gpu, declared.graph, framesInFlight, shared),
        depth(graph.addUpload(declared.inputs.depth)),
        normal(graph.addUpload(declared.inputs.normal)),
        motion(graph.addUpload(declared.inputs.motion)),
        albedo(graph.addUpload(declared.inputs.lobeAlbedo())) {
    for (const LightImages& light : declared.lights) {
      lighting.push_back(&graph.addUpload(light.lighting));
      outputs.push_back(graph.readBack(light.output));
      if (light.lightDirection.valid()) lightDirections.push_back(graph.readBack(light.lightDirection));
    }
    if (layout.conventions.specular) roughness = &graph.addUpload(declared.inputs.roughness);
    if (declared.inputs.specularMotion.valid()) specularMotion = &graph.addUpload(declared.inputs.specularMotion);
    if (given.objectIds) objectId = &graph.addUpload(declared.inputs.objectId);
    for (const DebugView& view : declared.views) views.push_back(graph.readBack(view.texture));
    if (!declared.inspection.counters().empty()) counters = graph.readBack(declared.inspection.counterBuffer());
  }

  /// Record and submit a frame.
  /// @param lights    as many as there are methods
  void submit(const PackedFrame& packed, std::span<const LightTexels> lights, const PackedLobe& lobe);
  /// The same for lights of the lobe of the frame's own light.
  void submit(const PackedFrame& packed, std::span<const LightTexels> lights) { submit(packed, lights, packed.lobe); }
  /// Wait for the oldest frame and read it back.
  DenoisedPicture finish();

  const Layout& layout;
  DenoiseGraph declared;
  ReadbackGraph graph;
  std::vector<UploadedTexture*> lighting;  ///< Of each light.
  UploadedTexture& depth;
  UploadedTexture& normal;
  UploadedTexture& motion;
  UploadedTexture& albedo;
  UploadedTexture* roughness = nullptr;  ///< These three are null where there is no such input.
  UploadedTexture* specularMotion = nullptr;
  UploadedTexture* objectId = nullptr;
  std::vector<ReadbackGraph::Index> outputs;  ///< Of each light.
  std::vector<ReadbackGraph::Index> views;
  std::optional<ReadbackGraph::Index> counters;
  std::vector<ReadbackGraph::Index> lightDirections;  ///< Of each light, if they are wanted.
  std::deque<Frame> frames;                           ///< Frames in flight, except that of `run`.
};

OptionalImages optionalImages(const RecognizedLayout& layout) {
  return {.objectIds = layout.objectIds, .specularMotion = layout.hasSpecular(Role::SpecularMotion)};
}

std::optional<double> DenoisedPicture::milliseconds() const {
  if (passes.empty()) {
    return std::nullopt;
  }
  return std::accumulate(passes.begin(), passes.end(), 0.0,
                         [](double sum, const fg::vk::PassTime& time) { return sum + time.milliseconds; });
}

void GpuDenoiser::State::submit(const PackedFrame& packed, std::span<const LightTexels> lights,
                                const PackedLobe& lobe) {
  const Frame& frame = packed.frame;
  if (lights.size() != lighting.size()) {
    throw std::logic_error("GpuDenoiser::submit: the frame has " + std::to_string(lights.size()) +
                           " lights, and the denoiser is for " + std::to_string(lighting.size()));
  }
  if (!layout.conventions.specular && frame.light != layout.conventions.light) {
    throw std::logic_error("GpuDenoiser::submit: other pixels of the frame have light than the layout says");
  }
  const FrameConstants constants = frameConstantsOf(frame, layout.motionScale);
  const fg::vk::Frame recorded = graph.begin();
  graph.executor().upload(declared.inputs.frame, constants);
  if (frame.resetHistory) {
    graph.executor().resetAllHistory();
  }
  for (std::size_t i = 0; i < lights.size(); ++i) lighting[i]->upload(recorded, lights[i]);
  depth.upload(recorded, frame.depth.values());
  normal.upload(recorded, packed.normal);
  motion.upload(recorded, packed.motion);
  albedo.upload(recorded, lobe.albedo);
  if (roughness) roughness->upload(recorded, lobe.roughness);
  if (specularMotion) specularMotion->upload(recorded, lobe.motion);
  if (objectId) objectId->upload(recorded, packed.objectId);
  graph.submit(recorded);
}

DenoisedPicture GpuDenoiser::State::finish() {
  const std::uint32_t slot = graph.finish();
  const fg::Extent extent = declared.graph.textureDesc(declared.lights.front().output).extent;
  const auto width = static_cast<int>(extent.width);
  const auto height = static_cast<int>(extent.height);
  const std::span<const fg::vk::PassTime> times = graph.executor().passTimes(slot);
  DenoisedPicture picture;
  picture.passes.assign(times.begin(), times.end());
  for (const ReadbackGraph::Index output : outputs) {
    picture.lights.push_back(unpackRgb(graph.read<Rgba16>(output, slot), width, height));
  }
  for (std::size_t i = 0; i < views.size(); ++i) {
    const auto texels = graph.read<std::array<float, 4>>(views[i], slot);
    picture.views.push_back({declared.views[i].name, viewImage(texels, width, height)});
  }
  if (!lightDirections.empty()) {
    picture.slopes = slopeImages(graph.read<glm::uvec2>(lightDirections.front(), slot), width, height);
  }
  if (counters) {
    const auto words = graph.read<std::uint32_t>(*counters, slot);
    for (const Counter& counter : declared.inspection.counters())
      picture.counters.push_back({counter.name, counter.value(words)});
  }
  return picture;
}

GpuDenoiser::GpuDenoiser(const GpuDevice& device, std::span<Denoiser* const> methods, fg::Extent extent,
                         const Layout& layout, const InspectionWish& wanted, std::uint32_t framesInFlight,
                         const OptionalImages& given, const fg::vk::Membership& shared)
    : state_(std::make_unique<State>(device, methods, extent, layout, wanted, framesInFlight, given, shared)) {}
GpuDenoiser::GpuDenoiser(const GpuDevice& device, Denoiser& method, fg::Extent extent, const Layout& layout,
                         const InspectionWish& wanted, std::uint32_t framesInFlight, const OptionalImages& given,
                         const fg::vk::Membership& shared)
    : GpuDenoiser(device, std::array{&method}, extent, layout, wanted, framesInFlight, given, shared) {}
GpuDenoiser::~GpuDenoiser() = default;
GpuDenoiser::GpuDenoiser(GpuDenoiser&&) noexcept = default;
GpuDenoiser& GpuDenoiser::operator=(GpuDenoiser&&) noexcept = default;

bool GpuDenoiser::full() const {
  return state_->graph.full();
}

void GpuDenoiser::submit(PackedFrame packed, std::span<const LightTexels> further) {
  std::vector<LightTexels> lights{packed.lighting};
  lights.insert(lights.end(), further.begin(), further.end());
  state_->submit(packed, lights);
  state_->frames.push_back(std::move(packed.frame));
}

std::optional<DenoisedFrame> GpuDenoiser::finish() {
  if (state_->frames.empty()) return std::nullopt;
  DenoisedPicture picture = state_->finish();
  DenoisedFrame denoised;
  denoised.gpuMilliseconds = picture.milliseconds();
  denoised.indirect = std::move(picture.lights.front());
  if (picture.lights.size() > 1) denoised.direct = std::move(picture.lights[1]);
  denoised.views = std::move(picture.views);
  denoised.counters = std::move(picture.counters);
  denoised.slopes = std::move(picture.slopes);
  denoised.frame = std::move(state_->frames.front());
  state_->frames.pop_front();
  return denoised;
}

void GpuDenoiser::submitLight(const PackedFrame& packed, const std::vector<Rgba16>& lighting) {
  state_->submit(packed, std::array{LightTexels(lighting)});
}

void GpuDenoiser::submitLight(const PackedFrame& packed, const PackedLight& light) {
  state_->submit(packed, std::array{LightTexels(light.lighting)}, light.lobe);
}

DenoisedPicture GpuDenoiser::finishPicture() {
  return state_->finish();
}

DenoisedPicture GpuDenoiser::run(const PackedFrame& packed) {
  if (!state_->frames.empty()) throw std::logic_error("GpuDenoiser::run: finish the frames in flight first");
  state_->submit(packed, std::array{LightTexels(packed.lighting)});
  return state_->finish();
}

DenoisedFrame GpuDenoiser::denoise(PackedFrame packed) {
  if (!state_->frames.empty()) throw std::logic_error("GpuDenoiser::denoise: finish the frames in flight first");
  submit(std::move(packed));
  return *finish();
}

}  // namespace walr
