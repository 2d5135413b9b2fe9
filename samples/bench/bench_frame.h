#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "samples/denoise/packed_frame.h"
#include "samples/metrics/display.h"
#include "samples/metrics/temporal.h"
#include "samples/sequence/sequence.h"

namespace walr {

/// A frame with all that its measurement needs.
struct BenchFrame {
  PackedFrame packed;
  VisibleSurfaces surfaces;
};

/// Read a frame.
/// @throws InputError
BenchFrame readBenchFrame(const Sequence& sequence, std::size_t index);

/// What is known of a frame before any method has run.
struct FrameFacts {
  int number = 0;
  bool resetHistory = false;
  bool hasReference = true;
  std::optional<double> disoccluded;     ///< Share of the pixels that were not visible in the frame before.
  std::optional<double> referenceNoise;  ///< See `referenceNoise`.
};

/// Facts of all frames.
/// @throws InputError
std::vector<FrameFacts> survey(const Sequence& sequence);

/// The frames whose pictures are kept, chosen by the input alone among those that have a reference: the last one, and
/// the one with the largest disocclusion after history has built up.
/// @param facts  at least one of a frame with a reference
std::vector<int> pictureFrames(const std::vector<FrameFacts>& facts);

}  // namespace walr
