#include "framegraph/vulkan/image.h"

namespace fg::vk {
namespace {

/// @param what kind of object, for the error message
template <typename Handle, typename Info, typename Function>
Owned<Handle> createNamed(const DeviceContext& device, VkObjectType type, Function function, const Info& info,
                          const std::string& what, const std::string& name) {
  auto made = create<Handle>(device, function, info, "creating " + what + " '" + name + "'");
  device.setName(type, made.get(), name);
  return made;
}

}  // namespace

VkImageCreateInfo imageCreateInfo(const TextureDesc& desc, VkImageUsageFlags usage) {
  VkImageCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = desc.format;
  info.extent = {desc.extent.width, desc.extent.height, 1};
  info.mipLevels = desc.mipLevels;
  info.arrayLayers = desc.arrayLayers;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = usage;
  info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
  info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  return info;
}

VkBufferCreateInfo bufferCreateInfo(const BufferDesc& desc, VkBufferUsageFlags usage) {
  VkBufferCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.size = desc.size;
  info.usage = usage;
  info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
  return info;
}

VkImageAspectFlags aspects(VkFormat format) {
  switch (format) {
    case VK_FORMAT_D16_UNORM:
    case VK_FORMAT_X8_D24_UNORM_PACK32:
    case VK_FORMAT_D32_SFLOAT:
      return VK_IMAGE_ASPECT_DEPTH_BIT;
    case VK_FORMAT_S8_UINT:
      return VK_IMAGE_ASPECT_STENCIL_BIT;
    case VK_FORMAT_D16_UNORM_S8_UINT:
    case VK_FORMAT_D24_UNORM_S8_UINT:
    case VK_FORMAT_D32_SFLOAT_S8_UINT:
      return VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT;
    default:
      return VK_IMAGE_ASPECT_COLOR_BIT;
  }
}

VkImageSubresourceRange subresourceRange(VkFormat format, const SubresourceRange& range) {
  return {aspects(format), range.baseMip, range.mipCount, range.baseLayer, range.layerCount};
}

VkFormatFeatureFlags requiredFeatures(VkImageUsageFlags usage) {
  struct Need {
    VkImageUsageFlags usage;
    VkFormatFeatureFlags feature;
  };
  static constexpr Need kNeeds[] = {
      {VK_IMAGE_USAGE_SAMPLED_BIT, VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT},
      {VK_IMAGE_USAGE_STORAGE_BIT, VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT},
      {VK_IMAGE_USAGE_TRANSFER_SRC_BIT, VK_FORMAT_FEATURE_TRANSFER_SRC_BIT},
      {VK_IMAGE_USAGE_TRANSFER_DST_BIT, VK_FORMAT_FEATURE_TRANSFER_DST_BIT},
      {VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT},
      {VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT},
  };
  VkFormatFeatureFlags features = 0;
  for (const Need& need : kNeeds) {
    if ((usage & need.usage) != 0) features |= need.feature;
  }
  return features;
}

Owned<VkImage> createImage(const DeviceContext& device, const TextureDesc& desc, VkImageUsageFlags usage,
                           const std::string& name) {
  return createNamed<VkImage>(device, VK_OBJECT_TYPE_IMAGE, device.functions.vkCreateImage,
                              imageCreateInfo(desc, usage), "image", name);
}

Owned<VkImageView> createImageView(const DeviceContext& device, VkImage image, const TextureDesc& desc,
                                   const SubresourceRange& range, const std::string& name) {
  VkImageViewCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
  info.image = image;
  info.viewType = desc.arrayLayers > 1 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
  info.format = desc.format;
  info.subresourceRange = subresourceRange(desc.format, range);
  if ((info.subresourceRange.aspectMask & VK_IMAGE_ASPECT_DEPTH_BIT) != 0) {
    info.subresourceRange.aspectMask = VK_IMAGE_ASPECT_DEPTH_BIT;
  }
  return createNamed<VkImageView>(device, VK_OBJECT_TYPE_IMAGE_VIEW, device.functions.vkCreateImageView, info,
                                  "a view of image", name);
}

Owned<VkBuffer> createBuffer(const DeviceContext& device, const BufferDesc& desc, VkBufferUsageFlags usage,
                             const std::string& name) {
  return createNamed<VkBuffer>(device, VK_OBJECT_TYPE_BUFFER, device.functions.vkCreateBuffer,
                               bufferCreateInfo(desc, usage), "buffer", name);
}

}  // namespace fg::vk
