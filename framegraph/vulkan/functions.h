#pragma once

#include <vulkan/vulkan_core.h>

/// Tables of the Vulkan functions in use. They are loaded through vkGetInstanceProcAddr and vkGetDeviceProcAddr, so
/// that nothing depends on the symbols of a loader and a host can pass its own entry points.
namespace fg::vk {

// Lists of names, because C++ has no other way to declare and to load the functions from one list.
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

// Core in Vulkan 1.3; before that in VK_KHR_synchronization2.
#define FG_VK_SYNCHRONIZATION2_FUNCTIONS(X) \
  X(vkCmdPipelineBarrier2)                  \
  X(vkCmdWriteTimestamp2)

// Optional: core in Vulkan 1.3, before that in VK_KHR_maintenance4; the last one core in Vulkan 1.2, before that in
// VK_KHR_timeline_semaphore.
#define FG_VK_OPTIONAL_FUNCTIONS(X)      \
  X(vkGetDeviceImageMemoryRequirements)  \
  X(vkGetDeviceBufferMemoryRequirements) \
  X(vkGetSemaphoreCounterValue)

#define FG_VK_DECLARE(name) PFN_##name name = nullptr;

struct InstanceFunctions {
  PFN_vkGetInstanceProcAddr vkGetInstanceProcAddr = nullptr;
  FG_VK_INSTANCE_FUNCTIONS(FG_VK_DECLARE)
  FG_VK_DEBUG_FUNCTIONS(FG_VK_DECLARE)  // Null without VK_EXT_debug_utils.

  /// @throws Unsupported with a message that names the first missing function
  static InstanceFunctions load(VkInstance instance, PFN_vkGetInstanceProcAddr getInstanceProcAddr);
};

struct DeviceFunctions {
  FG_VK_DEVICE_FUNCTIONS(FG_VK_DECLARE)
  FG_VK_SYNCHRONIZATION2_FUNCTIONS(FG_VK_DECLARE)
  FG_VK_OPTIONAL_FUNCTIONS(FG_VK_DECLARE)

  /// @throws Unsupported with a message that names the first missing function
  static DeviceFunctions load(VkDevice device, PFN_vkGetDeviceProcAddr getDeviceProcAddr);
};

#undef FG_VK_DECLARE

}  // namespace fg::vk
