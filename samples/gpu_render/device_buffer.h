#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "framegraph/vulkan/device_context.h"
#include "framegraph/vulkan/owned.h"
#include "samples/gpu_render/ray_functions.h"

namespace walr::gpu_render {

/// Where the bytes of a buffer lie.
enum class Placement : std::uint8_t {
  Device,   ///< In memory of the device, which the host cannot write.
  Staging,  ///< In memory that the host writes.
};

/// A buffer with memory of its own and with a device address. The memory of the frame graph has no addresses.
class DeviceBuffer {
 public:
  DeviceBuffer() = default;
  /// @param size  bytes; at least 16 are allocated, so that a descriptor of an empty array is valid
  /// @throws fg::vk::OutOfMemory naming the buffer
  DeviceBuffer(const fg::vk::DeviceContext& device, const RayFunctions& functions, std::uint64_t size,
               VkBufferUsageFlags usage, Placement placement, const std::string& name);
  DeviceBuffer(DeviceBuffer&& other) noexcept { swap(other); }
  DeviceBuffer& operator=(DeviceBuffer&& other) noexcept {
    swap(other);
    return *this;
  }
  DeviceBuffer(const DeviceBuffer&) = delete;
  DeviceBuffer& operator=(const DeviceBuffer&) = delete;
  ~DeviceBuffer();

  [[nodiscard]] VkBuffer handle() const { return buffer_.get(); }
  [[nodiscard]] VkDeviceAddress address() const { return address_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// The bytes of a staging buffer.
  [[nodiscard]] std::byte* mapped() const { return mapped_; }

 private:
  void swap(DeviceBuffer& other) noexcept;

  const fg::vk::DeviceContext* device_ = nullptr;
  fg::vk::Owned<VkBuffer> buffer_;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  VkDeviceAddress address_ = 0;
  std::uint64_t size_ = 0;
  std::byte* mapped_ = nullptr;
};

}  // namespace walr::gpu_render
