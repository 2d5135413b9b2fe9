#include "framegraph/verify/verify_rules.h"

namespace fg::check {

Use useOf(Access access, bool texture) {
  constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  constexpr VkPipelineStageFlags2 kFragment = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
  constexpr VkPipelineStageFlags2 kTransfer = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
  constexpr VkPipelineStageFlags2 kColor = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
  constexpr VkPipelineStageFlags2 kTests =
      VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
  constexpr VkAccessFlags2 kNo = VK_ACCESS_2_NONE;
  constexpr VkAccessFlags2 kSampled = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
  constexpr VkAccessFlags2 kLoad = VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
  constexpr VkAccessFlags2 kStore = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
  constexpr VkAccessFlags2 kColorRead = VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT;
  constexpr VkAccessFlags2 kColorWrite = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
  constexpr VkAccessFlags2 kDepthRead = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT;
  constexpr VkAccessFlags2 kDepthWrite = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
  constexpr VkFlags kColorUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
  constexpr VkFlags kDepthUsage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;

  const auto in = [&](VkImageLayout layout) { return texture ? layout : VK_IMAGE_LAYOUT_UNDEFINED; };
  const VkImageLayout readOnly = in(VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  const VkImageLayout general = in(VK_IMAGE_LAYOUT_GENERAL);
  const VkImageLayout color = in(VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
  const VkImageLayout depth = in(VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL);
  const auto usage = [&](VkFlags image, VkFlags buffer) { return texture ? image : buffer; };
  const VkFlags storage = usage(VK_IMAGE_USAGE_STORAGE_BIT, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  switch (access) {
    case Access::SampledRead:
      return {kCompute, kSampled, kNo, readOnly, VK_IMAGE_USAGE_SAMPLED_BIT};
    case Access::FragmentSampledRead:
      return {kFragment, kSampled, kNo, readOnly, VK_IMAGE_USAGE_SAMPLED_BIT};
    case Access::StorageRead:
      return {kCompute, kLoad, kNo, general, storage};
    case Access::StorageWrite:
      return {kCompute, kNo, kStore, general, storage};
    case Access::StorageReadWrite:
      return {kCompute, kLoad, kStore, general, storage};
    case Access::UniformRead:
      return {kCompute, VK_ACCESS_2_UNIFORM_READ_BIT, kNo, in({}), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT};
    case Access::IndirectRead:
      return {VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT, kNo, in({}),
              VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT};
    case Access::TransferRead:
      return {kTransfer, VK_ACCESS_2_TRANSFER_READ_BIT, kNo, in(VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL),
              usage(VK_IMAGE_USAGE_TRANSFER_SRC_BIT, VK_BUFFER_USAGE_TRANSFER_SRC_BIT)};
    case Access::TransferWrite:
      return {kTransfer, kNo, VK_ACCESS_2_TRANSFER_WRITE_BIT, in(VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL),
              usage(VK_IMAGE_USAGE_TRANSFER_DST_BIT, VK_BUFFER_USAGE_TRANSFER_DST_BIT)};
    case Access::ColorWrite:
      return {kColor, kNo, kColorWrite, color, kColorUsage};
    case Access::ColorReadWrite:
      return {kColor, kColorRead, kColorWrite, color, kColorUsage};
    case Access::DepthWrite:
      return {kTests, kNo, kDepthWrite, depth, kDepthUsage};
    case Access::DepthReadWrite:
      return {kTests, kDepthRead, kDepthWrite, depth, kDepthUsage};
    case Access::DepthRead:
      return {kTests, kDepthRead, kNo, in(VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL), kDepthUsage};
    case Access::VertexRead:
      return {VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT, VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT, kNo, in({}),
              VK_BUFFER_USAGE_VERTEX_BUFFER_BIT};
    case Access::IndexRead:
      return {VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT, VK_ACCESS_2_INDEX_READ_BIT, kNo, in({}),
              VK_BUFFER_USAGE_INDEX_BUFFER_BIT};
  }
  return {};
}

VkImageUsageFlags usageInLayout(VkImageLayout layout) {
  switch (layout) {
    case VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL:
      return VK_IMAGE_USAGE_SAMPLED_BIT;
    case VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL:
      return VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    case VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL:
      return VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    case VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL:
      return VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    case VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL:
    case VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL:
      return VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    default:
      return 0;
  }
}

VkPipelineStageFlags2 expanded(VkPipelineStageFlags2 stages) {
  constexpr VkPipelineStageFlags2 kTransfers = VK_PIPELINE_STAGE_2_COPY_BIT | VK_PIPELINE_STAGE_2_BLIT_BIT |
                                               VK_PIPELINE_STAGE_2_RESOLVE_BIT | VK_PIPELINE_STAGE_2_CLEAR_BIT;
  const bool all = (stages & VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT) != 0;
  return all ? (stages & ~VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT) | kTransfers : stages;
}

VkAccessFlags2 writesOf(VkAccessFlags2 accesses) {
  return accesses &
         (VK_ACCESS_2_SHADER_WRITE_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT |
          VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT | VK_ACCESS_2_HOST_WRITE_BIT |
          VK_ACCESS_2_MEMORY_WRITE_BIT | VK_ACCESS_2_ACCELERATION_STRUCTURE_WRITE_BIT_KHR);
}

}  // namespace fg::check
