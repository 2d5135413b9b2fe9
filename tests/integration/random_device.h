#pragma once

#include <cstdint>
#include <map>

#include <walr/walr.h>

#include "tests/integration/call_check.h"
#include "tests/integration/random_structs.h"

namespace walr::test {

/// Device memory of a host's own allocator, which fails now and then.
class RandomMemory {
 public:
  /// @param device must outlive the object
  RandomMemory(const WalrDevice& device, std::uint64_t seed) : device_(&device), dice_(seed) {}

  [[nodiscard]] WalrMemoryCallbacks callbacks() {
    return {.struct_size = sizeof(WalrMemoryCallbacks), .reserved = 0, .user = this, .allocate = take, .free = give};
  }
  /// Blocks that are not freed yet.
  [[nodiscard]] std::size_t blocks() const { return mapped_.size(); }
  /// Blocks that were freed twice or never allocated.
  [[nodiscard]] std::size_t wronglyFreed() const { return wronglyFreed_; }

 private:
  static VkResult take(void* user, const WalrMemoryRequest* request, WalrMemoryBlock* block);
  static void give(void* user, const WalrMemoryBlock* block);
  [[nodiscard]] std::uint32_t typeFor(const WalrMemoryRequest& request) const;

  const WalrDevice* device_;
  Dice dice_;
  std::map<VkDeviceMemory, void*> mapped_;
  std::size_t wronglyFreed_ = 0;
};

/// What random sequences of calls have of Vulkan. All is null without a device.
struct RandomHost {
  const WalrDevice* device = nullptr;
  const VkDeviceCreateInfo* createInfo = nullptr;
  VkPipelineCache pipelineCache = VK_NULL_HANDLE;
  RandomMemory* memory = nullptr;
  bool givesRightDevices = false;  ///< No WalrDevice is wrong.
};

/// A WalrDevice, mostly a right one if the host has a device.
class RandomDevice {
 public:
  RandomDevice(Dice& dice, Expectation& expected, const RandomHost& host);
  RandomDevice(const RandomDevice&) = delete;
  RandomDevice& operator=(const RandomDevice&) = delete;

  [[nodiscard]] const WalrDevice* get() const { return &device_.value; }

 private:
  void spoil(Dice& dice, Expectation& expected);

  Grown<WalrDevice> device_;
  Grown<WalrMemoryCallbacks> memory_;
  VkDeviceCreateInfo withoutFeatures_{};
};

}  // namespace walr::test
