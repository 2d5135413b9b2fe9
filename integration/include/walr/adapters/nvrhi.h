/* A walr denoiser in the command lists of NVRHI's Vulkan backend. Header-only; C++17. */
#ifndef WALR_ADAPTERS_NVRHI_H
#define WALR_ADAPTERS_NVRHI_H

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <stdexcept>

#include <nvrhi/vulkan.h>
#include <walr/walr.h>

namespace walr::adapters {

/// The textures of a frame. Inputs are shader resources; Outputs are created with `isUAV`: `denoised`, `historyLength`,
/// `lightDirection`, `expectedError`, their counterparts of the second light, and `view`.
struct NvrhiTextures {
  nvrhi::ITexture* lighting = nullptr;
  nvrhi::ITexture* depth = nullptr;
  nvrhi::ITexture* normal = nullptr;
  nvrhi::ITexture* motion = nullptr;
  nvrhi::ITexture* albedo = nullptr;
  nvrhi::ITexture* denoised = nullptr;
  // Optional: see the members of WalrFrame.
  nvrhi::ITexture* objectId = nullptr;
  nvrhi::ITexture* confidence = nullptr;
  nvrhi::ITexture* historyLength = nullptr;
  nvrhi::ITexture* lightDirection = nullptr;
  nvrhi::ITexture* expectedError = nullptr;
  nvrhi::ITexture* view = nullptr;
  nvrhi::ITexture* secondLighting = nullptr;
  nvrhi::ITexture* secondConfidence = nullptr;
  nvrhi::ITexture* secondDenoised = nullptr;
  nvrhi::ITexture* secondHistoryLength = nullptr;
  nvrhi::ITexture* secondLightDirection = nullptr;
  nvrhi::ITexture* secondExpectedError = nullptr;
  nvrhi::ITexture* specularAlbedo = nullptr;
  nvrhi::ITexture* roughness = nullptr;
  nvrhi::ITexture* specularMotion = nullptr;
};

/// Records a denoiser into NVRHI's command lists. NVRHI still tracks the states of the textures.
class NvrhiDenoiser {
 public:
  /// Functions of walr, linked or from a plug-in's table.
  struct Functions {
    decltype(&walr_record) record;
    decltype(&walr_forget_image) forgetImage;
    decltype(&walr_last_error) lastError;
  };

  /// @param denoiser remains owned by the caller; must outlive this object
  NvrhiDenoiser(WalrDenoiser denoiser, const Functions& walr) : denoiser_(denoiser), walr_(walr) {}

  /// Record a frame into an open command list. Its pipeline and bindings are cleared. NVRHI does not keep the textures
  /// alive until the GPU has finished with them: the caller must.
  /// @param frame everything but the images
  /// @throws std::runtime_error with walr's error text
  void record(nvrhi::ICommandList* commands, const NvrhiTextures& textures, WalrFrame frame) const {
    const Member members[] = {{textures.lighting, &frame.lighting, false},
                              {textures.depth, &frame.depth, false},
                              {textures.normal, &frame.normal, false},
                              {textures.motion, &frame.motion, false},
                              {textures.albedo, &frame.albedo, false},
                              {textures.objectId, &frame.object_id, false},
                              {textures.confidence, &frame.confidence, false},
                              {textures.denoised, &frame.denoised, true},
                              {textures.historyLength, &frame.history_length, true},
                              {textures.lightDirection, &frame.light_direction, true},
                              {textures.expectedError, &frame.expected_error, true},
                              {textures.view, &frame.view, true},
                              {textures.secondLighting, &frame.second_lighting, false},
                              {textures.secondConfidence, &frame.second_confidence, false},
                              {textures.secondDenoised, &frame.second_denoised, true},
                              {textures.secondHistoryLength, &frame.second_history_length, true},
                              {textures.secondLightDirection, &frame.second_light_direction, true},
                              {textures.secondExpectedError, &frame.second_expected_error, true},
                              {textures.specularAlbedo, &frame.specular_albedo, false},
                              {textures.roughness, &frame.roughness, false},
                              {textures.specularMotion, &frame.specular_motion, false}};
    WalrImage images[std::size(members)] = {};
    for (std::size_t i = 0; i < std::size(members); ++i) {
      const auto& [texture, image, output] = members[i];
      if (texture == nullptr) continue;  // If it is required, walr reports it.
      commands->setTextureState(
          texture, nvrhi::AllSubresources,
          output ? nvrhi::ResourceStates::UnorderedAccess : nvrhi::ResourceStates::ShaderResource);
      images[i] = describe(texture, output);
      *image = &images[i];
    }
    commands->commitBarriers();
    const VkCommandBuffer buffer = commands->getNativeObject(nvrhi::ObjectTypes::VK_CommandBuffer);
    const WalrResult result = walr_.record(denoiser_, buffer, &frame);
    commands->clearState();
    if (result != WALR_SUCCESS) throw std::runtime_error(walr_.lastError());
  }

  /// Destroy walr's views of a texture. Call it before the texture is destroyed and after the GPU has finished with it.
  /// @throws std::runtime_error with walr's error text
  void forget(nvrhi::ITexture* texture) const {
    const VkImage image = texture->getNativeObject(nvrhi::ObjectTypes::VK_Image);
    if (walr_.forgetImage(denoiser_, image, 0) != WALR_SUCCESS) throw std::runtime_error(walr_.lastError());
  }

 private:
  struct Member {
    nvrhi::ITexture* texture;
    const WalrImage** image;
    bool output;
  };

  /// Acquired and released in the state that NVRHI has put the texture into.
  static WalrImage describe(nvrhi::ITexture* texture, bool output) {
    const nvrhi::TextureDesc& desc = texture->getDesc();
    WalrImage image{};
    image.struct_size = sizeof(image);
    image.queue_family = VK_QUEUE_FAMILY_IGNORED;
    image.image = texture->getNativeObject(nvrhi::ObjectTypes::VK_Image);
    image.format = nvrhi::vulkan::convertFormat(desc.format);
    image.usage = VK_IMAGE_USAGE_SAMPLED_BIT;
    if (desc.isUAV) image.usage |= VK_IMAGE_USAGE_STORAGE_BIT;
    image.width = desc.width;
    image.height = desc.height;
    image.acquire.stage = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
    image.acquire.access = VK_ACCESS_2_SHADER_READ_BIT;
    if (output) image.acquire.access |= VK_ACCESS_2_SHADER_WRITE_BIT;
    image.acquire.layout = output ? VK_IMAGE_LAYOUT_GENERAL : VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    image.release = image.acquire;
    return image;
  }

  WalrDenoiser denoiser_;
  Functions walr_;
};

}  // namespace walr::adapters

#endif
