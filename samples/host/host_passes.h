#pragma once

#include <string>
#include <vector>

#include "framegraph/declare/graph.h"
#include "framegraph/vulkan/device_context.h"

/// The host's own passes: what an engine has in its frame around a denoiser.
namespace walr::host {

/// A picture that comes from the processor every frame.
struct UploadedPicture {
  fg::Buffer bytes;  ///< Upload; rows of texels without padding.
  fg::Texture texture;
};

/// Declare a picture that `addUploads` will fill.
UploadedPicture declarePicture(fg::Graph& graph, const std::string& name, VkFormat format, fg::Extent extent);

/// One pass that copies pictures into their textures, whose handles it moves on.
/// @param device  must outlive the graph
void addUploads(fg::Graph& graph, const fg::vk::DeviceContext& device, const std::vector<UploadedPicture*>& pictures);

/// What a composite is made of beside the indirect light. RGBA16F.
struct Shading {
  fg::Texture direct;
  fg::Texture albedo;
  fg::Texture emission;
};

/// The lit picture albedo * (direct + indirect) + emission, into `output` (RGBA16F).
fg::Texture addComposite(fg::Graph& graph, const std::string& name, fg::Texture indirect, const Shading& shading,
                         fg::Texture output);

/// The lit picture for the screen: tone map and sRGB, into `display` (RGBA8).
fg::Texture addToneMap(fg::Graph& graph, fg::Texture lit, fg::Texture display);

/// Three lit pictures beside one another, column by column; see `ViewConstants`.
fg::Texture addSplitToneMap(fg::Graph& graph, fg::Texture left, fg::Texture middle, fg::Texture right,
                            fg::Buffer viewConstants, fg::Texture display);

/// Show any texture of the graph with one layer. Textures of floats are scaled by `ViewConstants::gain` and `bias`,
/// those of integers show the bytes of their first word.
fg::Texture addInspection(fg::Graph& graph, fg::Texture inspected, fg::Buffer viewConstants, fg::Texture display);

}  // namespace walr::host
