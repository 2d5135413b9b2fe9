#pragma once

#include <cstdint>
#include <vector>

#include "framegraph/vulkan/barriers.h"

/// Filling resources outside of any pass: histories with zeros, poisoned memory with NaNs.
namespace fg::vk {

/// What a resource is filled with.
enum class FillPattern : std::uint8_t {
  Zero,
  /// Every float a NaN; every integer channel all ones; every normalised channel its largest value, since those cannot
  /// hold a NaN. Buffers are all ones, which is a NaN as float and as half.
  Poison,
};

/// Take the place of a batch of planned barriers: the resources that come in with undefined contents go by way of a
/// fill command.
///
/// Their barriers are split in two around the fill, so that the dependency chain into the pass stays whole.
class FillingBatch {
 public:
  FillingBatch() = default;
  /// @param barriers the planned batch
  /// @param filled which of them to split, by position
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

/// Clearing of one history's `previous` before a frame that has no valid frame behind it. Leaves it in the state in
/// which the plan expects to find last frame's contents.
FillingBatch historyClear(const GraphDesc& graph, const Plan& plan, std::uint32_t history);

/// Planned barriers as they are, nothing filled.
FillingBatch plainBarriers(const GraphDesc& graph, const std::vector<PlannedBarrier>& barriers);

/// A planned pass's barriers with poison written into every transient that begins its life there.
FillingBatch poisonedBarriers(const GraphDesc& graph, const PlannedPass& pass);

}  // namespace fg::vk
