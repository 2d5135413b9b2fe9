#pragma once

#include <cstdint>

#include <vulkan/vulkan_core.h>

#include "framegraph/declare/graph.h"

namespace fg {

/// What a device asks of the memory behind a resource.
struct MemoryRequirements {
  std::uint64_t size = 0;
  std::uint64_t alignment = 1;
  std::uint32_t memoryTypeBits = ~0u;
};

/// Bytes of the texels in part of a texture, tightly packed. Parts that the texture lacks count nothing.
std::uint64_t texelBytes(const TextureDesc& desc, const SubresourceRange& range);

/// The compiler's only view of a device: sizes, alignments, and which format serves which use.
/// The executor's implementation asks the driver; `TableMemoryModel` computes from a table.
class MemoryModel {
 public:
  virtual ~MemoryModel() = default;
  [[nodiscard]] virtual MemoryRequirements texture(const TextureDesc& desc, VkImageUsageFlags usage) const = 0;
  [[nodiscard]] virtual MemoryRequirements buffer(const BufferDesc& desc, VkBufferUsageFlags usage) const = 0;
  /// True where optimally tiled images of this format can be used in all these ways.
  [[nodiscard]] virtual bool supports(VkFormat format, VkImageUsageFlags usage) const = 0;
  /// Bytes between a linear and an optimally tiled neighbour in one allocation.
  [[nodiscard]] virtual std::uint64_t bufferImageGranularity() const = 0;
};

/// Tightly packed texels in 256-byte steps; every format known to `formatInfo` serves every use.
class TableMemoryModel final : public MemoryModel {
 public:
  [[nodiscard]] MemoryRequirements texture(const TextureDesc& desc, VkImageUsageFlags usage) const override;
  [[nodiscard]] MemoryRequirements buffer(const BufferDesc& desc, VkBufferUsageFlags usage) const override;
  [[nodiscard]] bool supports(VkFormat format, VkImageUsageFlags usage) const override;
  [[nodiscard]] std::uint64_t bufferImageGranularity() const override;
};

}  // namespace fg
