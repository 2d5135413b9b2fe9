#pragma once

#include <cstdint>
#include <vector>

#include "framegraph/vulkan/fill.h"

namespace fg::vk {

/// Whether a history holds frames, and how many.
struct HistoryStatus {
  bool valid = false;     ///< Whether `previous` holds the last frame; it holds zeros otherwise.
  std::uint32_t age = 0;  ///< Number of frames since the last reset.
};

/// Keeps the ages of all histories and clears those of age 0.
class HistoryStates {
 public:
  HistoryStates(const GraphDesc& graph, const Plan& plan);

  [[nodiscard]] HistoryStatus status(std::uint32_t history) const { return {ages_[history] != 0, ages_[history]}; }
  void reset(std::uint32_t history) { ages_[history] = 0; }
  void resetAll();
  /// Set the age of a history that is inherited from another executor.
  void inherit(std::uint32_t history, std::uint32_t age) { ages_[history] = age; }
  /// Clear `previous` of every history of age 0.
  void recordClears(const DeviceContext& device, VkCommandBuffer commandBuffer, const Resources& resources,
                    FrameIndex frame);
  /// Note that a frame was recorded.
  void advance();

 private:
  std::vector<std::uint32_t> ages_;
  std::vector<bool> written_;  ///< Whether the plan writes `current`.
  std::vector<FillingBatch> clears_;
};

}  // namespace fg::vk
