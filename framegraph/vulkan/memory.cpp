#include "framegraph/vulkan/memory.h"

#include <algorithm>

namespace fg::vk {
namespace {

constexpr std::uint64_t alignUp(std::uint64_t value, std::uint64_t alignment) {
  return (value + alignment - 1) / alignment * alignment;
}

MemoryRequirements fromVulkan(const VkMemoryRequirements& requirements) {
  return {requirements.size, requirements.alignment, requirements.memoryTypeBits};
}

}  // namespace

Owned<VkDeviceMemory> allocateMemory(const DeviceContext& device, std::uint64_t size, std::uint32_t memoryTypeBits,
                                     VkMemoryPropertyFlags properties, const std::string& what) {
  for (std::uint32_t type = 0; type < device.memory.memoryTypeCount; ++type) {
    if ((memoryTypeBits >> type & 1u) == 0) continue;
    if ((device.memory.memoryTypes[type].propertyFlags & properties) != properties) continue;
    VkMemoryAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    info.allocationSize = size;
    info.memoryTypeIndex = type;
    auto memory = create<VkDeviceMemory>(device, device.functions.vkAllocateMemory, info,
                                         "allocating " + std::to_string(size) + " bytes for " + what);
    device.setName(VK_OBJECT_TYPE_DEVICE_MEMORY, memory.get(), what);
    return memory;
  }
  // Every device has a device-local memory type, but not every resource can use one.
  if ((properties & VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT) != 0) {
    return allocateMemory(device, size, memoryTypeBits, properties & ~VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, what);
  }
  throw Unsupported("no memory type of the device is suitable for " + what, VK_ERROR_FEATURE_NOT_PRESENT);
}

MemoryRequirements memoryRequirements(const DeviceContext& device, VkImage image) {
  VkMemoryRequirements requirements{};
  device.functions.vkGetImageMemoryRequirements(device.view.device, image, &requirements);
  return fromVulkan(requirements);
}

MemoryRequirements memoryRequirements(const DeviceContext& device, VkBuffer buffer) {
  VkMemoryRequirements requirements{};
  device.functions.vkGetBufferMemoryRequirements(device.view.device, buffer, &requirements);
  return fromVulkan(requirements);
}

void MemoryArena::add(VkImage image) {
  place(memoryRequirements(*device_, image), {.image = image});
}

void MemoryArena::add(VkBuffer buffer, std::byte** mapped) {
  place(memoryRequirements(*device_, buffer), {.buffer = buffer, .mapped = mapped});
}

void MemoryArena::place(const MemoryRequirements& requirements, Resident resident) {
  auto block = std::ranges::find(blocks_, requirements.memoryTypeBits, &Block::memoryTypeBits);
  if (block == blocks_.end()) {
    block = blocks_.emplace(blocks_.end());
    block->memoryTypeBits = requirements.memoryTypeBits;
  }
  const std::uint64_t granularity = device_->properties.limits.bufferImageGranularity;
  resident.block = static_cast<std::size_t>(block - blocks_.begin());
  resident.offset = alignUp(block->size, std::max(requirements.alignment, granularity));
  block->size = resident.offset + requirements.size;
  residents_.push_back(resident);
}

void MemoryArena::allocate() {
  const DeviceFunctions& functions = device_->functions;
  const VkDevice device = device_->view.device;
  for (Block& block : blocks_) {
    block.memory = allocateMemory(*device_, block.size, block.memoryTypeBits, properties_, name_);
    if ((properties_ & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) == 0) continue;
    void* mapped = nullptr;
    check(functions.vkMapMemory(device, block.memory.get(), 0, VK_WHOLE_SIZE, 0, &mapped), "mapping " + name_);
    block.mapped = static_cast<std::byte*>(mapped);
  }
  for (const Resident& resident : residents_) {
    const Block& block = blocks_[resident.block];
    const VkDeviceMemory memory = block.memory.get();
    check(resident.image != VK_NULL_HANDLE
              ? functions.vkBindImageMemory(device, resident.image, memory, resident.offset)
              : functions.vkBindBufferMemory(device, resident.buffer, memory, resident.offset),
          "binding memory of " + name_);
    if (resident.mapped != nullptr) *resident.mapped = block.mapped + resident.offset;
  }
}

std::uint64_t MemoryArena::size() const {
  std::uint64_t bytes = 0;
  for (const Block& block : blocks_) bytes += block.size;
  return bytes;
}

}  // namespace fg::vk
