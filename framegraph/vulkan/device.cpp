#include "framegraph/vulkan/device.h"

#include <algorithm>
#include <vector>

#include "framegraph/vulkan/error.h"

namespace fg::vk {
namespace {

bool takesHalves(const PhysicalDevice& device, HalfArithmetic halves) {
  const bool wanted = halves == HalfArithmetic::WhereSupported ||
                      (halves == HalfArithmetic::WhereFast && device.type != VK_PHYSICAL_DEVICE_TYPE_CPU);
  return wanted && device.shaderFloat16;
}

VkDevice createDevice(const Instance& instance, const PhysicalDevice& physicalDevice,
                      std::span<const char* const> wanted, const void* wantedFeatures, bool halves) {
  require(physicalDevice);
  for (const char* const extension : wanted) {
    if (std::ranges::find(physicalDevice.extensions, extension) == physicalDevice.extensions.end()) {
      throw Unsupported("device '" + physicalDevice.name + "' lacks the extension " + extension +
                            ": choose another device, or run without what needs it",
                        VK_ERROR_EXTENSION_NOT_PRESENT);
    }
  }
  const float priority = 1.0f;
  VkDeviceQueueCreateInfo queue{};
  queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue.queueFamilyIndex = physicalDevice.computeQueueFamily;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;

  VkPhysicalDeviceShaderFloat16Int8Features float16{};
  float16.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_FLOAT16_INT8_FEATURES;
  float16.pNext = const_cast<void*>(wantedFeatures);  // Read only, but Vulkan's struct also serves queries.
  float16.shaderFloat16 = VK_TRUE;
  VkPhysicalDeviceMaintenance4Features maintenance4{};
  maintenance4.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_FEATURES;
  maintenance4.pNext = halves ? &float16 : float16.pNext;
  maintenance4.maintenance4 = VK_TRUE;
  VkPhysicalDeviceTimelineSemaphoreFeatures timeline{};
  timeline.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TIMELINE_SEMAPHORE_FEATURES;
  timeline.pNext = physicalDevice.maintenance4 ? &maintenance4 : maintenance4.pNext;
  timeline.timelineSemaphore = physicalDevice.timelineSemaphore ? VK_TRUE : VK_FALSE;
  VkPhysicalDeviceSynchronization2Features synchronization2{};
  synchronization2.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES;
  synchronization2.pNext = physicalDevice.timelineSemaphore ? &timeline : timeline.pNext;
  synchronization2.synchronization2 = VK_TRUE;
  VkPhysicalDeviceFeatures2 features{};
  features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
  features.pNext = &synchronization2;
  features.features.shaderStorageImageExtendedFormats = VK_TRUE;
  features.features.shaderStorageImageWriteWithoutFormat = physicalDevice.features.shaderStorageImageWriteWithoutFormat;
  features.features.shaderInt16 = physicalDevice.features.shaderInt16;

  std::vector<const char*> extensions(wanted.begin(), wanted.end());
  if (physicalDevice.apiVersion < VK_API_VERSION_1_3) {
    extensions.push_back(VK_KHR_SYNCHRONIZATION_2_EXTENSION_NAME);
    if (physicalDevice.maintenance4) extensions.push_back(VK_KHR_MAINTENANCE_4_EXTENSION_NAME);
  }
  if (physicalDevice.apiVersion < VK_API_VERSION_1_2) {
    if (physicalDevice.timelineSemaphore) extensions.push_back(VK_KHR_TIMELINE_SEMAPHORE_EXTENSION_NAME);
    if (halves) extensions.push_back(VK_KHR_SHADER_FLOAT16_INT8_EXTENSION_NAME);
  }

  VkDeviceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.pNext = &features;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  VkDevice device = VK_NULL_HANDLE;
  check(instance.functions().vkCreateDevice(physicalDevice.handle, &info, nullptr, &device),
        "creating device '" + physicalDevice.name + "'");
  return device;
}

}  // namespace

Device::Device(const Instance& instance, const PhysicalDevice& physicalDevice, std::span<const char* const> extensions,
               const void* features, HalfArithmetic halves)
    : context_(DeviceView{
          .instance = instance.handle(),
          .physicalDevice = physicalDevice.handle,
          .device = createDevice(instance, physicalDevice, extensions, features, takesHalves(physicalDevice, halves)),
          .getInstanceProcAddr = instance.functions().vkGetInstanceProcAddr,
          .queueFamily = physicalDevice.computeQueueFamily,
          .allocator = nullptr,
          .shaderFloat16 = takesHalves(physicalDevice, halves)}) {
  context_.functions.vkGetDeviceQueue(context_.view.device, context_.view.queueFamily, 0, &queue_);
}

Device::~Device() {
  context_.functions.vkDestroyDevice(context_.view.device, nullptr);
}

}  // namespace fg::vk
