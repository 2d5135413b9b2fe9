#include "integration/c_api/host_memory.h"

#include <string>

#include "framegraph/vulkan/error.h"
#include "integration/c_api/structs.h"

namespace walr::api {
namespace {

/// What is wrong with a block; null if nothing is.
const char* faultOf(const WalrMemoryBlock& block, const fg::vk::MemoryRequest& request) {
  if (block.memory == VK_NULL_HANDLE) return "WalrMemoryBlock::memory is null";
  if (block.offset % request.alignment != 0) {
    return "WalrMemoryBlock::offset is no multiple of WalrMemoryRequest::alignment";
  }
  const bool visible = (request.required & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0;
  if (visible && block.mapped == nullptr) {
    return "WalrMemoryBlock::mapped is null although WalrMemoryRequest::required has HOST_VISIBLE";
  }
  return nullptr;
}

}  // namespace

HostMemory::HostMemory(const WalrMemoryCallbacks& callbacks)
    : callbacks_(readStruct(&callbacks, "WalrMemoryCallbacks")) {
  if (callbacks_.allocate == nullptr || callbacks_.free == nullptr) {
    throw Error(WALR_ERROR_INVALID_ARGUMENT, std::string("WalrMemoryCallbacks::") +
                                                 (callbacks_.allocate == nullptr ? "allocate" : "free") + " is null");
  }
}

fg::vk::MemoryBlock HostMemory::allocate(const fg::vk::MemoryRequest& request) {
  const WalrMemoryRequest wanted{.struct_size = sizeof(WalrMemoryRequest),
                                 .memory_type_bits = request.memoryTypeBits,
                                 .size = request.size,
                                 .alignment = request.alignment,
                                 .required = request.required,
                                 .preferred = request.preferred,
                                 .user = request.user};
  const std::string action =
      "WalrMemoryCallbacks::allocate, " + std::to_string(request.size) + " bytes for " + request.user + ": ";
  WalrMemoryBlock block{};
  const VkResult result = callbacks_.allocate(callbacks_.user, &wanted, &block);
  if (result != VK_SUCCESS) {
    throw Error(WALR_ERROR_OUT_OF_MEMORY, action + fg::vk::resultName(result) + "; try a smaller size");
  }
  if (const char* fault = faultOf(block, request); fault != nullptr) {
    if (block.memory != VK_NULL_HANDLE) callbacks_.free(callbacks_.user, &block);
    throw Error(WALR_ERROR_INVALID_ARGUMENT, action + fault);
  }
  return {.memory = block.memory,
          .offset = block.offset,
          .mapped = static_cast<std::byte*>(block.mapped),
          .token = block.token};
}

void HostMemory::free(const fg::vk::MemoryBlock& block) noexcept {
  const WalrMemoryBlock freed{
      .memory = block.memory, .offset = block.offset, .mapped = block.mapped, .token = block.token};
  callbacks_.free(callbacks_.user, &freed);
}

}  // namespace walr::api
