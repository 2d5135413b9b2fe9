#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "samples/bench/run_record.h"
#include "samples/bench/variant.h"
#include "samples/denoise/gpu_device.h"
#include "samples/sequence/sequence.h"

namespace walr {

struct BatchOptions {
  std::size_t repetitions = 3;              ///< Timed passes over the sequence; 0: errors only.
  std::vector<int> pictureFrames;           ///< Frames whose images and error maps are kept.
  std::filesystem::path pictures;           ///< Existing folder for these images.
  std::function<void()> frameDone = [] {};  ///< Called after each frame of each pass over the sequence.
};

/// Run variants on the same frames in alternation: all variants denoise a frame before any of them denoises the next.
/// Their order rotates from frame to frame, so that drift of the machine affects all variants alike.
///
/// A first pass over the sequence warms up and measures errors; its times are discarded. The repetitions after it are
/// timed, and their results are compared with those of the first pass bit by bit.
///
/// @param variants  the first one is the baseline that time ratios refer to
/// @returns one record per variant
/// @throws InputError, OutputError, fg::vk::Error
std::vector<RunRecord> runBatch(const GpuDevice& device, const Sequence& sequence, std::span<const Variant> variants,
                                const BatchOptions& options);

}  // namespace walr
