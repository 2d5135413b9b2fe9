#include "samples/denoise/gpu_linter.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "passes/lint/input_linter.h"
#include "passes/lint/lint_specular.h"
#include "samples/denoise/device_graph.h"
#include "samples/denoise/packed_frame.h"

namespace walr {
namespace {

using Bytes = std::vector<std::byte>;

template <typename Texels>
Bytes bytesOf(const Texels& texels) {
  const auto bytes = std::as_bytes(std::span(texels));
  return {bytes.begin(), bytes.end()};
}

/// Specular light; where the frame tells no distance, alpha marks that there is a sample.
Bytes specularTexels(const Frame& frame) {
  if (!frame.specularDistance.empty()) return bytesOf(packLight(frame, Light::Specular));
  std::vector<Rgba16> texels = packRgba16(frame.specular);
  constexpr std::uint16_t kOne = 0x3c00;
  for (Rgba16& texel : texels) texel[3] = kOne;
  return bytesOf(texels);
}

/// A texture that the linter reads, and its texels of a frame.
struct LintImage {
  const char* name;
  VkFormat format;
  Bytes (*texels)(const Frame&);
};
constexpr VkFormat kColour = VK_FORMAT_R16G16B16A16_SFLOAT;
constexpr LintImage kLighting{"lighting", kColour,
                              [](const Frame& f) { return bytesOf(packLight(f, Light::Indirect)); }};
constexpr LintImage kDepth{"depth", VK_FORMAT_R32_SFLOAT, [](const Frame& f) { return bytesOf(f.depth.values()); }};
constexpr LintImage kNormal{"normal", kColour, [](const Frame& f) { return bytesOf(packRgba16(f.normal)); }};
constexpr LintImage kMotion{"motion", kColour, [](const Frame& f) { return bytesOf(packRgba16(f.motion)); }};
constexpr LintImage kAlbedo{"albedo", kColour, [](const Frame& f) { return bytesOf(packRgba16(f.albedo)); }};
constexpr LintImage kSpecular{"specular light", kColour, specularTexels};
constexpr LintImage kSpecularAlbedo{"specular albedo", kColour,
                                    [](const Frame& f) { return bytesOf(packRgba16(f.specularAlbedo)); }};
// Floats, so that values outside its range can be seen.
constexpr LintImage kRoughness{"roughness", VK_FORMAT_R32_SFLOAT,
                               [](const Frame& f) { return bytesOf(f.roughness.values()); }};
constexpr LintImage kSpecularMotion{"specular motion", kColour,
                                    [](const Frame& f) { return bytesOf(packRgba16(f.specularMotion)); }};

}  // namespace

struct GpuLinter::State {
  State(const GpuDevice& device, fg::Extent size, const Layout& frames)
      : gpu(device), extent(size), layout(frames), linter(frames.conventions) {}

  /// Declare the passes for frames with the images of this one.
  void declare(const Frame& frame);
  fg::Texture import(const LintImage& image, fg::Extent size);
  fg::Texture importIf(bool present, const LintImage& image) { return present ? import(image, extent) : fg::Texture{}; }

  const GpuDevice& gpu;
  fg::Extent extent;
  const Layout& layout;
  InputLinter linter;

  fg::Graph graph;
  fg::Buffer constants;
  struct Upload {
    const LintImage* image;
    fg::Texture texture;
  };
  std::vector<Upload> uploads;
  std::optional<ReadbackGraph> device;
  std::vector<UploadedTexture*> textures;  ///< Of each upload.
  ReadbackGraph::Index words = 0;
};

fg::Texture GpuLinter::State::import(const LintImage& image, fg::Extent size) {
  const fg::Texture texture = graph.import(image.name, {.format = image.format, .extent = size}, fg::vk::kUploaded);
  uploads.push_back({&image, texture});
  return texture;
}

void GpuLinter::State::declare(const Frame& frame) {
  constants = graph.upload("frame", sizeof(FrameConstants));
  const DenoiserInputs inputs{.lighting = import(kLighting, layout.conventions.light.lightingExtent(extent)),
                              .depth = import(kDepth, extent),
                              .normal = import(kNormal, extent),
                              .motion = import(kMotion, extent),
                              .albedo = import(kAlbedo, extent),
                              .frame = constants,
                              .conventions = layout.conventions};
  fg::Buffer counts =
      addLintInputs(graph, inputs, graph.import("counts", fg::BufferDesc{kLintBytes}, fg::vk::kOverwritable));
  if (!frame.specular.empty()) {
    DenoiserInputs specular = inputs;
    specular.lighting = import(kSpecular, extent);
    specular.specularAlbedo = import(kSpecularAlbedo, extent);
    specular.roughness = importIf(!frame.roughness.empty(), kRoughness);
    specular.specularMotion = importIf(!frame.specularMotion.empty(), kSpecularMotion);
    specular.conventions.specular = true;
    specular.conventions.light = {};
    counts = addLintSpecular(graph,
                             {.inputs = specular,
                              .diffuse = layout.conventions.light.fullSize() ? inputs.lighting : fg::Texture{},
                              .distances = !frame.specularDistance.empty(),
                              .ownAlbedo = layout.ownSpecularAlbedo},
                             counts);
  }
  graph.exported(counts, fg::vk::kReadable);
  device.emplace(gpu, graph, 1U);
  for (const Upload& upload : uploads) textures.push_back(&device->addUpload(upload.texture));
  words = device->readBack(counts);
}

GpuLinter::GpuLinter(const GpuDevice& device, fg::Extent extent, const Layout& layout)
    : state_(std::make_unique<State>(device, extent, layout)) {}
GpuLinter::~GpuLinter() = default;
GpuLinter::GpuLinter(GpuLinter&&) noexcept = default;
GpuLinter& GpuLinter::operator=(GpuLinter&&) noexcept = default;

void GpuLinter::add(const Frame& frame) {
  if (!state_->device) state_->declare(frame);
  ReadbackGraph& device = *state_->device;
  const FrameConstants constants = frameConstantsOf(frame, state_->layout.motionScale);
  const fg::vk::Frame recorded = device.begin();
  device.executor().upload(state_->constants, constants);
  for (std::size_t i = 0; i < state_->textures.size(); ++i) {
    state_->textures[i]->upload(recorded, state_->uploads[i].image->texels(frame));
  }
  device.submit(recorded);
  state_->linter.add(device.read<std::uint32_t>(state_->words, device.finish()),
                     frameDescriptionOf(frame, state_->layout.motionScale), state_->extent, !frame.resetHistory);
}

std::vector<LintFinding> GpuLinter::findings() const {
  return state_->linter.findings();
}

}  // namespace walr
