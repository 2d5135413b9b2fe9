#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framegraph/declare/graph.h"
#include "framegraph/vulkan/device_context.h"
#include "passes/methods/denoiser.h"
#include "samples/gpu_render/gpu_scene.h"
#include "samples/gpu_render/trace_pass.h"
#include "samples/host/host_passes.h"

namespace walr::host {

/// What is displayed.
struct HostView {
  enum class Kind {
    Denoised,   ///< The lit image with the denoised light.
    Noisy,      ///< The lit image with the traced, noisy light.
    Reference,  ///< The lit image with the light of the reference.
    Split,      ///< Noisy, denoised and reference side by side.
    Compare,    ///< The method on the left, another one on the same light on the right.
    Texture,    ///< The values of one texture of the graph.
  };
  Kind kind = Kind::Denoised;
  std::string texture = {};      ///< Name of the texture, for `Kind::Texture`.
  Denoiser* compared = nullptr;  ///< The method on the right, for `Kind::Compare`; must live while graphs are declared.
  bool lint = false;             ///< Check the inputs, too.

  /// Whether this view shows the traced light.
  [[nodiscard]] bool needsNoisy() const { return kind == Kind::Noisy || kind == Kind::Split; }
  /// Whether this view needs frames with a reference.
  [[nodiscard]] bool needsReference() const { return kind == Kind::Reference || kind == Kind::Split; }
  friend bool operator==(const HostView&, const HostView&) = default;
};

/// What the names of the passes, textures and histories of `HostView::compared` begin with.
inline constexpr std::string_view kComparedPrefix = "right: ";

/// A host's whole frame as one graph: uploads or the path tracer, the method's passes, composite, tone map.
struct HostGraph {
  fg::Graph graph;
  /// If the device traces: what the tracer's pass needs. The pictures below then have no bytes to upload.
  std::optional<gpu_render::TraceInputs> trace;
  /// If the device traces: the rays of each row, a uint each, to be read back as `fg::vk::kReadable`.
  std::optional<fg::Buffer> rays;
  UploadedPicture lighting;                   ///< With sparse light, one texel for each group of pixels.
  std::optional<UploadedPicture> noisyLight;  ///< The same for all pixels, for views that show sparse light.
  UploadedPicture depth;
  UploadedPicture normal;
  UploadedPicture motion;
  UploadedPicture albedo;
  UploadedPicture objectId;
  UploadedPicture direct;
  UploadedPicture emission;
  /// Light of the specular lobe, divided by `specularAlbedo`; alpha: see `DenoiserInputs::specularAlbedo`.
  std::optional<UploadedPicture> specular;
  std::optional<UploadedPicture> specularAlbedo;  ///< It and the next two are absent without `specular`.
  std::optional<UploadedPicture> roughness;
  std::optional<UploadedPicture> specularMotion;  ///< See `DenoiserInputs::specularMotion`.
  std::optional<UploadedPicture> referenceIndirect;
  std::optional<UploadedPicture> referenceDirect;
  std::optional<UploadedPicture> referenceSpecular;
  std::optional<fg::Buffer> lint;  ///< With `HostView::lint`: what `InputLinter` reads, as `fg::vk::kReadable`.
  fg::Buffer frameConstants;
  fg::Buffer viewConstants;
  fg::Texture denoised;   ///< RGBA16F: the output of the method.
  fg::Texture composite;  ///< RGBA16F: the lit image with the denoised light; specular too, if the method takes it.
  fg::Texture display;    ///< RGBA8: the displayed image.
};

/// The textures that the host owns, each with its state before and after the graph. An absent one is a transient of the
/// graph.
struct HostTargets {
  struct Target {
    fg::ExternalState before;
    fg::ExternalState after;
  };
  std::optional<Target> denoised;
  std::optional<Target> composite;
  std::optional<Target> display;
  /// Size of the displayed image if it is larger than the frame, which then fills its first columns and rows.
  std::optional<fg::Extent> displayExtent = std::nullopt;
};

/// Declare the frame.
/// @param device   must outlive the graph
/// @param light    pixels that have a sample of light
/// @param present  adds passes that follow the displayed image, for instance one that copies it to a window; may be
///         empty
/// @param scene    what the device traces, must outlive the graph; null: the processor traces, and its pictures are
///         uploaded
/// @param specular  whether frames hold specular light, as `scene` does. It is shown as it was traced if the method
///         does not take it
/// @throws std::invalid_argument naming a setting of the method that is out of range
/// @throws also naming a method or setting that does not take sparse light
/// @throws UsageError if the device traces and the view needs a reference; or if the graph lacks the texture to view;
/// the message lists the graph's textures; or if specular light is sparse
HostGraph declareHostGraph(const fg::vk::DeviceContext& device, Denoiser& method, fg::Extent extent,
                           const HostView& view, const HostTargets& targets, const LightPattern& light = {},
                           const std::function<void(fg::Graph&, fg::Texture display)>& present = {},
                           const gpu_render::GpuScene* scene = nullptr, bool specular = false);

/// Names of the textures that can be viewed.
std::vector<std::string> viewableTextures(const fg::GraphDesc& graph);

}  // namespace walr::host
