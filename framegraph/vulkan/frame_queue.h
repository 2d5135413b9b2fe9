#pragma once

#include <cstdint>
#include <vector>

#include "framegraph/vulkan/owned.h"
#include "framegraph/vulkan/timeline_point.h"

namespace fg::vk {

/// One frame being recorded.
struct Frame {
  VkCommandBuffer commandBuffer = VK_NULL_HANDLE;
  std::uint32_t slot = 0;  ///< Argument of `Executor::record`.
};

/// Semaphores that a frame waits for and signals, for instance those of a swapchain. A frame always signals its fence.
struct FrameSemaphores {
  VkSemaphore wait = VK_NULL_HANDLE;
  VkPipelineStageFlags waitStage = 0;  ///< First stage of the frame that waits.
  VkSemaphore signal = VK_NULL_HANDLE;
  TimelinePoint after = {};     ///< The whole frame waits for it.
  TimelinePoint finished = {};  ///< Signalled; see `Executor::record`.
};

/// Command buffers and fences for a program that submits one command buffer per frame to one queue, with a few frames
/// in flight.
class FrameQueue {
 public:
  /// @param queue a queue of the family `device.view.queueFamily`
  FrameQueue(const DeviceContext& device, VkQueue queue, std::uint32_t framesInFlight = 2);
  /// Waits for all frames.
  ~FrameQueue();
  FrameQueue(const FrameQueue&) = delete;
  FrameQueue& operator=(const FrameQueue&) = delete;

  /// Start recording into the slot that was used longest ago, after waiting for the GPU to finish with it. Discards a
  /// frame that was begun but not submitted.
  /// @throws DeviceLost, OutOfMemory
  Frame begin();
  /// @throws DeviceLost, OutOfMemory
  void submit(const Frame& frame, const FrameSemaphores& semaphores = {});
  /// Wait for the frame last submitted with a slot. Returns at once if there is none.
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
