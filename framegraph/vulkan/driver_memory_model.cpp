#include "framegraph/vulkan/driver_memory_model.h"

#include "framegraph/vulkan/image.h"
#include "framegraph/vulkan/memory.h"

namespace fg::vk {
namespace {

/// Query the requirements through maintenance4. Without it, create the resource, query it and destroy it again.
template <typename Info, typename CreateInfo, typename Query, typename Make>
MemoryRequirements query(const DeviceContext& device, VkStructureType type, const CreateInfo& createInfo,
                         Query function, Make make) {
  if (function == nullptr) return memoryRequirements(device, make().get());
  Info info{};
  info.sType = type;
  info.pCreateInfo = &createInfo;
  VkMemoryRequirements2 result{};
  result.sType = VK_STRUCTURE_TYPE_MEMORY_REQUIREMENTS_2;
  function(device.view.device, &info, &result);
  return {result.memoryRequirements.size, result.memoryRequirements.alignment,
          result.memoryRequirements.memoryTypeBits};
}

}  // namespace

MemoryRequirements DriverMemoryModel::texture(const TextureDesc& desc, VkImageUsageFlags usage) const {
  if (poison_) usage |= kPoisonImageUsage;
  const TextureKey key{desc.format, desc.extent.width, desc.extent.height, desc.mipLevels, desc.arrayLayers, usage};
  const std::lock_guard lock(mutex_);
  auto entry = textures_.find(key);
  if (entry == textures_.end()) {
    const auto answer = query<VkDeviceImageMemoryRequirements>(
        *device_, VK_STRUCTURE_TYPE_DEVICE_IMAGE_MEMORY_REQUIREMENTS, imageCreateInfo(desc, usage),
        device_->functions.vkGetDeviceImageMemoryRequirements,
        [&] { return createImage(*device_, desc, usage, "memory requirements"); });
    entry = textures_.emplace(key, answer).first;
  }
  return entry->second;
}

MemoryRequirements DriverMemoryModel::buffer(const BufferDesc& desc, VkBufferUsageFlags usage) const {
  if (poison_) usage |= kPoisonBufferUsage;
  const std::lock_guard lock(mutex_);
  const BufferKey key{desc.size, usage};
  auto entry = buffers_.find(key);
  if (entry == buffers_.end()) {
    const auto answer = query<VkDeviceBufferMemoryRequirements>(
        *device_, VK_STRUCTURE_TYPE_DEVICE_BUFFER_MEMORY_REQUIREMENTS, bufferCreateInfo(desc, usage),
        device_->functions.vkGetDeviceBufferMemoryRequirements,
        [&] { return createBuffer(*device_, desc, usage, "memory requirements"); });
    entry = buffers_.emplace(key, answer).first;
  }
  return entry->second;
}

bool DriverMemoryModel::supports(VkFormat format, VkImageUsageFlags usage) const {
  VkFormatProperties properties{};
  device_->instance.vkGetPhysicalDeviceFormatProperties(device_->view.physicalDevice, format, &properties);
  const VkFormatFeatureFlags required = requiredFeatures(usage);
  return (properties.optimalTilingFeatures & required) == required;
}

std::uint64_t DriverMemoryModel::bufferImageGranularity() const {
  return device_->properties.limits.bufferImageGranularity;
}

}  // namespace fg::vk
