#include "framegraph/vulkan/completions.h"

#include <stdexcept>
#include <string>

#include "framegraph/vulkan/error.h"

namespace fg::vk {

void Completions::requireUsable(const TimelinePoint& finished) const {
  if (finished.semaphore == VK_NULL_HANDLE) return;
  if (device_->functions.vkGetSemaphoreCounterValue == nullptr) {
    throw Unsupported(
        "the device has no timeline semaphores to tell when frames are finished: create it with the feature "
        "timelineSemaphore (Vulkan 1.2 or VK_KHR_timeline_semaphore), or give none",
        VK_ERROR_FEATURE_NOT_PRESENT);
  }
  if (finished.value == 0) {
    throw std::invalid_argument(
        "the value that tells that a frame is finished is 0, which no submission signals: give the value that the "
        "frame's submission signals");
  }
  const TimelinePoint& before = latest_.finished;
  if (finished.semaphore == before.semaphore && finished.value < before.value) {
    throw std::invalid_argument("the value that tells that a frame is finished is " + std::to_string(finished.value) +
                                ", but frame " + std::to_string(latest_.frame) + " had " +
                                std::to_string(before.value) + " of the same semaphore: values must not fall");
  }
}

void Completions::require(std::uint32_t slot, std::uint64_t frame, const TimelinePoint& finished) const {
  requireUsable(finished);
  const Noted& last = last_[slot];
  if (last.finished.semaphore == VK_NULL_HANDLE) return;
  std::uint64_t value = 0;
  const VkResult result =
      device_->functions.vkGetSemaphoreCounterValue(device_->view.device, last.finished.semaphore, &value);
  // The text is made only if it is needed: recording allocates nothing.
  if (result != VK_SUCCESS) check(result, "reading the timeline semaphore of frame " + std::to_string(last.frame));
  if (value >= last.finished.value) return;
  throw FrameInFlight("frame " + std::to_string(frame) + " uses slot " + std::to_string(slot) + " of " +
                      std::to_string(last_.size()) + " again, but the GPU has not finished frame " +
                      std::to_string(last.frame) + " there: its timeline semaphore must be at " +
                      std::to_string(last.finished.value) + " and is at " + std::to_string(value) +
                      ". Wait for that value before you record, or allow more frames in flight");
}

void Completions::note(std::uint32_t slot, std::uint64_t frame, const TimelinePoint& finished) {
  latest_ = {finished, frame};
  last_[slot] = latest_;
}

}  // namespace fg::vk
