#pragma once

#include <string>

#include "framegraph/declare/graph.h"
#include "framegraph/vulkan/owned.h"

/// Creates Vulkan images, views and buffers from the graph's descriptions.
namespace fg::vk {

VkImageCreateInfo imageCreateInfo(const TextureDesc& desc, VkImageUsageFlags usage);
VkBufferCreateInfo bufferCreateInfo(const BufferDesc& desc, VkBufferUsageFlags usage);

/// The aspects of a format: colour, or depth and stencil.
VkImageAspectFlags aspects(VkFormat format);
VkImageSubresourceRange subresourceRange(VkFormat format, const SubresourceRange& range);

/// Format features that optimally tiled images of these usages need.
VkFormatFeatureFlags requiredFeatures(VkImageUsageFlags usage);

Owned<VkImage> createImage(const DeviceContext& device, const TextureDesc& desc, VkImageUsageFlags usage,
                           const std::string& name);
/// A 2D view, or a 2D array view if the texture has several layers. The view of a depth-stencil format shows the depth.
Owned<VkImageView> createImageView(const DeviceContext& device, VkImage image, const TextureDesc& desc,
                                   const SubresourceRange& range, const std::string& name);
Owned<VkBuffer> createBuffer(const DeviceContext& device, const BufferDesc& desc, VkBufferUsageFlags usage,
                             const std::string& name);

}  // namespace fg::vk
