#include "tests/integration/random_device.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <new>

#include <vulkan/vulkan.h>

namespace walr::test {
namespace {

/// An allocator of processor memory. A block that it gives does not begin where malloc's does, so that freeing one with
/// another allocator is noticed.
constexpr std::size_t kBefore = 64;  // At least any alignment that Vulkan asks for in practice.

void* allocate(void* /*user*/, std::size_t size, std::size_t /*alignment*/, VkSystemAllocationScope /*scope*/) {
  auto* const start = static_cast<std::byte*>(::operator new (kBefore + size, std::align_val_t{kBefore}, std::nothrow));
  if (start == nullptr) return nullptr;
  std::memcpy(start, &size, sizeof(size));
  return start + kBefore;
}

void release(void* /*user*/, void* block) {
  if (block != nullptr) ::operator delete (static_cast<std::byte*>(block) - kBefore, std::align_val_t{kBefore});
}

void* reallocate(void* user, void* block, std::size_t size, std::size_t alignment, VkSystemAllocationScope scope) {
  void* const moved = size == 0 ? nullptr : allocate(user, size, alignment, scope);
  if (block == nullptr || (size > 0 && moved == nullptr)) return moved;
  if (moved != nullptr) {
    std::size_t before = 0;
    std::memcpy(&before, static_cast<std::byte*>(block) - kBefore, sizeof(before));
    std::memcpy(moved, block, std::min(before, size));
  }
  release(user, block);
  return moved;
}

constexpr VkAllocationCallbacks kAllocator = {.pUserData = nullptr,
                                              .pfnAllocation = allocate,
                                              .pfnReallocation = reallocate,
                                              .pfnFree = release,
                                              .pfnInternalAllocation = nullptr,
                                              .pfnInternalFree = nullptr};

}  // namespace

std::uint32_t RandomMemory::typeFor(const WalrMemoryRequest& request) const {
  VkPhysicalDeviceMemoryProperties properties;
  vkGetPhysicalDeviceMemoryProperties(device_->physical_device, &properties);
  for (std::uint32_t type = 0; type < properties.memoryTypeCount; ++type) {
    const bool allowed = (request.memory_type_bits >> type & 1U) != 0;
    if (allowed && (properties.memoryTypes[type].propertyFlags & request.required) == request.required) return type;
  }
  return VK_MAX_MEMORY_TYPES;
}

VkResult RandomMemory::take(void* user, const WalrMemoryRequest* request, WalrMemoryBlock* block) {
  auto& self = *static_cast<RandomMemory*>(user);
  const std::uint32_t type = self.typeFor(*request);
  if (type == VK_MAX_MEMORY_TYPES || self.dice_.oneIn(20)) {
    return self.dice_.of({VK_ERROR_OUT_OF_DEVICE_MEMORY, VK_ERROR_OUT_OF_HOST_MEMORY, VK_ERROR_TOO_MANY_OBJECTS});
  }
  VkMemoryAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  info.allocationSize = request->size;
  info.memoryTypeIndex = type;
  const VkResult allocated = vkAllocateMemory(self.device_->device, &info, nullptr, &block->memory);
  if (allocated != VK_SUCCESS) return allocated;
  if ((request->required & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0 &&
      vkMapMemory(self.device_->device, block->memory, 0, VK_WHOLE_SIZE, 0, &block->mapped) != VK_SUCCESS) {
    vkFreeMemory(self.device_->device, block->memory, nullptr);
    return VK_ERROR_MEMORY_MAP_FAILED;
  }
  block->token = &self;
  self.mapped_[block->memory] = block->mapped;
  return VK_SUCCESS;
}

void RandomMemory::give(void* user, const WalrMemoryBlock* block) {
  auto& self = *static_cast<RandomMemory*>(user);
  const auto known = self.mapped_.find(block->memory);
  if (known == self.mapped_.end() || known->second != block->mapped || block->token != user) {
    ++self.wronglyFreed_;
    return;
  }
  self.mapped_.erase(known);
  vkFreeMemory(self.device_->device, block->memory, nullptr);
}

RandomDevice::RandomDevice(Dice& dice, Expectation& expected, const RandomHost& host) {
  if (host.device == nullptr) {
    chooseSize(dice, expected, device_);
    expected.fails();  // All of its members are null.
    return;
  }
  device_.value = *host.device;
  if (dice.oneIn(2)) device_.value.create_info = host.createInfo;
  if (dice.oneIn(4)) device_.value.allocator = &kAllocator;
  if (host.memory != nullptr && dice.oneIn(3)) {
    memory_.value = host.memory->callbacks();
    device_.value.device_memory = &memory_.value;
    expected.mayRunOutOfMemory();
    if (!host.givesRightDevices) chooseSize(dice, expected, memory_);
  }
  if (!host.givesRightDevices && dice.oneIn(16)) spoil(dice, expected);
}

void RandomDevice::spoil(Dice& dice, Expectation& expected) {
  switch (dice.below(8)) {
    case 0:
      chooseSize(dice, expected, device_);
      return;
    case 1:
      device_.value.instance = VK_NULL_HANDLE;
      break;
    case 2:
      device_.value.physical_device = VK_NULL_HANDLE;
      break;
    case 3:
      device_.value.device = VK_NULL_HANDLE;
      break;
    case 4:
      device_.value.get_instance_proc_addr = nullptr;
      break;
    case 5:
      device_.value.queue_family = dice.of({77U, 0xffffffffU});
      expected.fails(WALR_ERROR_UNSUPPORTED);
      return;
    case 6:
      device_.value.device_memory = &memory_.value;
      memory_.value.struct_size = sizeof(WalrMemoryCallbacks);
      if (dice.oneIn(2)) {
        memory_.value.allocate = nullptr;
      } else {
        memory_.value.free = nullptr;
      }
      break;
    default:
      withoutFeatures_.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
      device_.value.create_info = &withoutFeatures_;
      expected.fails(WALR_ERROR_UNSUPPORTED);
      return;
  }
  expected.fails(WALR_ERROR_INVALID_ARGUMENT);
}

}  // namespace walr::test
