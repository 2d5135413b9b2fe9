// A Vulkan layer that hides capabilities of a device, to test the messages of programs on a less capable device.
//
// Environment variable WALR_TEST_LACKS: "synchronization2" hides that feature, "storage images" the use of RGBA16F as
// storage image, "timestamps" those of all queues.

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

#define WALR_EXPORT extern "C" __attribute__((visibility("default")))

namespace {

/// The functions of the next layer, queried when the instance is created: later the loader would return those of this
/// layer.
struct Next {
  PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;
  PFN_vkGetPhysicalDeviceFeatures2 getFeatures = nullptr;
  PFN_vkGetPhysicalDeviceFormatProperties getFormatProperties = nullptr;
  PFN_vkGetPhysicalDeviceQueueFamilyProperties getQueueFamilies = nullptr;
};
Next next;

template <typename Function>
void load(Function& function, VkInstance instance, const char* name) {
  function = reinterpret_cast<Function>(next.getInstanceProcAddr(instance, name));
}

bool lacks(std::string_view what) {
  const char* const lacking = std::getenv("WALR_TEST_LACKS");
  return lacking != nullptr && what == lacking;
}

VKAPI_ATTR VkResult VKAPI_CALL createInstance(const VkInstanceCreateInfo* info, const VkAllocationCallbacks* allocator,
                                              VkInstance* instance) {
  // The loader passes the chain of layers in a struct that each layer advances.
  auto* link = static_cast<VkLayerInstanceCreateInfo*>(const_cast<void*>(info->pNext));
  while (link != nullptr &&
         (link->sType != VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO || link->function != VK_LAYER_LINK_INFO)) {
    link = static_cast<VkLayerInstanceCreateInfo*>(const_cast<void*>(link->pNext));
  }
  if (link == nullptr) {
    return VK_ERROR_INITIALIZATION_FAILED;
  }
  next.getInstanceProcAddr = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  PFN_vkCreateInstance create = nullptr;
  load(create, VK_NULL_HANDLE, "vkCreateInstance");
  const VkResult result = create(info, allocator, instance);
  if (result == VK_SUCCESS) {
    load(next.getFeatures, *instance, "vkGetPhysicalDeviceFeatures2");
    load(next.getFormatProperties, *instance, "vkGetPhysicalDeviceFormatProperties");
    load(next.getQueueFamilies, *instance, "vkGetPhysicalDeviceQueueFamilyProperties");
  }
  return result;
}

VKAPI_ATTR void VKAPI_CALL getFeatures(VkPhysicalDevice device, VkPhysicalDeviceFeatures2* features) {
  next.getFeatures(device, features);
  for (auto* entry = static_cast<VkBaseOutStructure*>(features->pNext); entry != nullptr; entry = entry->pNext) {
    if (entry->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES && lacks("synchronization2")) {
      reinterpret_cast<VkPhysicalDeviceSynchronization2Features*>(entry)->synchronization2 = VK_FALSE;
    }
  }
}

VKAPI_ATTR void VKAPI_CALL getFormatProperties(VkPhysicalDevice device, VkFormat format,
                                               VkFormatProperties* properties) {
  next.getFormatProperties(device, format, properties);
  if (format == VK_FORMAT_R16G16B16A16_SFLOAT && lacks("storage images")) {
    properties->optimalTilingFeatures &= ~static_cast<VkFlags>(VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT);
  }
}

VKAPI_ATTR void VKAPI_CALL getQueueFamilies(VkPhysicalDevice device, std::uint32_t* count,
                                            VkQueueFamilyProperties* families) {
  next.getQueueFamilies(device, count, families);
  if (families == nullptr || !lacks("timestamps")) return;
  for (std::uint32_t i = 0; i < *count; ++i) families[i].timestampValidBits = 0;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getInstanceProcAddr(VkInstance instance, const char* name) {
  const std::string_view wanted = name;
  if (wanted == "vkCreateInstance") {
    return reinterpret_cast<PFN_vkVoidFunction>(&createInstance);
  }
  if (wanted == "vkGetPhysicalDeviceFeatures2") {
    return reinterpret_cast<PFN_vkVoidFunction>(&getFeatures);
  }
  if (wanted == "vkGetPhysicalDeviceFormatProperties") {
    return reinterpret_cast<PFN_vkVoidFunction>(&getFormatProperties);
  }
  if (wanted == "vkGetPhysicalDeviceQueueFamilyProperties") {
    return reinterpret_cast<PFN_vkVoidFunction>(&getQueueFamilies);
  }
  if (wanted == "vkGetInstanceProcAddr") {
    return reinterpret_cast<PFN_vkVoidFunction>(&getInstanceProcAddr);
  }
  return next.getInstanceProcAddr != nullptr ? next.getInstanceProcAddr(instance, name) : nullptr;
}

}  // namespace

WALR_EXPORT VKAPI_ATTR VkResult VKAPI_CALL vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* version) {
  version->loaderLayerInterfaceVersion = 2;
  version->pfnGetInstanceProcAddr = &getInstanceProcAddr;
  version->pfnGetDeviceProcAddr = nullptr;  // This layer intercepts no device functions.
  version->pfnGetPhysicalDeviceProcAddr = nullptr;
  return VK_SUCCESS;
}
