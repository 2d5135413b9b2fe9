#include "samples/gpu_render/trace_pipeline.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace walr::gpu_render {
namespace {

using fg::vk::DeviceContext;
using fg::vk::Owned;

Owned<VkDescriptorSetLayout> makeSetLayout(const DeviceContext& device, const fg::Shader& shader) {
  std::vector<VkDescriptorSetLayoutBinding> bindings;
  for (const fg::ShaderBinding& binding : shader.bindings) {
    bindings.push_back({binding.binding, binding.type, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
  }
  VkDescriptorSetLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  info.flags = VK_DESCRIPTOR_SET_LAYOUT_CREATE_PUSH_DESCRIPTOR_BIT_KHR;
  info.bindingCount = static_cast<std::uint32_t>(bindings.size());
  info.pBindings = bindings.data();
  return fg::vk::create<VkDescriptorSetLayout>(device, device.functions.vkCreateDescriptorSetLayout, info,
                                               "creating a descriptor set layout for the path tracer");
}

Owned<VkPipelineLayout> makeLayout(const DeviceContext& device, VkDescriptorSetLayout set) {
  VkPipelineLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  info.setLayoutCount = 1;
  info.pSetLayouts = &set;
  return fg::vk::create<VkPipelineLayout>(device, device.functions.vkCreatePipelineLayout, info,
                                          "creating a pipeline layout for the path tracer");
}

Owned<VkPipeline> makePipeline(const DeviceContext& device, const fg::Shader& shader, VkPipelineLayout layout) {
  VkShaderModuleCreateInfo moduleInfo{};
  moduleInfo.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  moduleInfo.codeSize = shader.code.size_bytes();
  moduleInfo.pCode = shader.code.data();
  const auto module = fg::vk::create<VkShaderModule>(device, device.functions.vkCreateShaderModule, moduleInfo,
                                                     "creating the path tracer's shader");
  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = module.get();
  info.stage.pName = "main";
  info.layout = layout;
  VkPipeline pipeline = VK_NULL_HANDLE;
  fg::vk::check(device.functions.vkCreateComputePipelines(device.view.device, VK_NULL_HANDLE, 1, &info,
                                                          device.view.allocator, &pipeline),
                "creating the path tracer's pipeline");
  return {device, pipeline};
}

}  // namespace

TracePipeline::TracePipeline(const DeviceContext& device, const RayFunctions& functions, const fg::Shader& shader)
    : device_(&device),
      functions_(&functions),
      shader_(&shader),
      set_(makeSetLayout(device, shader)),
      layout_(makeLayout(device, set_.get())),
      pipeline_(makePipeline(device, shader, layout_.get())) {}

TracePipeline::Bindings::Descriptor& TracePipeline::Bindings::add(std::string_view binding) {
  const auto found = std::ranges::find(pipeline_->shader_->bindings, binding, &fg::ShaderBinding::name);
  if (found == pipeline_->shader_->bindings.end()) {
    throw std::logic_error("the path tracer's shader has no binding '" + std::string(binding) + "'");
  }
  Descriptor& descriptor = descriptors_.emplace_back();
  descriptor.binding = &*found;
  return descriptor;
}

TracePipeline::Bindings& TracePipeline::Bindings::buffer(std::string_view binding, VkBuffer buffer) {
  add(binding).buffer = {buffer, 0, VK_WHOLE_SIZE};
  return *this;
}

TracePipeline::Bindings& TracePipeline::Bindings::image(std::string_view binding, VkImageView view) {
  add(binding).image = {VK_NULL_HANDLE, view, VK_IMAGE_LAYOUT_GENERAL};
  return *this;
}

TracePipeline::Bindings& TracePipeline::Bindings::structure(std::string_view binding,
                                                            VkAccelerationStructureKHR structure) {
  add(binding).structure = structure;
  return *this;
}

void TracePipeline::dispatch(VkCommandBuffer commandBuffer, const Bindings& bindings, std::uint32_t width,
                             std::uint32_t height) const {
  if (bindings.descriptors_.size() != shader_->bindings.size()) {
    throw std::logic_error("the path tracer's shader has bindings without a descriptor");
  }
  std::vector<VkWriteDescriptorSet> writes;
  std::vector<VkWriteDescriptorSetAccelerationStructureKHR> structures(bindings.descriptors_.size());
  for (std::size_t i = 0; i < bindings.descriptors_.size(); ++i) {
    const Bindings::Descriptor& descriptor = bindings.descriptors_[i];
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstBinding = descriptor.binding->binding;
    write.descriptorCount = 1;
    write.descriptorType = descriptor.binding->type;
    write.pBufferInfo = &descriptor.buffer;
    write.pImageInfo = &descriptor.image;
    if (descriptor.structure != VK_NULL_HANDLE) {
      structures[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET_ACCELERATION_STRUCTURE_KHR;
      structures[i].accelerationStructureCount = 1;
      structures[i].pAccelerationStructures = &descriptor.structure;
      write.pNext = &structures[i];
    }
    writes.push_back(write);
  }
  const auto groups = [](std::uint32_t threads, std::uint32_t side) { return (threads + side - 1) / side; };
  device_->functions.vkCmdBindPipeline(commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.get());
  functions_->vkCmdPushDescriptorSetKHR(commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, layout_.get(), 0,
                                        static_cast<std::uint32_t>(writes.size()), writes.data());
  device_->functions.vkCmdDispatch(commandBuffer, groups(width, shader_->localSize[0]),
                                   groups(height, shader_->localSize[1]), 1);
}

}  // namespace walr::gpu_render
