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

void requireExtensions(const PhysicalDevice& physicalDevice, std::span<const char* const> wanted) {
  for (const char* const extension : wanted) {
    if (std::ranges::find(physicalDevice.extensions, extension) == physicalDevice.extensions.end()) {
      throw Unsupported("device '" + physicalDevice.name + "' lacks the extension " + extension +
                            ": choose another device, or run without what needs it",
                        VK_ERROR_EXTENSION_NOT_PRESENT);
    }
  }
}

/// The features to enable, as a chain for `VkDeviceCreateInfo::pNext`.
class FeatureChain {
 public:
  /// @param wanted further feature structs
  FeatureChain(const PhysicalDevice& physicalDevice, bool halves, const void* wanted)
      : first_(const_cast<void*>(wanted)) {  // Read only, but Vulkan's structs also serve queries.
    float16_.shaderFloat16 = VK_TRUE;
    if (halves) prepend(float16_, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_FLOAT16_INT8_FEATURES);
    maintenance4_.maintenance4 = VK_TRUE;
    if (physicalDevice.maintenance4) prepend(maintenance4_, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_FEATURES);
    timeline_.timelineSemaphore = VK_TRUE;
    if (physicalDevice.timelineSemaphore) {
      prepend(timeline_, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TIMELINE_SEMAPHORE_FEATURES);
    }
    synchronization2_.synchronization2 = VK_TRUE;
    prepend(synchronization2_, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES);
    core_.features.shaderStorageImageExtendedFormats = VK_TRUE;
    core_.features.shaderStorageImageWriteWithoutFormat = physicalDevice.features.shaderStorageImageWriteWithoutFormat;
    core_.features.shaderInt16 = physicalDevice.features.shaderInt16;
    prepend(core_, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
  }
  FeatureChain(const FeatureChain&) = delete;
  FeatureChain& operator=(const FeatureChain&) = delete;

  [[nodiscard]] const void* first() const { return first_; }

 private:
  template <typename Features>
  void prepend(Features& features, VkStructureType type) {
    features.sType = type;
    features.pNext = first_;
    first_ = &features;
  }

  VkPhysicalDeviceShaderFloat16Int8Features float16_{};
  VkPhysicalDeviceMaintenance4Features maintenance4_{};
  VkPhysicalDeviceTimelineSemaphoreFeatures timeline_{};
  VkPhysicalDeviceSynchronization2Features synchronization2_{};
  VkPhysicalDeviceFeatures2 core_{};
  void* first_;
};

/// `wanted`, and those that older versions of Vulkan need for the features.
std::vector<const char*> extensionsOf(const PhysicalDevice& physicalDevice, std::span<const char* const> wanted,
                                      bool halves) {
  std::vector<const char*> extensions(wanted.begin(), wanted.end());
  if (physicalDevice.apiVersion < VK_API_VERSION_1_3) {
    extensions.push_back(VK_KHR_SYNCHRONIZATION_2_EXTENSION_NAME);
    if (physicalDevice.maintenance4) extensions.push_back(VK_KHR_MAINTENANCE_4_EXTENSION_NAME);
  }
  if (physicalDevice.apiVersion < VK_API_VERSION_1_2) {
    if (physicalDevice.timelineSemaphore) extensions.push_back(VK_KHR_TIMELINE_SEMAPHORE_EXTENSION_NAME);
    if (halves) extensions.push_back(VK_KHR_SHADER_FLOAT16_INT8_EXTENSION_NAME);
  }
  return extensions;
}

VkDevice createDevice(const Instance& instance, const PhysicalDevice& physicalDevice,
                      std::span<const char* const> wanted, const void* wantedFeatures, bool halves) {
  require(physicalDevice);
  requireExtensions(physicalDevice, wanted);
  const FeatureChain features(physicalDevice, halves, wantedFeatures);
  const std::vector<const char*> extensions = extensionsOf(physicalDevice, wanted, halves);
  const float priority = 1.0f;
  VkDeviceQueueCreateInfo queue{};
  queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue.queueFamilyIndex = physicalDevice.computeQueueFamily;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  VkDeviceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  info.pNext = features.first();
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
    : handle_(createDevice(instance, physicalDevice, extensions, features, takesHalves(physicalDevice, halves)),
              {reinterpret_cast<PFN_vkDestroyDevice>(
                  instance.functions().vkGetInstanceProcAddr(instance.handle(), "vkDestroyDevice"))}),
      context_(DeviceView{.instance = instance.handle(),
                          .physicalDevice = physicalDevice.handle,
                          .device = handle_.get(),
                          .getInstanceProcAddr = instance.functions().vkGetInstanceProcAddr,
                          .queueFamily = physicalDevice.computeQueueFamily,
                          .allocator = nullptr,
                          .shaderFloat16 = takesHalves(physicalDevice, halves)}) {
  context_.functions.vkGetDeviceQueue(context_.view.device, context_.view.queueFamily, 0, &queue_);
}

}  // namespace fg::vk
