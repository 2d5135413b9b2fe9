#include "samples/gpu_render/ray_functions.h"

#include <string>

#include "framegraph/vulkan/error.h"

namespace walr::gpu_render {

RayFunctions RayFunctions::load(const fg::vk::DeviceContext& device) {
  RayFunctions functions;
  const auto get = [&](auto& function, const char* name) {
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(
        device.instance.vkGetDeviceProcAddr(device.view.device, name));
    if (function == nullptr) throw fg::vk::Unsupported(std::string("the Vulkan device lacks the function ") + name);
  };
  get(functions.vkGetBufferDeviceAddress, "vkGetBufferDeviceAddress");
  get(functions.vkCreateAccelerationStructureKHR, "vkCreateAccelerationStructureKHR");
  get(functions.vkDestroyAccelerationStructureKHR, "vkDestroyAccelerationStructureKHR");
  get(functions.vkGetAccelerationStructureBuildSizesKHR, "vkGetAccelerationStructureBuildSizesKHR");
  get(functions.vkGetAccelerationStructureDeviceAddressKHR, "vkGetAccelerationStructureDeviceAddressKHR");
  get(functions.vkCmdBuildAccelerationStructuresKHR, "vkCmdBuildAccelerationStructuresKHR");
  get(functions.vkCmdPushDescriptorSetKHR, "vkCmdPushDescriptorSetKHR");
  return functions;
}

}  // namespace walr::gpu_render
