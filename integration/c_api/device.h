#pragma once

#include <optional>

#include <walr/walr.h>

#include "framegraph/vulkan/device_context.h"
#include "framegraph/vulkan/physical_device.h"

namespace walr::api {

/// The host's device, checked, with its functions.
class HostDevice {
 public:
  /// @throws Error or fg::vk::Unsupported naming what is null or missing
  explicit HostDevice(const WalrDevice* device);
  HostDevice(const HostDevice&) = delete;
  HostDevice& operator=(const HostDevice&) = delete;

  [[nodiscard]] const fg::vk::DeviceContext& context() const { return context_; }
  [[nodiscard]] const fg::vk::PhysicalDevice& physical() const { return physical_; }

 private:
  explicit HostDevice(const WalrDevice& device);

  std::optional<VkAllocationCallbacks> allocator_;
  fg::vk::DeviceContext context_;
  fg::vk::PhysicalDevice physical_;
};

}  // namespace walr::api
