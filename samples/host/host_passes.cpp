#include "samples/host/host_passes.h"

#include <algorithm>
#include <array>
#include <initializer_list>

#include <glm/vec2.hpp>

#include "framegraph/declare/format.h"
#include "samples/host/shaders.h"

namespace walr::host {
namespace {

bool holdsIntegers(VkFormat format) {
  constexpr std::array kIntegers = {
      VK_FORMAT_R8_UINT,           VK_FORMAT_R8G8B8A8_UINT, VK_FORMAT_R16_UINT,    VK_FORMAT_R16G16_UINT,
      VK_FORMAT_R16G16B16A16_UINT, VK_FORMAT_R32_UINT,      VK_FORMAT_R32G32_UINT, VK_FORMAT_R32G32B32A32_UINT,
  };
  return std::ranges::find(kIntegers, format) != kIntegers.end();
}

struct LitImage {
  const char* binding;
  fg::Texture texture;
};

fg::Texture toneMap(fg::Graph& graph, const fg::Shader& shader, std::initializer_list<LitImage> lit,
                    fg::Buffer viewConstants, fg::Texture display) {
  fg::PassBuilder pass = graph.compute("tone map", shader);
  for (const LitImage& image : lit) pass.sample(image.binding, image.texture);
  pass.uniform("View", viewConstants).dispatch(graph.textureDesc(lit.begin()->texture).extent);
  return pass.store("outDisplay", display);
}

}  // namespace

UploadedPicture declarePicture(fg::Graph& graph, const std::string& name, VkFormat format, fg::Extent extent) {
  const std::uint64_t size = std::uint64_t{fg::bytesPerTexel(format)} * extent.width * extent.height;
  return {graph.upload(name + " bytes", size), graph.texture(name, {.format = format, .extent = extent})};
}

void addUploads(fg::Graph& graph, const fg::vk::DeviceContext& device, const std::vector<UploadedPicture*>& pictures) {
  struct Copy {
    fg::Buffer bytes;
    fg::Texture texture;
    fg::Extent extent;
  };
  std::vector<Copy> copies;
  for (const UploadedPicture* picture : pictures) {
    copies.push_back({picture->bytes, picture->texture, graph.textureDesc(picture->texture).extent});
  }
  fg::PassBuilder pass = graph.callback("upload G-buffer", [copies, &device](const fg::RecordContext& context) {
    for (const Copy& copy : copies) {
      VkBufferImageCopy region{};
      region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
      region.imageExtent = {copy.extent.width, copy.extent.height, 1};
      device.functions.vkCmdCopyBufferToImage(context.commandBuffer, context.buffer(copy.bytes),
                                              context.image(copy.texture), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1,
                                              &region);
    }
  });
  for (UploadedPicture* picture : pictures) {
    pass.access(picture->bytes, fg::Access::TransferRead);
    picture->texture = pass.access(picture->texture, fg::Access::TransferWrite);
  }
}

fg::Buffer addRayCount(fg::Graph& graph, fg::Texture lighting, fg::Buffer rays) {
  fg::PassBuilder pass = graph.compute("count rays", shaders::countRays);
  pass.sample("lighting", lighting).dispatch({1, graph.textureDesc(lighting).extent.height});
  return pass.store("Rays", rays);
}

SpecularInputs addSpecularInputs(fg::Graph& graph, fg::Texture traced, fg::Texture specularAlbedo, fg::Texture normal) {
  const fg::TextureDesc desc = graph.textureDesc(traced);
  const fg::Texture lighting = graph.texture("specular light", desc);
  const fg::Texture roughness = graph.texture("roughness", {.format = VK_FORMAT_R8_UNORM, .extent = desc.extent});
  fg::PassBuilder pass = graph.compute("specular inputs", shaders::specularInputs);
  pass.sample("traced", traced).sample("specularAlbedo", specularAlbedo).sample("normal", normal).dispatch(desc.extent);
  return {pass.store("outSpecular", lighting), pass.store("outRoughness", roughness)};
}

fg::Texture addComposite(fg::Graph& graph, const std::string& name, fg::Texture indirect, const Shading& shading,
                         fg::Texture output) {
  fg::PassBuilder pass = graph.compute(name, shading.specular ? shaders::compositeSpecular : shaders::composite);
  pass.sample("indirect", indirect)
      .sample("direct", shading.direct)
      .sample("albedo", shading.albedo)
      .sample("emission", shading.emission)
      .dispatch(graph.textureDesc(indirect).extent);
  if (shading.specular) {
    pass.sample("specular", *shading.specular).sample("specularAlbedo", *shading.specularAlbedo);
  }
  return pass.store("outLit", output);
}

fg::Texture addToneMap(fg::Graph& graph, fg::Texture lit, fg::Buffer viewConstants, fg::Texture display) {
  return toneMap(graph, shaders::toneMap, {{"lit", lit}}, viewConstants, display);
}

fg::Texture addSplitToneMap(fg::Graph& graph, fg::Texture left, fg::Texture middle, fg::Texture right,
                            fg::Buffer viewConstants, fg::Texture display) {
  return toneMap(graph, shaders::toneMapSplit, {{"left", left}, {"lit", middle}, {"right", right}}, viewConstants,
                 display);
}

fg::Texture addComparison(fg::Graph& graph, fg::Texture left, fg::Texture right, fg::Buffer viewConstants,
                          fg::Texture display) {
  return toneMap(graph, shaders::toneMapCompare, {{"lit", left}, {"right", right}}, viewConstants, display);
}

fg::Texture addInspection(fg::Graph& graph, fg::Texture inspected, fg::Extent shown, fg::Buffer viewConstants,
                          fg::Texture display) {
  const bool integers = holdsIntegers(graph.textureDesc(inspected).format);
  fg::PassBuilder pass = graph.compute("inspect", integers ? shaders::inspectUint : shaders::inspect);
  pass.sample("inspected", inspected).constants(glm::ivec2(shown.width, shown.height)).dispatch(shown);
  if (!integers) {
    pass.uniform("View", viewConstants);
  }
  return pass.store("outDisplay", display);
}

}  // namespace walr::host
