#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <walr/walr_passes.h>

#include "framegraph/vulkan/owned.h"

namespace walr::api {

/// GPU times of passes that a host records one at a time, in any order and into any command buffers.
class PassTimestamps {
 public:
  /// @param device with timestamps on its queue family
  /// @param list   must outlive the object
  PassTimestamps(const fg::vk::DeviceContext& device, const WalrPassList& list, std::uint32_t slots);

  /// Forget the times of the frame that used the slot before. The GPU must have finished it.
  void beginFrame(std::uint32_t slot);
  void beginPass(VkCommandBuffer commandBuffer, std::uint32_t slot, std::uint32_t pass);
  void endPass(VkCommandBuffer commandBuffer, std::uint32_t slot, std::uint32_t pass);
  /// Times of the frame last recorded with the slot, in the list's order, without passes that were not recorded. Empty
  /// if the GPU has not finished all of them.
  std::vector<WalrPassTime> read(std::uint32_t slot) const;

 private:
  void write(VkCommandBuffer commandBuffer, std::uint32_t slot, std::uint32_t query) const;

  const fg::vk::DeviceContext* device_;
  const WalrPassList* list_;
  std::vector<fg::vk::Owned<VkQueryPool>> pools_;
  std::vector<std::vector<bool>> recorded_;  ///< By slot and pass.
};

}  // namespace walr::api
