#pragma once

#include <cstdint>
#include <vector>

#include "framegraph/vulkan/owned.h"

namespace fg::vk {

/// A sampler that clamps to the edge.
Owned<VkSampler> makeSampler(const DeviceContext& device, VkFilter filter);

/// Copies of one descriptor set per pass, for frames that are on the GPU at once.
class DescriptorSets {
 public:
  /// @param layouts by pass; null for passes without a set
  /// @param types   of all bindings of all layouts
  DescriptorSets(const DeviceContext& device, const std::vector<VkDescriptorSetLayout>& layouts,
                 const std::vector<VkDescriptorType>& types, std::uint32_t copies);

  /// Null for a pass without a set.
  [[nodiscard]] VkDescriptorSet get(std::size_t pass, std::size_t copy) const {
    return sets_[copy * passCount_ + pass];
  }

 private:
  std::size_t passCount_;
  Owned<VkDescriptorPool> pool_;
  std::vector<VkDescriptorSet> sets_;  ///< By copy and pass.
};

}  // namespace fg::vk
