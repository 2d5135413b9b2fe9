#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string_view>
#include <type_traits>

#include <vulkan/vulkan_core.h>

/// Counts the library's calls of the driver, through the functions of WalrDevice::get_instance_proc_addr.
namespace walr::test {

struct DeviceCalls {
  std::uint32_t objects = 0;         ///< Created or bound to memory, except `pipelines`.
  std::uint32_t pipelines = 0;       ///< Created, with their shader modules and layouts.
  std::uint32_t waits = 0;           ///< For a queue, the device or a fence.
  std::uint64_t bytes = 0;           ///< Device memory allocated.
  std::set<VkPipelineCache> caches;  ///< That pipelines were created with.
};
/// Counts since it was last set to {}. Only one test may use it at a time.
inline DeviceCalls deviceCalls;

namespace detail {

/// A wrapper of a driver's function that counts its calls.
template <typename Function, std::uint32_t DeviceCalls::*kCounter>
struct Counted;
template <typename... Args, std::uint32_t DeviceCalls::*kCounter>
struct Counted<VkResult (*)(Args...), kCounter> {
  static inline VkResult (*real)(Args...) = nullptr;
  static VkResult call(Args... args) {
    ++(deviceCalls.*kCounter);
    (look(args), ...);
    return real(args...);
  }
  static PFN_vkVoidFunction wrap(PFN_vkVoidFunction function) {
    real = reinterpret_cast<VkResult (*)(Args...)>(function);
    return reinterpret_cast<PFN_vkVoidFunction>(call);
  }

 private:
  template <typename Arg>
  static void look(Arg arg) {
    if constexpr (std::is_same_v<Arg, const VkMemoryAllocateInfo*>) deviceCalls.bytes += arg->allocationSize;
    if constexpr (std::is_same_v<Arg, VkPipelineCache>) deviceCalls.caches.insert(arg);
  }
};

inline PFN_vkGetInstanceProcAddr realInstanceProcAddr = nullptr;
inline PFN_vkGetDeviceProcAddr realDeviceProcAddr = nullptr;

inline PFN_vkVoidFunction deviceProcAddr(VkDevice device, const char* name) {
  constexpr auto kObjects = &DeviceCalls::objects;
  constexpr auto kPipelines = &DeviceCalls::pipelines;
  constexpr auto kWaits = &DeviceCalls::waits;
  static const std::map<std::string_view, PFN_vkVoidFunction (*)(PFN_vkVoidFunction)> kCounted{
      {"vkAllocateMemory", Counted<PFN_vkAllocateMemory, kObjects>::wrap},
      {"vkBindImageMemory", Counted<PFN_vkBindImageMemory, kObjects>::wrap},
      {"vkBindBufferMemory", Counted<PFN_vkBindBufferMemory, kObjects>::wrap},
      {"vkCreateImage", Counted<PFN_vkCreateImage, kObjects>::wrap},
      {"vkCreateImageView", Counted<PFN_vkCreateImageView, kObjects>::wrap},
      {"vkCreateBuffer", Counted<PFN_vkCreateBuffer, kObjects>::wrap},
      {"vkCreateSampler", Counted<PFN_vkCreateSampler, kObjects>::wrap},
      {"vkCreateShaderModule", Counted<PFN_vkCreateShaderModule, kPipelines>::wrap},
      {"vkCreatePipelineLayout", Counted<PFN_vkCreatePipelineLayout, kPipelines>::wrap},
      {"vkCreateComputePipelines", Counted<PFN_vkCreateComputePipelines, kPipelines>::wrap},
      {"vkCreatePipelineCache", Counted<PFN_vkCreatePipelineCache, kObjects>::wrap},
      {"vkCreateDescriptorSetLayout", Counted<PFN_vkCreateDescriptorSetLayout, kPipelines>::wrap},
      {"vkCreateDescriptorPool", Counted<PFN_vkCreateDescriptorPool, kObjects>::wrap},
      {"vkAllocateDescriptorSets", Counted<PFN_vkAllocateDescriptorSets, kObjects>::wrap},
      {"vkCreateQueryPool", Counted<PFN_vkCreateQueryPool, kObjects>::wrap},
      {"vkCreateFence", Counted<PFN_vkCreateFence, kObjects>::wrap},
      {"vkCreateSemaphore", Counted<PFN_vkCreateSemaphore, kObjects>::wrap},
      {"vkCreateCommandPool", Counted<PFN_vkCreateCommandPool, kObjects>::wrap},
      {"vkAllocateCommandBuffers", Counted<PFN_vkAllocateCommandBuffers, kObjects>::wrap},
      {"vkWaitForFences", Counted<PFN_vkWaitForFences, kWaits>::wrap},
      {"vkWaitSemaphores", Counted<PFN_vkWaitSemaphores, kWaits>::wrap},
      {"vkQueueWaitIdle", Counted<PFN_vkQueueWaitIdle, kWaits>::wrap},
      {"vkDeviceWaitIdle", Counted<PFN_vkDeviceWaitIdle, kWaits>::wrap},
  };
  const PFN_vkVoidFunction real = realDeviceProcAddr(device, name);
  const auto counted = kCounted.find(name);
  return real == nullptr || counted == kCounted.end() ? real : counted->second(real);
}

inline PFN_vkVoidFunction instanceProcAddr(VkInstance instance, const char* name) {
  const PFN_vkVoidFunction real = realInstanceProcAddr(instance, name);
  if (std::string_view(name) != "vkGetDeviceProcAddr") return real;
  realDeviceProcAddr = reinterpret_cast<PFN_vkGetDeviceProcAddr>(real);
  return reinterpret_cast<PFN_vkVoidFunction>(deviceProcAddr);
}

}  // namespace detail

/// The function for WalrDevice::get_instance_proc_addr that counts calls. Resets `deviceCalls`.
inline PFN_vkGetInstanceProcAddr countDeviceCalls(PFN_vkGetInstanceProcAddr real) {
  deviceCalls = {};
  detail::realInstanceProcAddr = real;
  return detail::instanceProcAddr;
}

}  // namespace walr::test
