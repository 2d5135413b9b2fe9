#pragma once

#include <string_view>

#include <vulkan/vulkan_core.h>

#include "framegraph/vulkan/device_context.h"

/// A device that lacks something: replaces one function of the instance, through WalrDevice::get_instance_proc_addr.
namespace walr::test {

struct ReplacedFunction {
  std::string_view name;
  PFN_vkVoidFunction replacement = nullptr;
  PFN_vkVoidFunction real = nullptr;
  PFN_vkGetInstanceProcAddr getProcAddr = nullptr;
};
/// Only one test may use it at a time.
inline ReplacedFunction replacedFunction;

/// The function for WalrDevice::get_instance_proc_addr.
template <typename Function>
PFN_vkGetInstanceProcAddr replaceFunction(const fg::vk::DeviceContext& device, std::string_view name,
                                          Function replacement) {
  const PFN_vkGetInstanceProcAddr real = device.view.getInstanceProcAddr;
  replacedFunction = {.name = name,
                      .replacement = reinterpret_cast<PFN_vkVoidFunction>(replacement),
                      .real = real(device.view.instance, name.data()),
                      .getProcAddr = real};
  return [](VkInstance instance, const char* wanted) {
    return replacedFunction.name == wanted ? replacedFunction.replacement
                                           : replacedFunction.getProcAddr(instance, wanted);
  };
}

/// What the replacement replaces.
template <typename Function>
Function realFunction() {
  return reinterpret_cast<Function>(replacedFunction.real);
}

}  // namespace walr::test
