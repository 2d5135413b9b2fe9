#pragma once

#include <vulkan/vulkan_core.h>

/// Tables of the Vulkan functions in use, filled from proc addresses, so that nothing depends on what the loader
/// exports and a host may bring whatever entry points it has.
namespace fg::vk {

// One line a function keeps declaration and loading in step; C++ has no other way to iterate over names.
#define FG_VK_INSTANCE_FUNCTIONS(X)           \
  X(vkDestroyInstance)                        \
  X(vkEnumeratePhysicalDevices)               \
  X(vkEnumerateDeviceExtensionProperties)     \
  X(vkGetPhysicalDeviceProperties)            \
  X(vkGetPhysicalDeviceProperties2)           \
  X(vkGetPhysicalDeviceFeatures2)             \
  X(vkGetPhysicalDeviceMemoryProperties)      \
  X(vkGetPhysicalDeviceFormatProperties)      \
  X(vkGetPhysicalDeviceQueueFamilyProperties) \
  X(vkCreateDevice)                           \
  X(vkGetDeviceProcAddr)

#define FG_VK_DEBUG_FUNCTIONS(X)     \
  X(vkCreateDebugUtilsMessengerEXT)  \
  X(vkDestroyDebugUtilsMessengerEXT) \
  X(vkCmdBeginDebugUtilsLabelEXT)    \
  X(vkCmdEndDebugUtilsLabelEXT)      \
  X(vkSetDebugUtilsObjectNameEXT)

#define FG_VK_DEVICE_FUNCTIONS(X)  \
  X(vkDestroyDevice)               \
  X(vkDeviceWaitIdle)              \
  X(vkGetDeviceQueue)              \
  X(vkAllocateMemory)              \
  X(vkFreeMemory)                  \
  X(vkMapMemory)                   \
  X(vkCreateImage)                 \
  X(vkDestroyImage)                \
  X(vkGetImageMemoryRequirements)  \
  X(vkBindImageMemory)             \
  X(vkCreateImageView)             \
  X(vkDestroyImageView)            \
  X(vkCreateBuffer)                \
  X(vkDestroyBuffer)               \
  X(vkGetBufferMemoryRequirements) \
  X(vkBindBufferMemory)            \
  X(vkCreateSampler)               \
  X(vkDestroySampler)              \
  X(vkCreateShaderModule)          \
  X(vkDestroyShaderModule)         \
  X(vkCreatePipelineCache)         \
  X(vkDestroyPipelineCache)        \
  X(vkGetPipelineCacheData)        \
  X(vkCreatePipelineLayout)        \
  X(vkDestroyPipelineLayout)       \
  X(vkCreateComputePipelines)      \
  X(vkDestroyPipeline)             \
  X(vkCreateDescriptorSetLayout)   \
  X(vkDestroyDescriptorSetLayout)  \
  X(vkCreateDescriptorPool)        \
  X(vkDestroyDescriptorPool)       \
  X(vkAllocateDescriptorSets)      \
  X(vkUpdateDescriptorSets)        \
  X(vkCreateQueryPool)             \
  X(vkDestroyQueryPool)            \
  X(vkGetQueryPoolResults)         \
  X(vkCreateFence)                 \
  X(vkDestroyFence)                \
  X(vkWaitForFences)               \
  X(vkResetFences)                 \
  X(vkCreateCommandPool)           \
  X(vkDestroyCommandPool)          \
  X(vkAllocateCommandBuffers)      \
  X(vkResetCommandPool)            \
  X(vkBeginCommandBuffer)          \
  X(vkEndCommandBuffer)            \
  X(vkQueueSubmit)                 \
  X(vkCmdBindPipeline)             \
  X(vkCmdBindDescriptorSets)       \
  X(vkCmdPushConstants)            \
  X(vkCmdDispatch)                 \
  X(vkCmdDispatchIndirect)         \
  X(vkCmdClearColorImage)          \
  X(vkCmdClearDepthStencilImage)   \
  X(vkCmdFillBuffer)               \
  X(vkCmdCopyBuffer)               \
  X(vkCmdCopyBufferToImage)        \
  X(vkCmdCopyImageToBuffer)        \
  X(vkCmdResetQueryPool)

// Core in Vulkan 1.3, VK_KHR_synchronization2 before.
#define FG_VK_SYNCHRONIZATION2_FUNCTIONS(X) \
  X(vkCmdPipelineBarrier2)                  \
  X(vkCmdWriteTimestamp2)

// Core in Vulkan 1.3, VK_KHR_maintenance4 before; made use of where it is there.
#define FG_VK_OPTIONAL_FUNCTIONS(X)     \
  X(vkGetDeviceImageMemoryRequirements) \
  X(vkGetDeviceBufferMemoryRequirements)

#define FG_VK_DECLARE(name) PFN_##name name = nullptr;

struct InstanceFunctions {
  PFN_vkGetInstanceProcAddr vkGetInstanceProcAddr = nullptr;
  FG_VK_INSTANCE_FUNCTIONS(FG_VK_DECLARE)
  FG_VK_DEBUG_FUNCTIONS(FG_VK_DECLARE)  // Null without VK_EXT_debug_utils.

  /// @throws Unsupported naming the first function that is missing
  static InstanceFunctions load(VkInstance instance, PFN_vkGetInstanceProcAddr getInstanceProcAddr);
};

struct DeviceFunctions {
  FG_VK_DEVICE_FUNCTIONS(FG_VK_DECLARE)
  FG_VK_SYNCHRONIZATION2_FUNCTIONS(FG_VK_DECLARE)
  FG_VK_OPTIONAL_FUNCTIONS(FG_VK_DECLARE)

  /// @throws Unsupported naming the first function that is missing
  static DeviceFunctions load(VkDevice device, PFN_vkGetDeviceProcAddr getDeviceProcAddr);
};

#undef FG_VK_DECLARE

}  // namespace fg::vk
