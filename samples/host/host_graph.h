#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "framegraph/declare/graph.h"
#include "framegraph/vulkan/device_context.h"
#include "passes/denoiser.h"
#include "samples/host/host_passes.h"

namespace walr::host {

/// What the picture shows.
struct HostView {
  enum class Kind {
    Denoised,   ///< The lit picture with the denoised light.
    Noisy,      ///< The lit picture with the light as it was traced.
    Reference,  ///< The lit picture with the reference's light.
    Split,      ///< Noisy, denoised and reference side by side.
    Texture,    ///< A texture of the graph as it is.
  };
  Kind kind = Kind::Denoised;
  std::string texture = {};  ///< Its name, for `Kind::Texture`.

  /// Whether frames need their reference.
  [[nodiscard]] bool needsReference() const { return kind == Kind::Reference || kind == Kind::Split; }
  friend bool operator==(const HostView&, const HostView&) = default;
};

/// A host's whole frame as one graph: uploads, the method's passes, composite, tone map.
struct HostGraph {
  fg::Graph graph;
  UploadedPicture lighting;
  UploadedPicture depth;
  UploadedPicture normal;
  UploadedPicture motion;
  UploadedPicture albedo;
  UploadedPicture objectId;
  UploadedPicture direct;
  UploadedPicture emission;
  std::optional<UploadedPicture> referenceIndirect;
  std::optional<UploadedPicture> referenceDirect;
  fg::Buffer frameConstants;
  std::optional<fg::Buffer> viewConstants;  ///< Only for views that take them.
  fg::Texture denoised;                     ///< RGBA16F: what the method returned.
  fg::Texture composite;                    ///< RGBA16F: the lit picture with the denoised light.
  fg::Texture display;                      ///< RGBA8: what is shown.
};

/// The textures that the host owns: states in which they come and go. Those that are absent stay inside the graph.
struct HostTargets {
  struct Target {
    fg::ExternalState before;
    fg::ExternalState after;
  };
  std::optional<Target> denoised;
  std::optional<Target> composite;
  std::optional<Target> display;
};

/// Declare the frame.
/// @param device   must outlive the graph
/// @param present  adds what comes after the picture, for instance a pass that brings it to a window; may be empty
/// @throws std::invalid_argument naming a setting of the method that is out of range
/// @throws UsageError naming a texture to view that the graph does not have, and those that it has
HostGraph declareHostGraph(const fg::vk::DeviceContext& device, Denoiser& method, fg::Extent extent,
                           const HostView& view, const HostTargets& targets,
                           const std::function<void(fg::Graph&, fg::Texture display)>& present = {});

/// Names of the textures that can be viewed.
std::vector<std::string> viewableTextures(const fg::GraphDesc& graph);

}  // namespace walr::host
