#pragma once

#include <walr/walr.h>

#include "framegraph/vulkan/memory_source.h"

namespace walr::api {

/// Device memory from a host's allocator.
class HostMemory final : public fg::vk::MemorySource {
 public:
  /// @throws Error naming a callback that is null
  explicit HostMemory(const WalrMemoryCallbacks& callbacks);

  /// @throws Error if the callback fails, or naming what is wrong with its block
  fg::vk::MemoryBlock allocate(const fg::vk::MemoryRequest& request) override;
  void free(const fg::vk::MemoryBlock& block) noexcept override;

 private:
  WalrMemoryCallbacks callbacks_;
};

}  // namespace walr::api
