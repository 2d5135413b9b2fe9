#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "framegraph/vulkan/executor.h"
#include "framegraph/vulkan/memory.h"

namespace fg::vk {

/// State of a StagedImage after `recordUpload`: how to import it.
inline constexpr ExternalState kUploaded{VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                                         VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL};
/// State in which `recordReadback` expects a StagedImage: how to export it.
inline constexpr ExternalState kReadable{VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT,
                                         VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
/// How to import a StagedImage whose contents the graph overwrites: it waits for the last frame's readback.
inline constexpr ExternalState kOverwritable{VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_NONE, VK_IMAGE_LAYOUT_UNDEFINED};

/// A host's image of one mip level and layer with staging memory for every frame slot: `recordUpload` writes its texels
/// and `recordReadback` reads them, while other frames are in flight.
class StagedImage {
 public:
  enum class Direction { Upload, Readback };

  /// @param usage usage flags that the graph needs (see `Executor::usage`); those of the transfer are added
  /// @throws OutOfMemory
  StagedImage(const DeviceContext& device, const TextureDesc& desc, VkImageUsageFlags usage, Direction direction,
              std::uint32_t slots, const std::string& name);

  [[nodiscard]] ExternalImage external() const { return {image_.get(), 0}; }
  /// Rows of texels without padding. Write them before the frame of `recordUpload` is submitted, or read them after the
  /// frame of `recordReadback` has finished.
  [[nodiscard]] std::span<std::byte> staging(std::uint32_t slot) const;
  void recordUpload(VkCommandBuffer commandBuffer, std::uint32_t slot) const;
  void recordReadback(VkCommandBuffer commandBuffer, std::uint32_t slot) const;

 private:
  [[nodiscard]] VkBufferImageCopy copyRegion() const;

  const DeviceContext* device_;
  TextureDesc desc_;
  Owned<VkImage> image_;
  MemoryArena imageMemory_;
  MemoryArena stagingMemory_;
  std::vector<Owned<VkBuffer>> buffers_;
  std::vector<std::byte*> mapped_;
};

}  // namespace fg::vk
