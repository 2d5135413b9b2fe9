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

/// Device-local memory is a preference: every device has such a type, but not every resource can use one.
constexpr VkMemoryPropertyFlags kPreference = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;

constexpr std::uint32_t kNoType = ~0U;

/// The first memory type of a request that has the given properties; kNoType if there is none.
std::uint32_t memoryType(const DeviceContext& device, const MemoryRequest& request, VkMemoryPropertyFlags properties) {
  for (std::uint32_t type = 0; type < device.memory.memoryTypeCount; ++type) {
    const bool allowed = (request.memoryTypeBits >> type & 1U) != 0;
    if (allowed && (device.memory.memoryTypes[type].propertyFlags & properties) == properties) return type;
  }
  return kNoType;
}

}  // namespace

std::uint64_t blockBytes(const DeviceContext& device, std::uint64_t size) {
  return alignUp(size, device.properties.limits.bufferImageGranularity);
}

DeviceMemory::DeviceMemory(const DeviceContext& device, MemoryRequirements requirements,
                           VkMemoryPropertyFlags properties, const std::string& user)
    : size_(blockBytes(device, requirements.size)) {
  const MemoryRequest request{
      .size = size_,
      .alignment = std::max(requirements.alignment, device.properties.limits.bufferImageGranularity),
      .memoryTypeBits = requirements.memoryTypeBits,
      .required = properties & ~kPreference,
      .preferred = properties & kPreference,
      .user = user.c_str()};
  device_ = &device;
  if (device.view.memorySource != nullptr) {
    block_ = device.view.memorySource->allocate(request);
  } else {
    allocate(request);
  }
}

void DeviceMemory::allocate(const MemoryRequest& request) {
  const std::string user = request.user;
  const DeviceFunctions& functions = device_->functions;
  std::uint32_t type = memoryType(*device_, request, request.required | request.preferred);
  if (type == kNoType) type = memoryType(*device_, request, request.required);
  if (type == kNoType) {
    throw Unsupported("no memory type of the device is suitable for " + user, VK_ERROR_FEATURE_NOT_PRESENT);
  }
  VkMemoryAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  info.allocationSize = request.size;
  info.memoryTypeIndex = type;
  check(functions.vkAllocateMemory(device_->view.device, &info, device_->view.allocator, &block_.memory),
        "allocating " + std::to_string(request.size) + " bytes for " + user);
  device_->setName(VK_OBJECT_TYPE_DEVICE_MEMORY, block_.memory, user);
  if ((request.required & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) == 0) return;
  void* mapped = nullptr;
  const VkResult result = functions.vkMapMemory(device_->view.device, block_.memory, 0, VK_WHOLE_SIZE, 0, &mapped);
  if (result != VK_SUCCESS) functions.vkFreeMemory(device_->view.device, block_.memory, device_->view.allocator);
  check(result, "mapping " + user);
  block_.mapped = static_cast<std::byte*>(mapped);
}

DeviceMemory::~DeviceMemory() {
  if (device_ == nullptr) return;
  if (device_->view.memorySource != nullptr) {
    device_->view.memorySource->free(block_);
  } else {
    device_->functions.vkFreeMemory(device_->view.device, block_.memory, device_->view.allocator);
  }
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

ArenaLayout::Place ArenaLayout::add(const MemoryRequirements& requirements) {
  auto block = std::ranges::find(blocks_, requirements.memoryTypeBits, &MemoryRequirements::memoryTypeBits);
  if (block == blocks_.end()) {
    block = blocks_.insert(blocks_.end(), {.memoryTypeBits = requirements.memoryTypeBits});
  }
  const std::uint64_t granularity = device_->properties.limits.bufferImageGranularity;
  const std::uint64_t offset = alignUp(block->size, std::max(requirements.alignment, granularity));
  block->alignment = std::max(block->alignment, requirements.alignment);
  block->size = offset + requirements.size;
  return {static_cast<std::size_t>(block - blocks_.begin()), offset};
}

std::uint64_t ArenaLayout::bytes() const {
  std::uint64_t bytes = 0;
  for (const MemoryRequirements& block : blocks_) bytes += blockBytes(*device_, block.size);
  return bytes;
}

void MemoryArena::add(VkImage image) {
  residents_.push_back({.image = image, .place = layout_.add(memoryRequirements(*device_, image))});
}

void MemoryArena::add(VkBuffer buffer, std::byte** mapped) {
  residents_.push_back(
      {.buffer = buffer, .mapped = mapped, .place = layout_.add(memoryRequirements(*device_, buffer))});
}

void MemoryArena::allocate() {
  const DeviceFunctions& functions = device_->functions;
  const VkDevice device = device_->view.device;
  for (const MemoryRequirements& block : layout_.blocks()) blocks_.emplace_back(*device_, block, properties_, name_);
  for (const Resident& resident : residents_) {
    const DeviceMemory& block = blocks_[resident.place.block];
    const std::uint64_t offset = block.offset() + resident.place.offset;
    check(resident.image != VK_NULL_HANDLE
              ? functions.vkBindImageMemory(device, resident.image, block.handle(), offset)
              : functions.vkBindBufferMemory(device, resident.buffer, block.handle(), offset),
          "binding memory of " + name_);
    if (resident.mapped != nullptr) *resident.mapped = block.mapped() + resident.place.offset;
  }
}

}  // namespace fg::vk
