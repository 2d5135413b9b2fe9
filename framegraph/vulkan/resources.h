#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "framegraph/declare/graph.h"
#include "framegraph/plan/plan.h"
#include "framegraph/vulkan/frame_index.h"
#include "framegraph/vulkan/memory.h"
#include "framegraph/vulkan/shared_objects.h"

namespace fg::vk {

/// Bytes of device memory that `Resources` allocates for a plan. Nothing is created to find out.
/// @param plan compiled with the DriverMemoryModel of the device
std::uint64_t requiredBytes(const DeviceContext& device, const GraphDesc& graph, const Plan& plan, std::uint32_t slots);

/// Every image and buffer that a plan uses, created or imported. Indexed by resource and frame.
class Resources {
 public:
  /// @throws OutOfMemory, or Error if the plan was compiled for another device
  Resources(const DeviceContext& device, const GraphDesc& graph, const Plan& plan, std::uint32_t slots, bool poison,
            const Membership& membership = {});

  [[nodiscard]] VkImage image(std::uint32_t resource, FrameIndex frame) const {
    return images_[resource * kParities + frame.parity];
  }
  [[nodiscard]] VkBuffer buffer(std::uint32_t resource, FrameIndex frame) const {
    return buffers_[(resource * slots_ + frame.slot) * kParities + frame.parity];
  }
  /// First byte of a frame slot's copy of an upload buffer.
  [[nodiscard]] std::byte* mapped(std::uint32_t resource, std::uint32_t slot) const {
    return mapped_[resource * slots_ + slot];
  }
  /// Replace the image of a resource in frames of one parity. Returns the old image.
  VkImage exchange(std::uint32_t resource, std::uint32_t parity, VkImage image) {
    return std::exchange(images_[resource * kParities + parity], image);
  }
  void import(std::uint32_t resource, VkImage image);
  void import(std::uint32_t resource, VkBuffer buffer);
  /// Sum of all allocated bytes, shared ones included.
  [[nodiscard]] std::uint64_t allocatedBytes() const;
  /// Bytes that other members use now, too.
  [[nodiscard]] std::uint64_t sharedBytes() const;

 private:
  void makeTexture(std::uint32_t resource, const TextureDesc& desc, bool poison);
  void makeBuffer(std::uint32_t resource, const BufferDesc& desc, bool poison);
  VkImage addImage(std::uint32_t resource, const TextureDesc& desc, VkImageUsageFlags usage);
  VkBuffer addBuffer(std::uint32_t resource, const BufferDesc& desc, VkBufferUsageFlags usage);
  void allocateHeaps(const Membership& membership);
  /// The memory of a resource's heap in frames of one parity.
  [[nodiscard]] const DeviceMemory& heapOf(const PlannedResource& planned, std::uint32_t parity) const {
    return *heaps_[allocationOf(plan_->heaps, planned.heap, parity)];
  }
  /// Number of copies of a resource: two if its heap is another allocation in odd frames.
  [[nodiscard]] std::uint32_t copies(const PlannedResource& planned) const {
    return planned.heap != kNone && plan_->heaps[planned.heap].partner != kNone ? kParities : 1;
  }
  /// Check that a resource fits where the plan puts it.
  void checkPlacement(std::uint32_t resource, const MemoryRequirements& requirements) const;

  const DeviceContext* device_;
  const GraphDesc* graph_;
  const Plan* plan_;
  std::uint32_t slots_;
  std::vector<std::shared_ptr<DeviceMemory>> heaps_;
  MemoryArena persistent_;
  MemoryArena uploads_;
  std::vector<Owned<VkImage>> ownedImages_;
  std::vector<Owned<VkBuffer>> ownedBuffers_;
  std::vector<VkImage> images_;    ///< Indexed by resource and parity.
  std::vector<VkBuffer> buffers_;  ///< Indexed by resource, slot and parity.
  std::vector<std::byte*> mapped_;
};

}  // namespace fg::vk
