#pragma once

#include <string>

#include "framegraph/declare/graph.h"
#include "framegraph/vulkan/owned.h"

/// How the graph's descriptions become Vulkan images, views and buffers.
namespace fg::vk {

VkImageCreateInfo imageCreateInfo(const TextureDesc& desc, VkImageUsageFlags usage);
VkBufferCreateInfo bufferCreateInfo(const BufferDesc& desc, VkBufferUsageFlags usage);

/// Colour, or depth and stencil, as the format has them.
VkImageAspectFlags aspects(VkFormat format);
VkImageSubresourceRange subresourceRange(VkFormat format, const SubresourceRange& range);

/// Features that the optimally tiled image needs for a use.
VkFormatFeatureFlags requiredFeatures(VkImageUsageFlags usage);

Owned<VkImage> createImage(const DeviceContext& device, const TextureDesc& desc, VkImageUsageFlags usage,
                           const std::string& name);
/// A 2D view, or a 2D array view where the texture has several layers. Of a depth-stencil format the depth is viewed.
Owned<VkImageView> createImageView(const DeviceContext& device, VkImage image, const TextureDesc& desc,
                                   const SubresourceRange& range, const std::string& name);
Owned<VkBuffer> createBuffer(const DeviceContext& device, const BufferDesc& desc, VkBufferUsageFlags usage,
                             const std::string& name);

}  // namespace fg::vk
