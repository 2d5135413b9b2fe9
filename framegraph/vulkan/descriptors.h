#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "framegraph/plan/plan.h"
#include "framegraph/vulkan/descriptor_sets.h"
#include "framegraph/vulkan/pipelines.h"
#include "framegraph/vulkan/views.h"

namespace fg::vk {

/// One descriptor set per compute pass, frame slot and history parity, all created before the first frame. Afterwards
/// only descriptors of images that may change, such as imports, are rewritten, and only if an image has changed since
/// the last frame with the same sets.
class Descriptors {
 public:
  /// @param setLayouts by position in `plan.passes`; null for callback passes
  /// @param historiesChange whether images of previous histories may change
  Descriptors(const DeviceContext& device, const GraphDesc& graph, const Plan& plan, const Resources& resources,
              Views& views, const std::vector<VkDescriptorSetLayout>& setLayouts, std::uint32_t slots,
              bool historiesChange);

  /// Note that an image has changed.
  void invalidateImages() { ++epoch_; }
  /// Bring a frame's sets up to date.
  void update(FrameIndex frame);
  [[nodiscard]] VkDescriptorSet set(std::size_t plannedPass, FrameIndex frame) const {
    return sets_->get(plannedPass, index(frame));
  }

 private:
  struct Write {
    std::size_t pass = 0;
    std::uint32_t binding = 0;
    VkDescriptorType type{};
    std::uint32_t resource = kNone;
    std::uint32_t view = kNone;  ///< kNone for buffers.
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkSampler sampler = VK_NULL_HANDLE;
    std::uint64_t size = 0;
  };
  [[nodiscard]] static std::size_t index(FrameIndex frame) { return frame.slot * kParities + frame.parity; }
  void collectWrites(const GraphDesc& graph, std::size_t plannedPass, const PassDecl& pass, Views& views,
                     bool historiesChange);
  void write(const std::vector<Write>& writes, FrameIndex frame);

  const DeviceContext* device_;
  const Resources* resources_;
  const Views* views_;
  Owned<VkSampler> nearest_;
  Owned<VkSampler> linear_;
  std::optional<DescriptorSets> sets_;  ///< Created after all writes are collected.
  std::vector<Write> lasting_;
  std::vector<Write> changing_;
  std::uint64_t epoch_ = 1;
  std::vector<std::uint64_t> writtenEpoch_;  ///< By frame index.
  std::vector<VkWriteDescriptorSet> vulkanWrites_;
  std::vector<VkDescriptorImageInfo> imageInfos_;
  std::vector<VkDescriptorBufferInfo> bufferInfos_;
};

}  // namespace fg::vk
