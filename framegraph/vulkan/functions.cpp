#include "framegraph/vulkan/functions.h"

#include <string>

#include "framegraph/vulkan/error.h"

namespace fg::vk {
namespace {

[[noreturn]] void missing(const char* name, const char* wayOut) {
  throw Unsupported(std::string("Vulkan function ") + name + " is missing: " + wayOut, VK_ERROR_FEATURE_NOT_PRESENT);
}

/// The core function, or the one of the extension that became core.
template <typename Function>
Function loadPromoted(VkDevice device, PFN_vkGetDeviceProcAddr getProcAddr, const std::string& name) {
  PFN_vkVoidFunction function = getProcAddr(device, name.c_str());
  if (function == nullptr) function = getProcAddr(device, (name + "KHR").c_str());
  return reinterpret_cast<Function>(function);
}

}  // namespace

InstanceFunctions InstanceFunctions::load(VkInstance instance, PFN_vkGetInstanceProcAddr getInstanceProcAddr) {
  InstanceFunctions table;
  table.vkGetInstanceProcAddr = getInstanceProcAddr;
#define FG_VK_LOAD(name) table.name = reinterpret_cast<PFN_##name>(getInstanceProcAddr(instance, #name));
#define FG_VK_LOAD_REQUIRED(name) \
  FG_VK_LOAD(name)                \
  if (table.name == nullptr) missing(#name, "the instance must be of Vulkan 1.1 or later");
  FG_VK_INSTANCE_FUNCTIONS(FG_VK_LOAD_REQUIRED)
  FG_VK_DEBUG_FUNCTIONS(FG_VK_LOAD)
#undef FG_VK_LOAD_REQUIRED
#undef FG_VK_LOAD
  return table;
}

DeviceFunctions DeviceFunctions::load(VkDevice device, PFN_vkGetDeviceProcAddr getDeviceProcAddr) {
  DeviceFunctions table;
#define FG_VK_LOAD(name)                                                       \
  table.name = reinterpret_cast<PFN_##name>(getDeviceProcAddr(device, #name)); \
  if (table.name == nullptr) missing(#name, "the device must be of Vulkan 1.1 or later");
#define FG_VK_LOAD_OPTIONAL(name) table.name = loadPromoted<PFN_##name>(device, getDeviceProcAddr, #name);
#define FG_VK_LOAD_SYNCHRONIZATION2(name) \
  FG_VK_LOAD_OPTIONAL(name)               \
  if (table.name == nullptr) missing(#name, "create the device with Vulkan 1.3 or VK_KHR_synchronization2");
  FG_VK_DEVICE_FUNCTIONS(FG_VK_LOAD)
  FG_VK_SYNCHRONIZATION2_FUNCTIONS(FG_VK_LOAD_SYNCHRONIZATION2)
  FG_VK_OPTIONAL_FUNCTIONS(FG_VK_LOAD_OPTIONAL)
#undef FG_VK_LOAD_SYNCHRONIZATION2
#undef FG_VK_LOAD_OPTIONAL
#undef FG_VK_LOAD
  return table;
}

}  // namespace fg::vk
