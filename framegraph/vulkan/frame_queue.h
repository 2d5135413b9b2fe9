#pragma once

#include <cstdint>
#include <vector>

#include "framegraph/vulkan/owned.h"

namespace fg::vk {

/// One frame being recorded.
struct Frame {
  VkCommandBuffer commandBuffer = VK_NULL_HANDLE;
  std::uint32_t slot = 0;  ///< As `Executor::record` takes it.
};

/// What a frame waits for and tells beside its fence, for instance to and from a swapchain.
struct FrameSemaphores {
  VkSemaphore wait = VK_NULL_HANDLE;
  VkPipelineStageFlags waitStage = 0;  ///< Of the frame: the first that waits.
  VkSemaphore signal = VK_NULL_HANDLE;
};

/// Command buffers and fences of a program that submits one command buffer a frame to one queue and lets a few frames
/// be in flight.
class FrameQueue {
 public:
  /// @param queue of the family `device.view.queueFamily`
  FrameQueue(const DeviceContext& device, VkQueue queue, std::uint32_t framesInFlight = 2);
  /// Waits for all frames.
  ~FrameQueue();
  FrameQueue(const FrameQueue&) = delete;
  FrameQueue& operator=(const FrameQueue&) = delete;

  /// Start recording with the slot that was used longest ago, once the GPU has finished with it. A frame that was begun
  /// and not submitted is dropped.
  /// @throws DeviceLost, OutOfMemory
  Frame begin();
  /// @throws DeviceLost, OutOfMemory
  void submit(const Frame& frame, const FrameSemaphores& semaphores = {});
  /// Wait for the frame last submitted with a slot; at once where there is none.
  /// @throws DeviceLost
  void wait(std::uint32_t slot);
  void waitAll();

 private:
  struct Slot {
    Owned<VkCommandPool> pool;
    Owned<VkFence> fence;
    VkCommandBuffer commandBuffer = VK_NULL_HANDLE;
    bool pending = false;
  };
  const DeviceContext* device_;
  VkQueue queue_;
  std::vector<Slot> slots_;
  std::uint32_t next_ = 0;
};

}  // namespace fg::vk
