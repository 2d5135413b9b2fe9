#include "framegraph/vulkan/descriptors.h"

#include <algorithm>

#include "framegraph/declare/access.h"

namespace fg::vk {
namespace {

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

}  // namespace

Descriptors::Descriptors(const DeviceContext& device, const GraphDesc& graph, const Plan& plan,
                         const Resources& resources, Views& views, const std::vector<VkDescriptorSetLayout>& setLayouts,
                         std::uint32_t slots, bool historiesChange)
    : device_(&device),
      resources_(&resources),
      views_(&views),
      passCount_(plan.passes.size()),
      nearest_(makeSampler(device, VK_FILTER_NEAREST)),
      linear_(makeSampler(device, VK_FILTER_LINEAR)),
      sets_(plan.passes.size() * slots * kParities),
      writtenEpoch_(static_cast<std::size_t>(slots) * kParities) {
  for (std::size_t i = 0; i < passCount_; ++i) {
    if (setLayouts[i] != VK_NULL_HANDLE)
      collectWrites(graph, i, graph.passes[plan.passes[i].pass], views, historiesChange);
  }
  const std::size_t most = std::max(lasting_.size(), changing_.size());
  vulkanWrites_.reserve(most);
  imageInfos_.reserve(most);
  bufferInfos_.reserve(most);
  makePool(setLayouts, slots);
  for (std::uint32_t slot = 0; slot < slots; ++slot) {
    for (std::uint32_t parity = 0; parity < kParities; ++parity) write(lasting_, {slot, parity});
  }
}

void Descriptors::collectWrites(const GraphDesc& graph, std::size_t plannedPass, const PassDecl& pass, Views& views,
                                bool historiesChange) {
  const Shader& shader = *std::get<ComputeDispatch>(pass.work).shader;
  for (const ShaderBinding& binding : shader.bindings) {
    const auto access = std::ranges::find(pass.accesses, binding.name, &AccessDecl::binding);
    if (access == pass.accesses.end()) {
      throw Error("pass '" + pass.name + "' binds nothing to '" + std::string(binding.name) + "' of shader '" +
                  std::string(shader.name) + "'");
    }
    const ResourceDecl& resource = graph.resources[access->resource];
    Write write{.pass = plannedPass, .binding = binding.binding, .type = binding.type, .resource = access->resource};
    if (const auto* buffer = std::get_if<BufferDesc>(&resource.desc)) {
      write.size = buffer->size;
    } else {
      write.view = views.request(access->resource, access->range);
      write.layout = accessInfo(access->access).layout;
      write.sampler = (access->filter == VK_FILTER_LINEAR ? linear_ : nearest_).get();
    }
    const bool changes =
        resource.lifetime == Lifetime::Imported || (historiesChange && resource.lifetime == Lifetime::HistoryPrevious);
    (changes ? changing_ : lasting_).push_back(write);
  }
}

void Descriptors::makePool(const std::vector<VkDescriptorSetLayout>& setLayouts, std::uint32_t slots) {
  const std::uint32_t copies = slots * kParities;
  std::vector<VkDescriptorPoolSize> sizes;
  for (const auto* writes : {&lasting_, &changing_}) {
    for (const Write& write : *writes) sizes.push_back({write.type, copies});
  }
  const auto setCount = static_cast<std::uint32_t>(
      copies * (setLayouts.size() - static_cast<std::size_t>(std::ranges::count(setLayouts, VkDescriptorSetLayout{}))));
  if (sizes.empty()) return;  // No shader binds anything.
  VkDescriptorPoolCreateInfo poolInfo{};
  poolInfo.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  poolInfo.maxSets = setCount;
  poolInfo.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
  poolInfo.pPoolSizes = sizes.data();
  pool_ = create<VkDescriptorPool>(*device_, device_->functions.vkCreateDescriptorPool, poolInfo,
                                   "creating the descriptor pool");
  for (std::size_t i = 0; i < sets_.size(); ++i) {
    const VkDescriptorSetLayout layout = setLayouts[i % passCount_];
    if (layout == VK_NULL_HANDLE) continue;
    VkDescriptorSetAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    info.descriptorPool = pool_.get();
    info.descriptorSetCount = 1;
    info.pSetLayouts = &layout;
    check(device_->functions.vkAllocateDescriptorSets(device_->view.device, &info, &sets_[i]),
          "allocating descriptor sets");
  }
}

void Descriptors::update(FrameIndex frame) {
  std::uint64_t& written = writtenEpoch_[index(frame)];
  if (written == epoch_) return;
  write(changing_, frame);
  written = epoch_;
}

void Descriptors::write(const std::vector<Write>& writes, FrameIndex frame) {
  if (writes.empty()) return;
  vulkanWrites_.clear();
  imageInfos_.clear();
  bufferInfos_.clear();
  for (const Write& write : writes) {
    VkWriteDescriptorSet& target = vulkanWrites_.emplace_back();
    target.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    target.dstSet = set(write.pass, frame);
    target.dstBinding = write.binding;
    target.descriptorCount = 1;
    target.descriptorType = write.type;
    if (write.view == kNone) {
      bufferInfos_.push_back({resources_->buffer(write.resource, frame), 0, write.size});
      target.pBufferInfo = &bufferInfos_.back();
    } else {
      imageInfos_.push_back({write.sampler, views_->get(write.view, frame), write.layout});
      target.pImageInfo = &imageInfos_.back();
    }
  }
  device_->functions.vkUpdateDescriptorSets(device_->view.device, static_cast<std::uint32_t>(vulkanWrites_.size()),
                                            vulkanWrites_.data(), 0, nullptr);
}

}  // namespace fg::vk
