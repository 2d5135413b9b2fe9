#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "samples/bench/timing.h"
#include "samples/bench/variant.h"
#include "samples/denoise/gpu_device.h"

namespace walr {

/// Times of a variant at one image size.
struct SizeTiming {
  std::string variant;
  Timing timing;
  std::string whyNot;  ///< Why the variant does not run at this size, as text; empty if it does.
};

/// Times of all variants at one image size.
struct SizeTimes {
  fg::Extent extent;
  std::vector<SizeTiming> timings;
};

/// Time variants in alternation on two frames of a synthetic scene (`slabFrame`), after one repetition that warms up. A
/// variant whose settings do not support the size, or that exceeds device memory, is reported in `SizeTiming::whyNot`.
/// @param variants   the first one is the baseline that time ratios refer to
/// @param frameDone  called after each frame: `kFramesPerRepetition` x (1 + repetitions) times
/// @throws fg::vk::Error if the baseline fails while it runs
SizeTimes sizeTimes(const GpuDevice& device, std::span<const Variant> variants, fg::Extent extent,
                    std::size_t repetitions, const std::function<void()>& frameDone);

}  // namespace walr
