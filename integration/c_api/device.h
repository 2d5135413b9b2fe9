#pragma once

#include <optional>

#include <walr/walr.h>

#include "framegraph/vulkan/device_context.h"
#include "framegraph/vulkan/physical_device.h"
#include "framegraph/vulkan/timeline_point.h"
#include "integration/c_api/host_memory.h"

namespace walr::api {

/// The host's device, checked, with its functions.
class HostDevice {
 public:
  /// @throws Error or fg::vk::Unsupported naming what is null or missing
  explicit HostDevice(const WalrDevice* device);
  HostDevice(const HostDevice&) = delete;
  HostDevice& operator=(const HostDevice&) = delete;

  /// @throws Error naming the format if the device cannot write images of it in shaders
  void requireResultFormat(VkFormat format) const;
  /// What tells that a frame is finished, from WalrFrame::finished and finished_value.
  /// @throws Error for a value alone; Unsupported if WalrDevice::create_info enables no timeline semaphores
  [[nodiscard]] fg::vk::TimelinePoint finishedPoint(VkSemaphore semaphore, std::uint64_t value) const;

  [[nodiscard]] const fg::vk::DeviceContext& context() const { return context_; }
  [[nodiscard]] const fg::vk::PhysicalDevice& physical() const { return physical_; }

 private:
  explicit HostDevice(const WalrDevice& device);

  std::optional<VkAllocationCallbacks> allocator_;
  std::optional<HostMemory> memory_;
  fg::vk::DeviceContext context_;
  fg::vk::PhysicalDevice physical_;
  bool withoutTimelineSemaphores_ = false;  ///< Known from WalrDevice::create_info.
};

/// Whether to measure GPU times: if the host asks for them and the queue family has timestamps. Without timestamps the
/// host gets a warning and no error, because everything else works.
bool measuresTimes(const WalrDenoiserInfo& info, const HostDevice& device);

}  // namespace walr::api
