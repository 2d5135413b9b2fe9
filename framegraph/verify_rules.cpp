#include "framegraph/verify_rules.h"

namespace fg::check {

Use useOf(Access access, bool texture) {
  const VkFlags storage = texture ? VkFlags{VK_IMAGE_USAGE_STORAGE_BIT} : VkFlags{VK_BUFFER_USAGE_STORAGE_BUFFER_BIT};
  constexpr VkPipelineStageFlags2 kTests =
      VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
  Use use;
  use.stage = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  switch (access) {
    case Access::SampledRead:
    case Access::FragmentSampledRead:
      if (access == Access::FragmentSampledRead) use.stage = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
      use.reads = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
      use.layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
      use.usage = VK_IMAGE_USAGE_SAMPLED_BIT;
      break;
    case Access::StorageRead:
    case Access::StorageWrite:
    case Access::StorageReadWrite:
      if (access != Access::StorageWrite) use.reads = VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
      if (access != Access::StorageRead) use.writes = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
      use.layout = VK_IMAGE_LAYOUT_GENERAL;
      use.usage = storage;
      break;
    case Access::UniformRead:
      use.reads = VK_ACCESS_2_UNIFORM_READ_BIT;
      use.usage = VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT;
      break;
    case Access::IndirectRead:
      use.stage = VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT;
      use.reads = VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT;
      use.usage = VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
      break;
    case Access::TransferRead:
      use.stage = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
      use.reads = VK_ACCESS_2_TRANSFER_READ_BIT;
      use.layout = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
      use.usage = texture ? VkFlags{VK_IMAGE_USAGE_TRANSFER_SRC_BIT} : VkFlags{VK_BUFFER_USAGE_TRANSFER_SRC_BIT};
      break;
    case Access::TransferWrite:
      use.stage = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
      use.writes = VK_ACCESS_2_TRANSFER_WRITE_BIT;
      use.layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
      use.usage = texture ? VkFlags{VK_IMAGE_USAGE_TRANSFER_DST_BIT} : VkFlags{VK_BUFFER_USAGE_TRANSFER_DST_BIT};
      break;
    case Access::ColorWrite:
    case Access::ColorReadWrite:
      use.stage = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
      if (access == Access::ColorReadWrite) use.reads = VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT;
      use.writes = VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT;
      use.layout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
      use.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
      break;
    case Access::DepthWrite:
    case Access::DepthReadWrite:
      use.stage = kTests;
      if (access == Access::DepthReadWrite) use.reads = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT;
      use.writes = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
      use.layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
      use.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
      break;
    case Access::DepthRead:
      use.stage = kTests;
      use.reads = VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT;
      use.layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;
      use.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
      break;
    case Access::VertexRead:
      use.stage = VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT;
      use.reads = VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT;
      use.usage = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT;
      break;
    case Access::IndexRead:
      use.stage = VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT;
      use.reads = VK_ACCESS_2_INDEX_READ_BIT;
      use.usage = VK_BUFFER_USAGE_INDEX_BUFFER_BIT;
      break;
  }
  if (!texture) use.layout = VK_IMAGE_LAYOUT_UNDEFINED;
  return use;
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
