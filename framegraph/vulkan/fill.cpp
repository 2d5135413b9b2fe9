#include "framegraph/vulkan/fill.h"

#include "framegraph/vulkan/image.h"

namespace fg::vk {
namespace {

constexpr std::uint32_t kAllOnes = ~0u;

// For vkCmdFillBuffer the specification names the clear stage, but some validation layers expect the copy stage.
constexpr VkPipelineStageFlags2 kFillStage = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;

VkClearColorValue clearColor(FillPattern pattern) {
  VkClearColorValue color{};
  if (pattern == FillPattern::Zero) return color;
  // All bits set is a quiet NaN in float formats, the largest value in unsigned and -1 in signed integer formats.
  for (std::uint32_t& channel : color.uint32) channel = kAllOnes;
  return color;
}

}  // namespace

FillingBatch::FillingBatch(const GraphDesc& graph, const std::vector<PlannedBarrier>& barriers,
                           const std::vector<bool>& filled, FillPattern pattern)
    : pattern_(pattern) {
  std::vector<PlannedBarrier> before = barriers;
  std::vector<PlannedBarrier> after;
  for (std::size_t i = 0; i < barriers.size(); ++i) {
    if (!filled[i]) continue;
    before[i].dstStage = kFillStage;
    before[i].dstAccess = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    before[i].newLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    PlannedBarrier& second = after.emplace_back(barriers[i]);
    second.reason = BarrierReason::WriteAfterWrite;
    second.srcStage = kFillStage;
    second.srcAccess = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    second.oldLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    Target& target = targets_.emplace_back();
    target.resource = barriers[i].resource;
    if (const auto* texture = std::get_if<TextureDesc>(&graph.resources[target.resource].desc)) {
      target.isTexture = true;
      target.range = subresourceRange(texture->format, barriers[i].range);
    }
  }
  before_ = BarrierBatch(graph, before);
  after_ = BarrierBatch(graph, after);
}

void FillingBatch::record(const DeviceContext& device, VkCommandBuffer commandBuffer, const Resources& resources,
                          FrameIndex frame) {
  before_.record(device, commandBuffer, resources, frame);
  for (const Target& target : targets_) fill(device, commandBuffer, target, resources, frame);
  after_.record(device, commandBuffer, resources, frame);
}

void FillingBatch::fill(const DeviceContext& device, VkCommandBuffer commandBuffer, const Target& target,
                        const Resources& resources, FrameIndex frame) const {
  const DeviceFunctions& functions = device.functions;
  constexpr VkImageLayout kLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
  if (!target.isTexture) {
    functions.vkCmdFillBuffer(commandBuffer, resources.buffer(target.resource, frame), 0, VK_WHOLE_SIZE,
                              pattern_ == FillPattern::Poison ? kAllOnes : 0);
    return;
  }
  const VkImage image = resources.image(target.resource, frame);
  if (target.range.aspectMask == VK_IMAGE_ASPECT_COLOR_BIT) {
    const VkClearColorValue color = clearColor(pattern_);
    functions.vkCmdClearColorImage(commandBuffer, image, kLayout, &color, 1, &target.range);
  } else {
    // Depth cannot be NaN without VK_EXT_depth_range_unrestricted: use the far plane and an unusual stencil instead.
    const VkClearDepthStencilValue value =
        pattern_ == FillPattern::Poison ? VkClearDepthStencilValue{1.0f, 0xffu} : VkClearDepthStencilValue{0.0f, 0};
    functions.vkCmdClearDepthStencilImage(commandBuffer, image, kLayout, &value, 1, &target.range);
  }
}

FillingBatch historyClear(const GraphDesc& graph, const Plan& plan, std::uint32_t history) {
  const std::uint32_t previous = graph.histories[history].previous;
  if (!plan.resources[previous].used) return {};
  // Starts from the state in which a frame leaves the history, discards the contents, and returns to the same state.
  const ExternalState& carry = plan.histories[history].carry;
  PlannedBarrier clear;
  clear.resource = previous;
  clear.reason = BarrierReason::HistoryCarry;
  clear.srcStage = carry.stage;
  clear.srcAccess = carry.access;
  clear.dstStage = carry.stage;
  clear.dstAccess = carry.access;
  clear.newLayout = carry.layout;
  return {graph, {clear}, {true}, FillPattern::Zero};
}

FillingBatch plainBarriers(const GraphDesc& graph, const std::vector<PlannedBarrier>& barriers) {
  return {graph, barriers, std::vector<bool>(barriers.size(), false), FillPattern::Zero};
}

FillingBatch poisonedBarriers(const GraphDesc& graph, const PlannedPass& pass) {
  std::vector<bool> filled;
  for (const PlannedBarrier& barrier : pass.barriers) {
    const bool begins = barrier.reason == BarrierReason::FirstUse || barrier.reason == BarrierReason::AliasHandOver;
    filled.push_back(begins && graph.resources[barrier.resource].lifetime == Lifetime::Transient);
  }
  return {graph, pass.barriers, filled, FillPattern::Poison};
}

}  // namespace fg::vk
