#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "framegraph/vulkan/fill.h"

namespace fg::vk {

/// How much lies behind a history.
struct HistoryStatus {
  bool valid = false;     ///< Whether `previous` holds the last frame; it holds zeros otherwise.
  std::uint32_t age = 0;  ///< Frames behind `previous` without a reset.
};

/// Ages of all histories, and the clearing of those that have none.
class HistoryStates {
 public:
  HistoryStates(const GraphDesc& graph, const Plan& plan);

  [[nodiscard]] HistoryStatus status(std::uint32_t history) const { return {ages_[history] != 0, ages_[history]}; }
  void reset(std::uint32_t history) { ages_[history] = 0; }
  void resetAll();
  /// Say that a history goes on from another executor's.
  void inherit(std::uint32_t history, std::uint32_t age) { ages_[history] = age; }
  /// Clear `previous` of every history without a valid frame behind it.
  void recordClears(const DeviceContext& device, VkCommandBuffer commandBuffer, const Resources& resources,
                    FrameIndex frame);
  /// Say that a frame was recorded.
  void advance();

 private:
  std::vector<std::uint32_t> ages_;
  std::vector<bool> written_;  ///< Whether the plan writes `current`.
  std::vector<FillingBatch> clears_;
};

}  // namespace fg::vk
