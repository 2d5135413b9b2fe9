#pragma once

#include <cstdint>

#include "framegraph/vulkan/device_context.h"

/// Tampering with a device's function table: count the calls that make Vulkan objects, make one of them fail, or take
/// the driver and its layers out of the way.
namespace fg::test {

/// What all hooks share. One test at a time.
struct HookState {
  std::uint32_t calls = 0;     ///< Calls of hooked functions since `reset`.
  std::uint32_t failAt = ~0u;  ///< Number of the call that fails, counted from 0.
  VkResult failure = VK_ERROR_OUT_OF_DEVICE_MEMORY;
};
inline HookState hookState;

template <auto kMember>
struct Hook;

template <typename... Args, VkResult (*vk::DeviceFunctions::*kMember)(Args...)>
struct Hook<kMember> {
  static inline VkResult (*real)(Args...) = nullptr;
  static VkResult call(Args... args) {
    return hookState.calls++ == hookState.failAt ? hookState.failure : real(args...);
  }
  static void install(vk::DeviceContext& device) {
    real = device.functions.*kMember;
    device.functions.*kMember = call;
  }
};

template <auto... kMembers>
void hook(vk::DeviceContext& device) {
  (Hook<kMembers>::install(device), ...);
}

/// Hook everything that makes a Vulkan object or takes memory, and that can therefore fail.
inline void hookCreation(vk::DeviceContext& device) {
  using F = vk::DeviceFunctions;
  hook<&F::vkAllocateMemory, &F::vkMapMemory, &F::vkCreateImage, &F::vkBindImageMemory, &F::vkCreateImageView,
       &F::vkCreateBuffer, &F::vkBindBufferMemory, &F::vkCreateSampler, &F::vkCreateShaderModule,
       &F::vkCreatePipelineLayout, &F::vkCreateComputePipelines, &F::vkCreateDescriptorSetLayout,
       &F::vkCreateDescriptorPool, &F::vkAllocateDescriptorSets, &F::vkCreateQueryPool>(device);
}

template <typename Function>
struct Silenced;
template <typename... Args>
struct Silenced<void (*)(Args...)> {
  static void call(Args... /*unused*/) {}
};

template <typename... Functions>
void silence(Functions&... functions) {
  ((functions = Silenced<Functions>::call), ...);
}

/// Let everything that recording calls do nothing.
inline void silenceRecording(vk::DeviceContext& device) {
  auto& f = device.functions;
  auto& i = device.instance;
  silence(f.vkCmdPipelineBarrier2, f.vkCmdWriteTimestamp2, f.vkCmdResetQueryPool, f.vkCmdBindPipeline,
          f.vkCmdBindDescriptorSets, f.vkCmdPushConstants, f.vkCmdDispatch, f.vkCmdDispatchIndirect,
          f.vkCmdClearColorImage, f.vkCmdClearDepthStencilImage, f.vkCmdFillBuffer, f.vkUpdateDescriptorSets,
          i.vkCmdBeginDebugUtilsLabelEXT, i.vkCmdEndDebugUtilsLabelEXT);
}

}  // namespace fg::test
