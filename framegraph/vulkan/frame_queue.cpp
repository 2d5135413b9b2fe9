#include "framegraph/vulkan/frame_queue.h"

#include <array>
#include <limits>

namespace fg::vk {
namespace {

/// Semaphores of one submission. Values of binary ones are ignored.
struct SemaphoreList {
  std::array<VkSemaphore, 2> semaphores{};
  std::array<std::uint64_t, 2> values{};
  std::array<VkPipelineStageFlags, 2> stages{};
  std::uint32_t count = 0;

  void add(VkSemaphore semaphore, std::uint64_t value, VkPipelineStageFlags stage = 0) {
    if (semaphore == VK_NULL_HANDLE) return;
    semaphores[count] = semaphore;
    values[count] = value;
    stages[count] = stage;
    ++count;
  }
};

}  // namespace

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
  SemaphoreList waits;
  waits.add(semaphores.wait, 0, semaphores.waitStage);
  waits.add(semaphores.after.semaphore, semaphores.after.value, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT);
  SemaphoreList signals;
  signals.add(semaphores.signal, 0);
  signals.add(semaphores.finished.semaphore, semaphores.finished.value);
  VkTimelineSemaphoreSubmitInfo values{};
  values.sType = VK_STRUCTURE_TYPE_TIMELINE_SEMAPHORE_SUBMIT_INFO;
  values.waitSemaphoreValueCount = waits.count;
  values.pWaitSemaphoreValues = waits.values.data();
  values.signalSemaphoreValueCount = signals.count;
  values.pSignalSemaphoreValues = signals.values.data();
  const bool timeline = semaphores.after.semaphore != VK_NULL_HANDLE || semaphores.finished.semaphore != VK_NULL_HANDLE;
  VkSubmitInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  info.pNext = timeline ? &values : nullptr;
  info.commandBufferCount = 1;
  info.pCommandBuffers = &frame.commandBuffer;
  info.waitSemaphoreCount = waits.count;
  info.pWaitSemaphores = waits.semaphores.data();
  info.pWaitDstStageMask = waits.stages.data();
  info.signalSemaphoreCount = signals.count;
  info.pSignalSemaphores = signals.semaphores.data();
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
