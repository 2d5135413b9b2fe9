#include "framegraph/declare/memory_model.h"

#include <algorithm>

#include "framegraph/declare/format.h"

namespace fg {
namespace {

constexpr std::uint64_t kGranularity = 256;

MemoryRequirements inSteps(std::uint64_t bytes) {
  return {(bytes + kGranularity - 1) / kGranularity * kGranularity, kGranularity, ~0U};
}

}  // namespace

std::uint64_t texelBytes(const TextureDesc& desc, const SubresourceRange& range) {
  const std::uint32_t mips = std::min(range.mipCount, desc.mipLevels - std::min(range.baseMip, desc.mipLevels));
  const std::uint32_t layers =
      std::min(range.layerCount, desc.arrayLayers - std::min(range.baseLayer, desc.arrayLayers));
  std::uint64_t texels = 0;
  for (std::uint32_t mip = range.baseMip; mip < range.baseMip + mips && mip < 32; ++mip) {
    texels += std::uint64_t{std::max(desc.extent.width >> mip, 1U)} * std::max(desc.extent.height >> mip, 1U);
  }
  return texels * layers * bytesPerTexel(desc.format);
}

MemoryRequirements TableMemoryModel::texture(const TextureDesc& desc, VkImageUsageFlags /*usage*/) const {
  return inSteps(texelBytes(desc, {}));
}

MemoryRequirements TableMemoryModel::buffer(const BufferDesc& desc, VkBufferUsageFlags /*usage*/) const {
  return inSteps(desc.size);
}

bool TableMemoryModel::supports(VkFormat format, VkImageUsageFlags /*usage*/) const {
  return bytesPerTexel(format) != 0;
}

std::uint64_t TableMemoryModel::bufferImageGranularity() const {
  return 1;
}

}  // namespace fg
