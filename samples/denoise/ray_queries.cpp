#include "samples/denoise/ray_queries.h"

namespace walr {
namespace {

void append(std::string& list, const std::string& item) {
  list += (list.empty() ? "" : ", ") + item;
}

}  // namespace

RayQueryFeatures::RayQueryFeatures() {
  addresses_.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_BUFFER_DEVICE_ADDRESS_FEATURES;
  addresses_.pNext = &structures_;
  addresses_.bufferDeviceAddress = VK_TRUE;
  structures_.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR;
  structures_.pNext = &queries_;
  structures_.accelerationStructure = VK_TRUE;
  queries_.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR;
  queries_.rayQuery = VK_TRUE;
}

std::string RayQueryFeatures::off() const {
  std::string names;
  if (addresses_.bufferDeviceAddress == VK_FALSE) append(names, "bufferDeviceAddress");
  if (structures_.accelerationStructure == VK_FALSE) append(names, "accelerationStructure");
  if (queries_.rayQuery == VK_FALSE) append(names, "rayQuery");
  return names;
}

std::string missingForRayQueries(const fg::vk::InstanceFunctions& functions, const fg::vk::PhysicalDevice& device) {
  if (device.apiVersion < VK_API_VERSION_1_2) return "Vulkan 1.2";
  std::string missing;
  for (const char* const extension : kRayQueryExtensions) {
    if (!device.hasExtension(extension)) append(missing, extension);
  }
  if (!missing.empty()) return missing;
  RayQueryFeatures features;
  VkPhysicalDeviceFeatures2 all{};
  all.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
  all.pNext = features.chain();
  functions.vkGetPhysicalDeviceFeatures2(device.handle, &all);
  return features.off();
}

}  // namespace walr
