#include "integration/c_api/device.h"

#include <string>
#include <vector>

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

}  // namespace

HostDevice::HostDevice(const WalrDevice* device) : HostDevice(checkedDevice(device)) {}

HostDevice::HostDevice(const WalrDevice& device) {
  if (device.allocator != nullptr) allocator_ = *device.allocator;
  context_ = fg::vk::DeviceContext({.instance = device.instance,
                                    .physicalDevice = device.physical_device,
                                    .device = device.device,
                                    .getInstanceProcAddr = device.get_instance_proc_addr,
                                    .queueFamily = device.queue_family,
                                    .allocator = allocator_ ? &*allocator_ : nullptr});
  physical_ = fg::vk::physicalDevice(context_.instance, device.physical_device);
  fg::vk::require(physical_);
  requireCompute(context_);
}

}  // namespace walr::api
