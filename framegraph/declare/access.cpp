#include "framegraph/declare/access.h"

#include <array>

namespace fg {
namespace {

constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags2 kTransfer = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
constexpr VkPipelineStageFlags2 kColour = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
constexpr VkPipelineStageFlags2 kDepthTests =
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;

// One row per value of Access, in the order of the enumeration.
constexpr std::array<AccessInfo, 16> kAccesses{{
    {"SampledRead", kCompute, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, 0, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
     VK_IMAGE_USAGE_SAMPLED_BIT, 0},
    {"StorageRead", kCompute, VK_ACCESS_2_SHADER_STORAGE_READ_BIT, 0, VK_IMAGE_LAYOUT_GENERAL,
     VK_IMAGE_USAGE_STORAGE_BIT, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT},
    {"StorageWrite", kCompute, 0, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, VK_IMAGE_LAYOUT_GENERAL,
     VK_IMAGE_USAGE_STORAGE_BIT, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT},
    {"StorageReadWrite", kCompute, VK_ACCESS_2_SHADER_STORAGE_READ_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
     VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_USAGE_STORAGE_BIT, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT},
    {"UniformRead", kCompute, VK_ACCESS_2_UNIFORM_READ_BIT, 0, VK_IMAGE_LAYOUT_UNDEFINED, 0,
     VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT},
    {"IndirectRead", VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT, 0,
     VK_IMAGE_LAYOUT_UNDEFINED, 0, VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT},
    {"TransferRead", kTransfer, VK_ACCESS_2_TRANSFER_READ_BIT, 0, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
     VK_IMAGE_USAGE_TRANSFER_SRC_BIT, VK_BUFFER_USAGE_TRANSFER_SRC_BIT},
    {"TransferWrite", kTransfer, 0, VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
     VK_IMAGE_USAGE_TRANSFER_DST_BIT, VK_BUFFER_USAGE_TRANSFER_DST_BIT},
    {"ColorWrite", kColour, 0, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
     VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, 0},
    {"ColorReadWrite", kColour, VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
     VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, 0},
    {"DepthWrite", kDepthTests, 0, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
     VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, 0},
    {"DepthReadWrite", kDepthTests, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT,
     VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
     VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, 0},
    {"DepthRead", kDepthTests, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT, 0,
     VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, 0},
    {"FragmentSampledRead", VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, 0,
     VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, VK_IMAGE_USAGE_SAMPLED_BIT, 0},
    {"VertexRead", VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT, VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT, 0,
     VK_IMAGE_LAYOUT_UNDEFINED, 0, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT},
    {"IndexRead", VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT, VK_ACCESS_2_INDEX_READ_BIT, 0, VK_IMAGE_LAYOUT_UNDEFINED, 0,
     VK_BUFFER_USAGE_INDEX_BUFFER_BIT},
}};

/// The access flags of a state of a texture or buffer, where those that stand for several in shaders are replaced by
/// these. Images are loaded and stored in the layout GENERAL only.
VkAccessFlags2 accessesIn(const ExternalState& state, bool texture) {
  VkAccessFlags2 accesses = state.access;
  const bool storage = !texture || state.layout == VK_IMAGE_LAYOUT_GENERAL;
  if ((state.access & VK_ACCESS_2_SHADER_READ_BIT) != 0) {
    accesses |= texture ? VK_ACCESS_2_SHADER_SAMPLED_READ_BIT : VK_ACCESS_2_UNIFORM_READ_BIT;
    if (storage) accesses |= VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
  }
  if ((state.access & VK_ACCESS_2_SHADER_WRITE_BIT) != 0) accesses |= VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
  return accesses;
}

/// True if a state of a texture has some access flag of an access, or the layout that only this kind of access uses.
bool servesState(const AccessInfo& info, const ExternalState& state) {
  const bool ownLayout = info.layout != VK_IMAGE_LAYOUT_UNDEFINED && info.layout != VK_IMAGE_LAYOUT_GENERAL;
  return (info.mask() & accessesIn(state, true)) != VK_ACCESS_2_NONE || (ownLayout && info.layout == state.layout);
}

}  // namespace

VkImageUsageFlags imageUsageIn(const ExternalState& state) {
  VkImageUsageFlags usage = 0;
  for (const AccessInfo& info : kAccesses) {
    if (servesState(info, state)) usage |= info.imageUsage;
  }
  return usage;
}

VkBufferUsageFlags bufferUsageIn(const ExternalState& state) {
  VkBufferUsageFlags usage = 0;
  for (const AccessInfo& info : kAccesses) {
    if ((info.mask() & accessesIn(state, false)) != VK_ACCESS_2_NONE) usage |= info.bufferUsage;
  }
  return usage;
}

const AccessInfo& accessInfo(Access access) {
  return kAccesses.at(static_cast<std::size_t>(access));
}

}  // namespace fg
