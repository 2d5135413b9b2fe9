#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "samples/bench/timing.h"
#include "samples/bench/variant.h"
#include "samples/denoise/gpu_device.h"

namespace walr {

/// How long a variant takes at one size of picture.
struct SizeTiming {
  std::string variant;
  Timing timing;
  std::string whyNot;  ///< In words, where it does not run at that size.
};

/// All variants at one size.
struct SizeTimes {
  fg::Extent extent;
  std::vector<SizeTiming> timings;
};

/// Time variants beside each other on two frames of a synthetic scene in turn (`slabFrame`), after one repetition that
/// warms up. Where settings do not go with a size, or the device's memory does not hold it, that is said.
/// @param variants   the first one is the baseline that ratios are against
/// @param frameDone  called after each frame, `kFramesPerRepetition` times (1 + repetitions) times
/// @throws fg::vk::Error where the baseline fails while it runs
SizeTimes sizeTimes(const GpuDevice& device, std::span<const Variant> variants, fg::Extent extent,
                    std::size_t repetitions, const std::function<void()>& frameDone);

}  // namespace walr
