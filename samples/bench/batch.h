#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "samples/bench/run_record.h"
#include "samples/bench/variant.h"
#include "samples/bench/vmaf.h"
#include "samples/denoise/gpu_device.h"
#include "samples/sequence/sequence.h"

namespace walr {

struct BatchOptions {
  std::size_t repetitions = 3;              ///< Timed passes over the sequence; at least 1.
  std::vector<int> pictureFrames;           ///< Frames whose pictures and error maps are kept.
  std::filesystem::path pictures;           ///< Folder for them; exists.
  const VmafTool* vmaf = nullptr;           ///< Computes VMAF, by way of clips in the same folder.
  std::function<void()> frameDone = [] {};  ///< Called after each frame of each pass over the sequence.
};

/// Run variants on the same frames beside each other: every frame goes through all of them before the next one, and
/// who is first moves on from frame to frame, so that whatever drifts hits all alike.
///
/// A first pass over the sequence warms up and measures errors; its times are dropped. The repetitions after it are
/// timed, and their results compared with the first pass bit by bit.
///
/// @param variants the first one is the baseline that ratios are against
/// @returns one record a variant
/// @throws InputError, OutputError, fg::vk::Error
std::vector<RunRecord> runBatch(const GpuDevice& device, const Sequence& sequence, std::span<const Variant> variants,
                                const BatchOptions& options);

}  // namespace walr
