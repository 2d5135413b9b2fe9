#pragma once

#include <cstdint>

#include "framegraph/vulkan/device_context.h"

/// Replaces entries of a device's function table: to count the calls that create Vulkan objects, to let one of them
/// fail, or to skip driver and layers.
namespace fg::test {

/// State that all hooks share, so that only one test at a time can use them.
struct HookState {
  std::uint32_t calls = 0;     ///< Calls of hooked functions since it was last set to 0.
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

/// Hook all functions that create Vulkan objects or allocate memory, and can therefore fail.
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

/// Replace all functions that recording calls by functions that do nothing.
inline void silenceRecording(vk::DeviceContext& device) {
  auto& f = device.functions;
  auto& i = device.instance;
  silence(f.vkCmdPipelineBarrier2, f.vkCmdWriteTimestamp2, f.vkCmdResetQueryPool, f.vkCmdBindPipeline,
          f.vkCmdBindDescriptorSets, f.vkCmdPushConstants, f.vkCmdDispatch, f.vkCmdDispatchIndirect,
          f.vkCmdClearColorImage, f.vkCmdClearDepthStencilImage, f.vkCmdFillBuffer, f.vkUpdateDescriptorSets,
          i.vkCmdBeginDebugUtilsLabelEXT, i.vkCmdEndDebugUtilsLabelEXT);
}

}  // namespace fg::test
