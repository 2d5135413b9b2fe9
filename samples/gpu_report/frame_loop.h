#pragma once

#include <cstddef>
#include <memory>

#include "samples/bench/timing.h"
#include "samples/bench/variant.h"
#include "samples/denoise/gpu_device.h"
#include "samples/gpu_report/timed_content.h"

namespace walr {

/// How long a loop runs: until it has run `most` frames, or `least` frames and `seconds`.
struct LoopLength {
  std::size_t least = 1;
  std::size_t most = 1;
  double seconds = 0.0;
};

/// Runs a method on frames that lie in device memory, one right after the other with two in flight. Nothing is uploaded
/// or read back between them, so that the device stays as busy, and its clocks as high, as in a game.
class FrameLoop {
 public:
  /// @param device must outlive this
  /// @throws fg::vk::Error if the device lacks memory or something else that the method needs
  /// @throws std::invalid_argument naming a setting of the method that does not support the size
  FrameLoop(const GpuDevice& device, const Variant& variant, const TimedContent& content);
  ~FrameLoop();
  FrameLoop(FrameLoop&& other) noexcept;
  FrameLoop& operator=(FrameLoop&& other) noexcept;

  /// Run frames; the histories go on from the last call.
  /// @param times receives the passes' times of every frame, unless null. Consecutive passes that run the same
  ///        pipeline are one (`PassWork`)
  /// @returns the number of frames
  /// @throws fg::vk::Error when the device fails
  std::size_t run(const LoopLength& length, FrameTimes* times);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace walr
