#pragma once

#include <vector>

#include "tests/passes/walr_run.h"

namespace walr::test {

/// Largest share of undecided pixels. Plane distances are of order 1 and carry an error below 5e-6, so rounding decides
/// for about 1e-3 of the distances that are spread evenly below a threshold of 0.015. A pixel tests up to 216 distances
/// along its traces, but most of them lie in one plane, far below the threshold.
inline constexpr double kUndecidedShare = 0.02;

/// The stages of a frame on a device and those of the previous frame, which are empty if there was none.
struct DeviceFrame {
  reference::HostFrame frame;
  WalrStages previous;
  WalrStages current;
};

/// Compare every stage of a frame, except the regression over blocks, with the double-precision reference. The
/// reference of each stage starts from the device's own results of the stage before, so that a difference belongs to
/// one stage and errors do not add up.
void expectStages(const DeviceFrame& frame, const AnyWalr& settings);

/// Denoise frames in turn. Every output must be finite, and every stage of the last frame must match the reference.
void expectSequence(const fg::test::TestDevice& device, const std::vector<reference::HostFrame>& frames,
                    const AnyWalr& settings);
/// The same with a run that is used for several sequences, because a run takes long to make. It begins without history.
/// @param run made with the settings, the size of the frames, and their conventions and scene
void expectSequence(WalrRun& run, const std::vector<reference::HostFrame>& frames, const AnyWalr& settings);

}  // namespace walr::test
