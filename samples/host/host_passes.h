#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framegraph/declare/graph.h"
#include "framegraph/vulkan/device_context.h"

/// The host's own passes: those that an engine runs before and after a denoiser.
namespace walr::host {

/// An image that the CPU uploads every frame.
struct UploadedPicture {
  fg::Buffer bytes;  ///< Upload buffer: rows of texels without padding.
  fg::Texture texture;
};

/// Declare an image that `addUploads` fills.
UploadedPicture declarePicture(fg::Graph& graph, const std::string& name, VkFormat format, fg::Extent extent);

/// Add one pass that copies images into their textures. It replaces their texture handles by the written versions.
/// @param device  must outlive the graph
void addUploads(fg::Graph& graph, const fg::vk::DeviceContext& device, const std::vector<UploadedPicture*>& pictures);

/// Write the number of rays in each row of a traced image, which its alpha holds
/// (`gpu_render::TracedTextures::indirect`), to `rays`, a uint for each row. In half floats, the number of a pixel is
/// exact up to 2048.
fg::Buffer addRayCount(fg::Graph& graph, fg::Texture lighting, fg::Buffer rays);

/// Specular light that was traced on the device (`gpu_render::TracedTextures`), as denoisers take it.
struct SpecularInputs {
  fg::Texture lighting;   ///< RGBA16F; alpha: distance of what is reflected, 0 without a sample.
  fg::Texture roughness;  ///< R8_UNORM.
};
SpecularInputs addSpecularInputs(fg::Graph& graph, fg::Texture traced, fg::Texture specularAlbedo, fg::Texture normal);

/// The inputs of a composite other than the indirect light; all RGBA16F.
struct Shading {
  fg::Texture direct;
  fg::Texture albedo;
  fg::Texture emission;
  std::optional<fg::Texture> specular = {};        ///< Light of the specular lobe, divided by `specularAlbedo`.
  std::optional<fg::Texture> specularAlbedo = {};  ///< Absent without `specular`.
};

/// Write the lit image, albedo * (direct + indirect) + emission + specular albedo * specular, to `output` (RGBA16F).
fg::Texture addComposite(fg::Graph& graph, const std::string& name, fg::Texture indirect, const Shading& shading,
                         fg::Texture output);

/// Apply exposure (`ViewConstants::stops`), tone map and sRGB to the lit image; write the result to `display` (RGBA8).
fg::Texture addToneMap(fg::Graph& graph, fg::Texture lit, fg::Buffer viewConstants, fg::Texture display);

/// The same for three lit images, each of which fills a range of columns; see `ViewConstants`.
fg::Texture addSplitToneMap(fg::Graph& graph, fg::Texture left, fg::Texture middle, fg::Texture right,
                            fg::Buffer viewConstants, fg::Texture display);

/// The same for two lit images; see `ViewConstants::middleEdge`.
fg::Texture addComparison(fg::Graph& graph, fg::Texture left, fg::Texture right, fg::Buffer viewConstants,
                          fg::Texture display);

/// Show a texture of the graph that has one layer in the first columns and rows of the displayed image. Float textures
/// are scaled by `ViewConstants::gain` and `bias`. Of integer textures the bytes of the first component are shown.
fg::Texture addInspection(fg::Graph& graph, fg::Texture inspected, fg::Extent shown, fg::Buffer viewConstants,
                          fg::Texture display);

}  // namespace walr::host
