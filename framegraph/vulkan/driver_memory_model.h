#pragma once

#include <map>
#include <mutex>
#include <tuple>

#include "framegraph/declare/memory_model.h"
#include "framegraph/vulkan/device_context.h"

namespace fg::vk {

/// A memory model that queries the driver. Results are cached. Several threads may use it at once.
class DriverMemoryModel final : public MemoryModel {
 public:
  /// @param device must outlive the model
  /// @param poison must equal `ExecutorOptions::poison` of the executor that gets the plan: poisoning needs the usage
  ///        flags below
  explicit DriverMemoryModel(const DeviceContext& device, bool poison = false) : device_(&device), poison_(poison) {}

  [[nodiscard]] MemoryRequirements texture(const TextureDesc& desc, VkImageUsageFlags usage) const override;
  [[nodiscard]] MemoryRequirements buffer(const BufferDesc& desc, VkBufferUsageFlags usage) const override;
  [[nodiscard]] bool supports(VkFormat format, VkImageUsageFlags usage) const override;
  [[nodiscard]] std::uint64_t bufferImageGranularity() const override;

 private:
  using TextureKey =
      std::tuple<VkFormat, std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t, VkImageUsageFlags>;
  using BufferKey = std::tuple<std::uint64_t, VkBufferUsageFlags>;

  const DeviceContext* device_;
  bool poison_;
  mutable std::mutex mutex_;
  mutable std::map<TextureKey, MemoryRequirements> textures_;
  mutable std::map<BufferKey, MemoryRequirements> buffers_;
};

/// Usage flags that poisoning adds to a resource, because a transfer command fills it.
inline constexpr VkImageUsageFlags kPoisonImageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT;
inline constexpr VkBufferUsageFlags kPoisonBufferUsage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;

}  // namespace fg::vk
