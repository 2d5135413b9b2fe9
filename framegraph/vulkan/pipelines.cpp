#include "framegraph/vulkan/pipelines.h"

namespace fg::vk {
namespace {

void requireLimits(const DeviceContext& device, const Shader& shader) {
  const VkPhysicalDeviceLimits& limits = device.properties.limits;
  const auto& local = shader.localSize;
  bool fits = shader.pushConstantSize <= limits.maxPushConstantsSize &&
              local[0] * local[1] * local[2] <= limits.maxComputeWorkGroupInvocations;
  for (int axis = 0; axis < 3; ++axis) fits = fits && local[axis] <= limits.maxComputeWorkGroupSize[axis];
  if (fits) return;
  throw Unsupported("shader '" + std::string(shader.name) + "' has work groups of " + std::to_string(local[0]) + " x " +
                        std::to_string(local[1]) + " x " + std::to_string(local[2]) + " threads and " +
                        std::to_string(shader.pushConstantSize) + " bytes of push constants; the device takes " +
                        std::to_string(limits.maxComputeWorkGroupInvocations) + " threads and " +
                        std::to_string(limits.maxPushConstantsSize) + " bytes: choose another device",
                    VK_ERROR_FEATURE_NOT_PRESENT);
}

}  // namespace

const Pipelines::Layouts& Pipelines::layouts(const Shader& shader) {
  const auto known = layouts_.find(&shader);
  if (known != layouts_.end()) return known->second;
  requireLimits(*device_, shader);
  const std::string name(shader.name);

  std::vector<VkDescriptorSetLayoutBinding> bindings;
  for (const ShaderBinding& binding : shader.bindings) {
    bindings.push_back({binding.binding, binding.type, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
  }
  VkDescriptorSetLayoutCreateInfo setInfo{};
  setInfo.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
  setInfo.bindingCount = static_cast<std::uint32_t>(bindings.size());
  setInfo.pBindings = bindings.data();
  Layouts made;
  made.set = create<VkDescriptorSetLayout>(*device_, device_->functions.vkCreateDescriptorSetLayout, setInfo,
                                           "creating the descriptor set layout of shader '" + name + "'");

  const VkDescriptorSetLayout set = made.set.get();
  const VkPushConstantRange constants = {VK_SHADER_STAGE_COMPUTE_BIT, 0, shader.pushConstantSize};
  VkPipelineLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  info.setLayoutCount = 1;
  info.pSetLayouts = &set;
  info.pushConstantRangeCount = shader.pushConstantSize != 0 ? 1 : 0;
  info.pPushConstantRanges = &constants;
  made.pipeline = create<VkPipelineLayout>(*device_, device_->functions.vkCreatePipelineLayout, info,
                                           "creating the pipeline layout of shader '" + name + "'");
  return layouts_.emplace(&shader, std::move(made)).first->second;
}

Owned<VkPipeline> Pipelines::makePipeline(const Shader& shader, std::span<const std::uint32_t> code,
                                          const std::vector<std::uint32_t>& specialization, VkPipelineLayout layout) {
  const std::string name(shader.name);
  VkShaderModuleCreateInfo moduleInfo{};
  moduleInfo.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  moduleInfo.codeSize = code.size_bytes();
  moduleInfo.pCode = code.data();
  const auto module = create<VkShaderModule>(*device_, device_->functions.vkCreateShaderModule, moduleInfo,
                                             "loading shader '" + name + "'");

  std::vector<VkSpecializationMapEntry> entries;
  for (std::size_t i = 0; i < specialization.size() && i < shader.constants.size(); ++i) {
    const auto offset = static_cast<std::uint32_t>(i * sizeof(std::uint32_t));
    entries.push_back({shader.constants[i].id, offset, sizeof(std::uint32_t)});
  }
  const VkSpecializationInfo specializationInfo = {static_cast<std::uint32_t>(entries.size()), entries.data(),
                                                   specialization.size() * sizeof(std::uint32_t),
                                                   specialization.data()};
  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = module.get();
  info.stage.pName = "main";
  info.stage.pSpecializationInfo = &specializationInfo;
  info.layout = layout;
  VkPipeline handle = VK_NULL_HANDLE;
  const VkResult result = device_->functions.vkCreateComputePipelines(device_->view.device, cache_, 1, &info,
                                                                      device_->view.allocator, &handle);
  const std::string action = "creating the pipeline of shader '" + name + "'";
  if (result == VK_ERROR_OUT_OF_HOST_MEMORY || result == VK_ERROR_OUT_OF_DEVICE_MEMORY) check(result, action);
  if (result != VK_SUCCESS) throw PipelineFailed(action + ": " + resultName(result) + "; update the driver", result);
  device_->setName(VK_OBJECT_TYPE_PIPELINE, handle, name);
  return Owned<VkPipeline>(*device_, handle);
}

ComputePipeline Pipelines::get(const Shader& declared, const std::vector<std::uint32_t>& specialization) {
  const bool halves = device_->view.shaderFloat16 && declared.inHalves != nullptr;
  const Shader& shader = halves ? *declared.inHalves : declared;
  const Layouts& used = layouts(shader);
  auto entry = pipelines_.find({&shader, specialization});
  if (entry == pipelines_.end()) {
    const auto replaced = replacedCode_.find(&shader);
    const std::span<const std::uint32_t> code = replaced != replacedCode_.end() ? replaced->second : shader.code;
    auto pipeline = makePipeline(shader, code, specialization, used.pipeline.get());
    entry = pipelines_.emplace(std::pair(&shader, specialization), std::move(pipeline)).first;
  }
  return {entry->second.get(), used.pipeline.get(), used.set.get()};
}

void Pipelines::replaceCode(const Shader& shader, std::vector<std::uint32_t> code) {
  std::map<std::vector<std::uint32_t>, Owned<VkPipeline>> made;
  for (const auto& [key, old] : pipelines_) {
    const auto& [known, specialization] = key;
    if (known != &shader) continue;
    made.emplace(specialization, makePipeline(shader, code, specialization, layouts(shader).pipeline.get()));
  }
  for (auto& [specialization, pipeline] : made) {
    Owned<VkPipeline>& used = pipelines_.at({&shader, specialization});
    std::swap(used, pipeline);
    oldPipelines_.push_back(std::move(pipeline));
  }
  replacedCode_[&shader] = std::move(code);
}

}  // namespace fg::vk
