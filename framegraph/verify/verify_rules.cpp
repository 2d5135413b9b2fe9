#include "framegraph/verify/verify_rules.h"

#include <array>
#include <span>

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

namespace {

/// A flag and the flags that it stands for.
struct Meta {
  VkFlags64 flag;
  VkFlags64 parts;
};

constexpr VkFlags64 replaced(VkFlags64 flags, std::span<const Meta> table) {
  VkFlags64 result = flags;
  for (const Meta& meta : table) {
    if ((flags & meta.flag) != 0) result = (result & ~meta.flag) | meta.parts;
  }
  return result;
}

constexpr VkPipelineStageFlags2 kTransfers = VK_PIPELINE_STAGE_2_COPY_BIT | VK_PIPELINE_STAGE_2_BLIT_BIT |
                                             VK_PIPELINE_STAGE_2_RESOLVE_BIT | VK_PIPELINE_STAGE_2_CLEAR_BIT;
constexpr VkPipelineStageFlags2 kVertexInput =
    VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT | VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT;
constexpr VkPipelineStageFlags2 kPreRasterization =
    VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_TESSELLATION_CONTROL_SHADER_BIT |
    VK_PIPELINE_STAGE_2_TESSELLATION_EVALUATION_SHADER_BIT | VK_PIPELINE_STAGE_2_GEOMETRY_SHADER_BIT |
    VK_PIPELINE_STAGE_2_TASK_SHADER_BIT_EXT | VK_PIPELINE_STAGE_2_MESH_SHADER_BIT_EXT;
constexpr VkPipelineStageFlags2 kGraphics =
    VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT | kVertexInput | kPreRasterization | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT |
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT |
    VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT | VK_PIPELINE_STAGE_2_CONDITIONAL_RENDERING_BIT_EXT |
    VK_PIPELINE_STAGE_2_TRANSFORM_FEEDBACK_BIT_EXT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADING_RATE_ATTACHMENT_BIT_KHR |
    VK_PIPELINE_STAGE_2_FRAGMENT_DENSITY_PROCESS_BIT_EXT;
/// The host's own stage is not among them: it is no command of a queue.
constexpr VkPipelineStageFlags2 kCommands = kGraphics | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | kTransfers |
                                            VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_BUILD_BIT_KHR |
                                            VK_PIPELINE_STAGE_2_ACCELERATION_STRUCTURE_COPY_BIT_KHR |
                                            VK_PIPELINE_STAGE_2_RAY_TRACING_SHADER_BIT_KHR;
constexpr std::array kMetaStages = {
    Meta{VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, kCommands}, Meta{VK_PIPELINE_STAGE_2_ALL_GRAPHICS_BIT, kGraphics},
    Meta{VK_PIPELINE_STAGE_2_PRE_RASTERIZATION_SHADERS_BIT, kPreRasterization},
    Meta{VK_PIPELINE_STAGE_2_VERTEX_INPUT_BIT, kVertexInput}, Meta{VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, kTransfers}};

constexpr VkAccessFlags2 kShaderReads = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
constexpr VkAccessFlags2 kReads = kShaderReads | VK_ACCESS_2_UNIFORM_READ_BIT | VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT |
                                  VK_ACCESS_2_INDEX_READ_BIT | VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT |
                                  VK_ACCESS_2_INPUT_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT |
                                  VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_TRANSFER_READ_BIT |
                                  VK_ACCESS_2_HOST_READ_BIT | VK_ACCESS_2_ACCELERATION_STRUCTURE_READ_BIT_KHR;
constexpr VkAccessFlags2 kWrites =
    VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT |
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT | VK_ACCESS_2_HOST_WRITE_BIT |
    VK_ACCESS_2_ACCELERATION_STRUCTURE_WRITE_BIT_KHR | VK_ACCESS_2_TRANSFORM_FEEDBACK_WRITE_BIT_EXT |
    VK_ACCESS_2_TRANSFORM_FEEDBACK_COUNTER_WRITE_BIT_EXT | VK_ACCESS_2_COMMAND_PREPROCESS_WRITE_BIT_NV |
    VK_ACCESS_2_MICROMAP_WRITE_BIT_EXT | VK_ACCESS_2_OPTICAL_FLOW_WRITE_BIT_NV |
    VK_ACCESS_2_VIDEO_DECODE_WRITE_BIT_KHR | VkAccessFlags2{0x4000000000};  // VK_ACCESS_2_VIDEO_ENCODE_WRITE_BIT_KHR
constexpr std::array kMetaAccesses = {Meta{VK_ACCESS_2_MEMORY_READ_BIT, kReads},
                                      Meta{VK_ACCESS_2_MEMORY_WRITE_BIT, kWrites},
                                      Meta{VK_ACCESS_2_SHADER_READ_BIT, kShaderReads},
                                      Meta{VK_ACCESS_2_SHADER_WRITE_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT}};

}  // namespace

VkPipelineStageFlags2 expanded(VkPipelineStageFlags2 stages) {
  return replaced(stages, kMetaStages);
}

VkAccessFlags2 expandedAccess(VkAccessFlags2 accesses) {
  return replaced(accesses, kMetaAccesses);
}

VkAccessFlags2 writesOf(VkAccessFlags2 accesses) {
  return expandedAccess(accesses) & kWrites;
}

}  // namespace fg::check
