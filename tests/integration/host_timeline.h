#pragma once

#include <cstdint>
#include <stdexcept>

#include "host/vulkan_host.h"

namespace walr::test {

/// A timeline semaphore of a host, and the value that it last asked for.
class HostTimeline {
 public:
  explicit HostTimeline(VkDevice device) : device_(device) {
    VkSemaphoreTypeCreateInfo type{};
    type.sType = VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO;
    type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
    VkSemaphoreCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO;
    info.pNext = &type;
    if (vkCreateSemaphore(device, &info, nullptr, &semaphore_) != VK_SUCCESS) throw std::runtime_error("semaphore");
  }
  ~HostTimeline() { vkDestroySemaphore(device_, semaphore_, nullptr); }
  HostTimeline(const HostTimeline&) = delete;
  HostTimeline& operator=(const HostTimeline&) = delete;

  [[nodiscard]] VkSemaphore semaphore() const { return semaphore_; }
  std::uint64_t raise() { return ++value_; }
  void raiseTo(std::uint64_t value) { value_ = value; }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  VkDevice device_;
  VkSemaphore semaphore_ = VK_NULL_HANDLE;
  std::uint64_t value_ = 0;
};

}  // namespace walr::test
