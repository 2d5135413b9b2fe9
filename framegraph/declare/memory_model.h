#pragma once

#include <cstdint>

#include <vulkan/vulkan_core.h>

#include "framegraph/declare/graph.h"

namespace fg {

/// Requirements of a device for the memory of a resource.
struct MemoryRequirements {
  std::uint64_t size = 0;
  std::uint64_t alignment = 1;
  std::uint32_t memoryTypeBits = ~0u;
};

/// Bytes of the texels in a part of a texture, tightly packed. Mip levels and layers that do not exist count as 0.
std::uint64_t texelBytes(const TextureDesc& desc, const SubresourceRange& range);

/// The only properties of a device that the compiler needs: sizes and alignments of resources, and the supported
/// formats. `vk::DriverMemoryModel` queries the driver; `TableMemoryModel` computes from a table.
class MemoryModel {
 public:
  virtual ~MemoryModel() = default;
  [[nodiscard]] virtual MemoryRequirements texture(const TextureDesc& desc, VkImageUsageFlags usage) const = 0;
  [[nodiscard]] virtual MemoryRequirements buffer(const BufferDesc& desc, VkBufferUsageFlags usage) const = 0;
  /// True if optimally tiled images of this format support all these usages.
  [[nodiscard]] virtual bool supports(VkFormat format, VkImageUsageFlags usage) const = 0;
  /// Vulkan's bufferImageGranularity: page size in bytes that buffers and optimally tiled images must not share.
  [[nodiscard]] virtual std::uint64_t bufferImageGranularity() const = 0;
};

/// A memory model that needs no device: sizes are those of tightly packed texels, rounded up to 256 bytes, and every
/// format known to `formatInfo` supports every usage.
class TableMemoryModel final : public MemoryModel {
 public:
  [[nodiscard]] MemoryRequirements texture(const TextureDesc& desc, VkImageUsageFlags usage) const override;
  [[nodiscard]] MemoryRequirements buffer(const BufferDesc& desc, VkBufferUsageFlags usage) const override;
  [[nodiscard]] bool supports(VkFormat format, VkImageUsageFlags usage) const override;
  [[nodiscard]] std::uint64_t bufferImageGranularity() const override;
};

}  // namespace fg
