#include "framegraph/vulkan/descriptors.h"

#include <algorithm>

#include "framegraph/declare/access.h"

namespace fg::vk {
Descriptors::Descriptors(const DeviceContext& device, const GraphDesc& graph, const Plan& plan,
                         const Resources& resources, Views& views, const std::vector<VkDescriptorSetLayout>& setLayouts,
                         std::uint32_t slots, bool historiesChange)
    : device_(&device),
      resources_(&resources),
      views_(&views),
      nearest_(makeSampler(device, VK_FILTER_NEAREST)),
      linear_(makeSampler(device, VK_FILTER_LINEAR)),
      writtenEpoch_(static_cast<std::size_t>(slots) * kParities) {
  for (std::size_t i = 0; i < setLayouts.size(); ++i) {
    if (setLayouts[i] != VK_NULL_HANDLE)
      collectWrites(graph, i, graph.passes[plan.passes[i].pass], views, historiesChange);
  }
  const std::size_t most = std::max(lasting_.size(), changing_.size());
  vulkanWrites_.reserve(most);
  imageInfos_.reserve(most);
  bufferInfos_.reserve(most);
  std::vector<VkDescriptorType> types;
  for (const auto* writes : {&lasting_, &changing_}) {
    for (const Write& write : *writes) types.push_back(write.type);
  }
  sets_.emplace(device, setLayouts, types, slots * kParities);
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
