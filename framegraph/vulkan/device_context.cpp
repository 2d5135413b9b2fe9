#include "framegraph/vulkan/device_context.h"

#include <vector>

#include "framegraph/vulkan/error.h"

namespace fg::vk {

DeviceContext::DeviceContext(const DeviceView& deviceView)
    : view(deviceView),
      instance(InstanceFunctions::load(view.instance, view.getInstanceProcAddr)),
      functions(DeviceFunctions::load(view.device, instance.vkGetDeviceProcAddr)) {
  instance.vkGetPhysicalDeviceProperties(view.physicalDevice, &properties);
  instance.vkGetPhysicalDeviceMemoryProperties(view.physicalDevice, &memory);
  std::uint32_t count = 0;
  instance.vkGetPhysicalDeviceQueueFamilyProperties(view.physicalDevice, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  instance.vkGetPhysicalDeviceQueueFamilyProperties(view.physicalDevice, &count, families.data());
  if (view.queueFamily >= count) {
    throw Unsupported("queue family " + std::to_string(view.queueFamily) + " does not exist: the device has " +
                      std::to_string(count));
  }
  timestampBits = families[view.queueFamily].timestampValidBits;
}

void DeviceContext::setName(VkObjectType type, std::uint64_t handle, const std::string& name) const {
  if (instance.vkSetDebugUtilsObjectNameEXT == nullptr) return;
  const VkDebugUtilsObjectNameInfoEXT info = {
      .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
      .pNext = nullptr,
      .objectType = type,
      .objectHandle = handle,
      .pObjectName = name.c_str(),
  };
  instance.vkSetDebugUtilsObjectNameEXT(view.device, &info);
}

}  // namespace fg::vk
