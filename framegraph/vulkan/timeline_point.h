#pragma once

#include <cstdint>

#include <vulkan/vulkan_core.h>

namespace fg::vk {

/// A value of a timeline semaphore. It needs the device feature timelineSemaphore (Vulkan 1.2 or
/// VK_KHR_timeline_semaphore).
struct TimelinePoint {
  VkSemaphore semaphore = VK_NULL_HANDLE;  ///< Null: none.
  std::uint64_t value = 0;
};

}  // namespace fg::vk
