#pragma once

#include <cstdint>
#include <vector>

#include "framegraph/vulkan/barriers.h"

/// Fills resources outside of any pass: invalid histories with zeros, poisoned memory with NaNs.
namespace fg::vk {

enum class FillPattern : std::uint8_t {
  Zero,
  /// Float channels are NaN. Integer channels have all bits set. Normalised channels, which cannot hold a NaN, have
  /// their largest value. Buffers have all bits set, which is a NaN as float and as half.
  Poison,
};

/// A batch of planned barriers in which some resources are filled. It replaces the planned batch.
///
/// The barrier of a filled resource is split in two, one before and one after the fill command, so that the dependency
/// chain into the pass stays complete.
class FillingBatch {
 public:
  FillingBatch() = default;
  /// @param barriers the planned batch
  /// @param filled indexed like `barriers`: whether to fill the resource of this barrier
  FillingBatch(const GraphDesc& graph, const std::vector<PlannedBarrier>& barriers, const std::vector<bool>& filled,
               FillPattern pattern);

  void record(const DeviceContext& device, VkCommandBuffer commandBuffer, const Resources& resources, FrameIndex frame);

 private:
  struct Target {
    std::uint32_t resource = kNone;
    bool isTexture = false;
    VkImageSubresourceRange range{};
  };
  void fill(const DeviceContext& device, VkCommandBuffer commandBuffer, const Target& target,
            const Resources& resources, FrameIndex frame) const;

  FillPattern pattern_ = FillPattern::Zero;
  BarrierBatch before_;
  std::vector<Target> targets_;
  BarrierBatch after_;
};

/// Clears a history's `previous` before a frame without a valid previous frame. Leaves it in the state in which the
/// plan expects last frame's contents.
FillingBatch historyClear(const GraphDesc& graph, const Plan& plan, std::uint32_t history);

/// The planned barriers without any fill.
FillingBatch plainBarriers(const GraphDesc& graph, const std::vector<PlannedBarrier>& barriers);

/// The barriers of a planned pass, with every transient that is first used there filled with poison.
FillingBatch poisonedBarriers(const GraphDesc& graph, const PlannedPass& pass);

}  // namespace fg::vk
