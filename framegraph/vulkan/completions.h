#pragma once

#include <cstdint>
#include <vector>

#include "framegraph/vulkan/device_context.h"
#include "framegraph/vulkan/timeline_point.h"

namespace fg::vk {

/// Checks that the GPU has finished a frame before its slot is used again, for hosts that tell which value of a
/// timeline semaphore each frame signals. Nothing is checked for frames without one. It never waits.
class Completions {
 public:
  Completions(const DeviceContext& device, std::uint32_t slots) : device_(&device), last_(slots) {}

  /// Check before a frame is recorded.
  /// @param frame    number of the frame, for the message
  /// @param finished what the frame will signal
  /// @throws FrameInFlight naming frames, slot and values if the GPU has not finished the frame that used the slot
  ///         before; std::invalid_argument for a value that can tell nothing; Unsupported if the device has no timeline
  ///         semaphores; DeviceLost
  void require(std::uint32_t slot, std::uint64_t frame, const TimelinePoint& finished) const;
  /// Note that the frame is recorded.
  void note(std::uint32_t slot, std::uint64_t frame, const TimelinePoint& finished);

 private:
  struct Noted {
    TimelinePoint finished;
    std::uint64_t frame = 0;
  };
  void requireUsable(const TimelinePoint& finished) const;

  const DeviceContext* device_;
  std::vector<Noted> last_;  ///< By slot.
  Noted latest_;
};

}  // namespace fg::vk
