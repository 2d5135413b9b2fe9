#include "framegraph/vulkan/descriptor_sets.h"

#include <algorithm>

namespace fg::vk {

Owned<VkSampler> makeSampler(const DeviceContext& device, VkFilter filter) {
  VkSamplerCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
  info.magFilter = filter;
  info.minFilter = filter;
  info.mipmapMode = VK_SAMPLER_MIPMAP_MODE_NEAREST;
  info.addressModeU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  info.addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  info.maxLod = VK_LOD_CLAMP_NONE;
  return create<VkSampler>(device, device.functions.vkCreateSampler, info, "creating a sampler");
}

DescriptorSets::DescriptorSets(const DeviceContext& device, const std::vector<VkDescriptorSetLayout>& layouts,
                               const std::vector<VkDescriptorType>& types, std::uint32_t copies)
    : passCount_(layouts.size()), sets_(layouts.size() * copies) {
  if (types.empty()) return;  // No shader binds anything.
  std::vector<VkDescriptorPoolSize> sizes;
  for (const VkDescriptorType type : types) sizes.push_back({type, copies});
  const auto none = static_cast<std::size_t>(std::ranges::count(layouts, VkDescriptorSetLayout{}));
  VkDescriptorPoolCreateInfo poolInfo{};
  poolInfo.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  poolInfo.maxSets = copies * static_cast<std::uint32_t>(layouts.size() - none);
  poolInfo.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
  poolInfo.pPoolSizes = sizes.data();
  pool_ = create<VkDescriptorPool>(device, device.functions.vkCreateDescriptorPool, poolInfo,
                                   "creating the descriptor pool");
  for (std::size_t i = 0; i < sets_.size(); ++i) {
    const VkDescriptorSetLayout layout = layouts[i % passCount_];
    if (layout == VK_NULL_HANDLE) continue;
    VkDescriptorSetAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    info.descriptorPool = pool_.get();
    info.descriptorSetCount = 1;
    info.pSetLayouts = &layout;
    check(device.functions.vkAllocateDescriptorSets(device.view.device, &info, &sets_[i]),
          "allocating descriptor sets");
  }
}

}  // namespace fg::vk
