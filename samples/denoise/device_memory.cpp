#include "samples/denoise/device_memory.h"

namespace walr {

std::optional<DeviceMemory> deviceMemory(const GpuDevice& gpu) {
  const auto query = reinterpret_cast<PFN_vkGetPhysicalDeviceMemoryProperties2>(
      gpu.functions().vkGetInstanceProcAddr(gpu.instance(), "vkGetPhysicalDeviceMemoryProperties2"));
  if (!gpu.physical().hasExtension(VK_EXT_MEMORY_BUDGET_EXTENSION_NAME) || query == nullptr) return std::nullopt;
  VkPhysicalDeviceMemoryBudgetPropertiesEXT budget{};
  budget.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT;
  VkPhysicalDeviceMemoryProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_PROPERTIES_2;
  properties.pNext = &budget;
  query(gpu.physical().handle, &properties);
  DeviceMemory memory;
  for (std::uint32_t heap = 0; heap < properties.memoryProperties.memoryHeapCount; ++heap) {
    if ((properties.memoryProperties.memoryHeaps[heap].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) == 0) continue;
    memory.used += budget.heapUsage[heap];
    memory.budget += budget.heapBudget[heap];
  }
  return memory;
}

}  // namespace walr
