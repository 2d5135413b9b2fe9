#include "framegraph/memory_model.h"

#include <algorithm>

#include "framegraph/format.h"

namespace fg {
namespace {

constexpr std::uint64_t kGranularity = 256;

std::uint64_t roundUp(std::uint64_t bytes) {
  return (bytes + kGranularity - 1) / kGranularity * kGranularity;
}

}  // namespace

MemoryRequirements TableMemoryModel::texture(const TextureDesc& desc, VkImageUsageFlags /*usage*/) const {
  std::uint64_t texels = 0;
  for (std::uint32_t mip = 0; mip < desc.mipLevels; ++mip) {
    texels += std::uint64_t{std::max(desc.extent.width >> mip, 1U)} * std::max(desc.extent.height >> mip, 1U);
  }
  return {roundUp(texels * desc.arrayLayers * bytesPerTexel(desc.format)), kGranularity, ~0U};
}

MemoryRequirements TableMemoryModel::buffer(const BufferDesc& desc, VkBufferUsageFlags /*usage*/) const {
  return {roundUp(desc.size), kGranularity, ~0U};
}

bool TableMemoryModel::supports(VkFormat format, VkImageUsageFlags /*usage*/) const {
  return bytesPerTexel(format) != 0;
}

std::uint64_t TableMemoryModel::bufferImageGranularity() const {
  return 1;
}

}  // namespace fg
