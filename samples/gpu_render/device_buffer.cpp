#include "samples/gpu_render/device_buffer.h"

#include <algorithm>

#include "framegraph/vulkan/error.h"
#include "framegraph/vulkan/image.h"

namespace walr::gpu_render {
namespace {

constexpr std::uint64_t kLeastSize = 16;

std::uint32_t memoryType(const fg::vk::DeviceContext& device, std::uint32_t allowed, VkMemoryPropertyFlags wanted,
                         const std::string& name) {
  for (std::uint32_t i = 0; i < device.memory.memoryTypeCount; ++i) {
    const bool suits = (device.memory.memoryTypes[i].propertyFlags & wanted) == wanted;
    if ((allowed >> i & 1U) != 0 && suits) return i;
  }
  throw fg::vk::Unsupported("no memory type of the device suits the buffer '" + name + "'");
}

}  // namespace

DeviceBuffer::DeviceBuffer(const fg::vk::DeviceContext& device, const RayFunctions& functions, std::uint64_t size,
                           VkBufferUsageFlags usage, Placement placement, const std::string& name)
    : device_(&device),
      buffer_(fg::vk::createBuffer(device, {.size = std::max(size, kLeastSize)},
                                   usage | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT, name)),
      size_(std::max(size, kLeastSize)) {
  VkMemoryRequirements requirements{};
  device.functions.vkGetBufferMemoryRequirements(device.view.device, buffer_.get(), &requirements);
  VkMemoryAllocateFlagsInfo flags{};
  flags.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO;
  flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
  VkMemoryAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  info.pNext = &flags;
  info.allocationSize = requirements.size;
  const VkMemoryPropertyFlags wanted = placement == Placement::Staging
                                           ? VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT
                                           : VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
  info.memoryTypeIndex = memoryType(device, requirements.memoryTypeBits, wanted, name);
  fg::vk::check(device.functions.vkAllocateMemory(device.view.device, &info, device.view.allocator, &memory_),
                "allocating " + std::to_string(requirements.size >> 20U) + " MiB for '" + name + "'");
  fg::vk::check(device.functions.vkBindBufferMemory(device.view.device, buffer_.get(), memory_, 0),
                "binding the memory of '" + name + "'");
  if (placement == Placement::Staging) {
    void* mapped = nullptr;
    fg::vk::check(device.functions.vkMapMemory(device.view.device, memory_, 0, VK_WHOLE_SIZE, 0, &mapped),
                  "mapping '" + name + "'");
    mapped_ = static_cast<std::byte*>(mapped);
  }
  VkBufferDeviceAddressInfo addressInfo{};
  addressInfo.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO;
  addressInfo.buffer = buffer_.get();
  address_ = functions.vkGetBufferDeviceAddress(device.view.device, &addressInfo);
}

DeviceBuffer::~DeviceBuffer() {
  if (memory_ == VK_NULL_HANDLE) return;
  buffer_ = {};  // Before its memory.
  device_->functions.vkFreeMemory(device_->view.device, memory_, device_->view.allocator);
}

void DeviceBuffer::swap(DeviceBuffer& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(buffer_, other.buffer_);
  std::swap(memory_, other.memory_);
  std::swap(address_, other.address_);
  std::swap(size_, other.size_);
  std::swap(mapped_, other.mapped_);
}

}  // namespace walr::gpu_render
