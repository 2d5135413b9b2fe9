#include "integration/c_api/device.h"

#include <string>
#include <vector>

#include "framegraph/declare/format.h"
#include "framegraph/vulkan/error.h"
#include "integration/c_api/structs.h"

namespace walr::api {
namespace {

void requireSet(bool set, const char* member) {
  if (!set) throw Error(WALR_ERROR_INVALID_ARGUMENT, std::string("WalrDevice::") + member + " is null");
}

WalrDevice checkedDevice(const WalrDevice* given) {
  const WalrDevice device = readStruct(given, "WalrDevice");
  requireSet(device.instance != VK_NULL_HANDLE, "instance");
  requireSet(device.physical_device != VK_NULL_HANDLE, "physical_device");
  requireSet(device.device != VK_NULL_HANDLE, "device");
  requireSet(device.get_instance_proc_addr != nullptr, "get_instance_proc_addr");
  return device;
}

void requireCompute(const fg::vk::DeviceContext& context) {
  std::uint32_t count = 0;
  context.instance.vkGetPhysicalDeviceQueueFamilyProperties(context.view.physicalDevice, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  context.instance.vkGetPhysicalDeviceQueueFamilyProperties(context.view.physicalDevice, &count, families.data());
  if ((families.at(context.view.queueFamily).queueFlags & VK_QUEUE_COMPUTE_BIT) != 0) return;
  throw Error(WALR_ERROR_UNSUPPORTED, "queue family " + std::to_string(context.view.queueFamily) +
                                          " does not support compute: use a queue of another family");
}

/// The structure of a type in a chain of `pNext`; null if the chain has none.
template <typename Struct>
const Struct* findInChain(const void* chain, VkStructureType type) {
  for (const auto* link = static_cast<const VkBaseInStructure*>(chain); link != nullptr; link = link->pNext) {
    if (link->sType == type) return reinterpret_cast<const Struct*>(link);
  }
  return nullptr;
}

/// Whether a device is created with a feature, which is a member of the structure of its Vulkan version and of that of
/// an extension.
template <typename Version, typename Extension>
bool enables(const VkDeviceCreateInfo& info, VkStructureType versionType, VkBool32 Version::*ofVersion,
             VkStructureType extensionType, VkBool32 Extension::*ofExtension) {
  const auto* version = findInChain<Version>(info.pNext, versionType);
  const auto* extension = findInChain<Extension>(info.pNext, extensionType);
  return (version != nullptr && version->*ofVersion == VK_TRUE) ||
         (extension != nullptr && extension->*ofExtension == VK_TRUE);
}

bool enablesTimelineSemaphores(const VkDeviceCreateInfo& info) {
  return enables(info, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES,
                 &VkPhysicalDeviceVulkan12Features::timelineSemaphore,
                 VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_TIMELINE_SEMAPHORE_FEATURES,
                 &VkPhysicalDeviceTimelineSemaphoreFeatures::timelineSemaphore);
}

bool enablesHalves(const VkDeviceCreateInfo& info) {
  return enables(info, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES,
                 &VkPhysicalDeviceVulkan12Features::shaderFloat16,
                 VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SHADER_FLOAT16_INT8_FEATURES,
                 &VkPhysicalDeviceShaderFloat16Int8Features::shaderFloat16);
}

bool enablesSynchronization2(const VkDeviceCreateInfo& info) {
  return enables(info, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES,
                 &VkPhysicalDeviceVulkan13Features::synchronization2,
                 VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES,
                 &VkPhysicalDeviceSynchronization2Features::synchronization2);
}

/// @throws Unsupported naming the features that a device was created without
void requireEnabled(const VkDeviceCreateInfo& info) {
  std::string lacks;
  if (!enablesSynchronization2(info)) {
    lacks +=
        "\n  feature synchronization2: chain VkPhysicalDeviceVulkan13Features or "
        "VkPhysicalDeviceSynchronization2Features to VkDeviceCreateInfo";
  }
  const auto* features2 =
      findInChain<VkPhysicalDeviceFeatures2>(info.pNext, VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
  const VkPhysicalDeviceFeatures* features = features2 != nullptr ? &features2->features : info.pEnabledFeatures;
  if (features == nullptr || features->shaderStorageImageExtendedFormats != VK_TRUE) {
    lacks += "\n  feature shaderStorageImageExtendedFormats: set it in VkPhysicalDeviceFeatures";
  }
  if (!lacks.empty()) {
    throw fg::vk::Unsupported("the device was created without" + lacks, VK_ERROR_FEATURE_NOT_PRESENT);
  }
}

}  // namespace

HostDevice::HostDevice(const WalrDevice* device) : HostDevice(checkedDevice(device)) {}

HostDevice::HostDevice(const WalrDevice& device) {
  if (device.allocator != nullptr) allocator_ = *device.allocator;
  if (device.device_memory != nullptr) memory_.emplace(*device.device_memory);
  context_ =
      fg::vk::DeviceContext({.instance = device.instance,
                             .physicalDevice = device.physical_device,
                             .device = device.device,
                             .getInstanceProcAddr = device.get_instance_proc_addr,
                             .queueFamily = device.queue_family,
                             .allocator = allocator_ ? &*allocator_ : nullptr,
                             .memorySource = memory_ ? &*memory_ : nullptr,
                             .shaderFloat16 = device.create_info != nullptr && enablesHalves(*device.create_info)});
  physical_ = fg::vk::physicalDevice(context_.instance, device.physical_device);
  fg::vk::require(physical_);
  requireCompute(context_);
  if (device.create_info == nullptr) return;
  requireEnabled(*device.create_info);
  withoutTimelineSemaphores_ = !enablesTimelineSemaphores(*device.create_info);
}

void HostDevice::requireResultFormat(VkFormat format) const {
  if ((physical_.formatFeatures(format) & VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT) != 0) return;
  throw Error(WALR_ERROR_UNSUPPORTED,
              "device '" + physical_.name + "' has no storage images of WalrDenoiserInfo::denoised_format, " +
                  std::string(fg::formatInfo(format).name) + ": use R16G16B16A16_SFLOAT, which every device has");
}

fg::vk::TimelinePoint HostDevice::finishedPoint(VkSemaphore semaphore, std::uint64_t value) const {
  if (semaphore == VK_NULL_HANDLE && value != 0) {
    throw Error(WALR_ERROR_INVALID_ARGUMENT,
                "finished_value is " + std::to_string(value) + ", but the semaphore `finished` is null");
  }
  if (semaphore == VK_NULL_HANDLE || !withoutTimelineSemaphores_) return {semaphore, value};
  throw fg::vk::Unsupported(
      "the frame tells with a timeline semaphore when it is finished, but the device was created without\n  feature "
      "timelineSemaphore: chain VkPhysicalDeviceVulkan12Features or VkPhysicalDeviceTimelineSemaphoreFeatures to "
      "VkDeviceCreateInfo",
      VK_ERROR_FEATURE_NOT_PRESENT);
}

bool measuresTimes(const WalrDenoiserInfo& info, const HostDevice& device) {
  const fg::vk::DeviceContext& context = device.context();
  if (info.timestamps != VK_TRUE || context.timestampBits > 0) return info.timestamps == VK_TRUE;
  const std::string text = "queue family " + std::to_string(context.view.queueFamily) +
                           " has no timestamps: no times are measured; use a queue of another family for them";
  if (info.log != nullptr) info.log(info.log_user, WALR_LOG_WARNING, text.c_str());
  return false;
}

}  // namespace walr::api
