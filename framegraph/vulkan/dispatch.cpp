#include "framegraph/vulkan/dispatch.h"

namespace fg::vk {

void recordDispatch(const DeviceContext& device, VkCommandBuffer commandBuffer, const ComputePipeline& pipeline,
                    VkDescriptorSet set, const DispatchCommand& command) {
  const DeviceFunctions& functions = device.functions;
  functions.vkCmdBindPipeline(commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.pipeline);
  if (set != VK_NULL_HANDLE) {
    functions.vkCmdBindDescriptorSets(commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout, 0, 1, &set, 0,
                                      nullptr);
  }
  if (!command.constants.empty()) {
    functions.vkCmdPushConstants(commandBuffer, pipeline.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                 static_cast<std::uint32_t>(command.constants.size()), command.constants.data());
  }
  if (command.indirect != VK_NULL_HANDLE) {
    functions.vkCmdDispatchIndirect(commandBuffer, command.indirect, command.indirectOffset);
  } else {
    functions.vkCmdDispatch(commandBuffer, command.groups[0], command.groups[1], command.groups[2]);
  }
}

}  // namespace fg::vk
