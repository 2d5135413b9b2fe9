#include "framegraph/vulkan/frame_queue.h"

#include <limits>

namespace fg::vk {

FrameQueue::FrameQueue(const DeviceContext& device, VkQueue queue, std::uint32_t framesInFlight)
    : device_(&device), queue_(queue), slots_(framesInFlight) {
  VkCommandPoolCreateInfo poolInfo{};
  poolInfo.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  poolInfo.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
  poolInfo.queueFamilyIndex = device.view.queueFamily;
  VkFenceCreateInfo fenceInfo{};
  fenceInfo.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  for (Slot& slot : slots_) {
    slot.pool =
        create<VkCommandPool>(device, device.functions.vkCreateCommandPool, poolInfo, "creating a command pool");
    slot.fence = create<VkFence>(device, device.functions.vkCreateFence, fenceInfo, "creating a fence");
    VkCommandBufferAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    info.commandPool = slot.pool.get();
    info.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    info.commandBufferCount = 1;
    check(device.functions.vkAllocateCommandBuffers(device.view.device, &info, &slot.commandBuffer),
          "allocating a command buffer");
  }
}

FrameQueue::~FrameQueue() {
  // Safe on a lost device too: the call returns an error, and nothing is in flight any more.
  device_->functions.vkDeviceWaitIdle(device_->view.device);
}

Frame FrameQueue::begin() {
  wait(next_);
  const Slot& slot = slots_[next_];
  check(device_->functions.vkResetCommandPool(device_->view.device, slot.pool.get(), 0), "resetting a command pool");
  VkCommandBufferBeginInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(device_->functions.vkBeginCommandBuffer(slot.commandBuffer, &info), "beginning a command buffer");
  return {slot.commandBuffer, next_};
}

void FrameQueue::submit(const Frame& frame, const FrameSemaphores& semaphores) {
  Slot& slot = slots_[frame.slot];
  check(device_->functions.vkEndCommandBuffer(frame.commandBuffer), "ending a command buffer");
  VkSubmitInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  info.commandBufferCount = 1;
  info.pCommandBuffers = &frame.commandBuffer;
  info.waitSemaphoreCount = semaphores.wait != VK_NULL_HANDLE ? 1 : 0;
  info.pWaitSemaphores = &semaphores.wait;
  info.pWaitDstStageMask = &semaphores.waitStage;
  info.signalSemaphoreCount = semaphores.signal != VK_NULL_HANDLE ? 1 : 0;
  info.pSignalSemaphores = &semaphores.signal;
  check(device_->functions.vkQueueSubmit(queue_, 1, &info, slot.fence.get()), "submitting a frame");
  slot.pending = true;
  next_ = (frame.slot + 1) % static_cast<std::uint32_t>(slots_.size());
}

void FrameQueue::wait(std::uint32_t index) {
  Slot& slot = slots_[index];
  if (!slot.pending) return;
  const VkFence fence = slot.fence.get();
  check(device_->functions.vkWaitForFences(device_->view.device, 1, &fence, VK_TRUE,
                                           std::numeric_limits<std::uint64_t>::max()),
        "waiting for a frame");
  check(device_->functions.vkResetFences(device_->view.device, 1, &fence), "resetting a fence");
  slot.pending = false;
}

void FrameQueue::waitAll() {
  for (std::uint32_t slot = 0; slot < slots_.size(); ++slot) wait(slot);
}

}  // namespace fg::vk
