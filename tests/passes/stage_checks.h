#pragma once

#include <vector>

#include "tests/passes/walr_run.h"

namespace walr::test {

/// Largest share of pixels whose result may hang on a decision within rounding. Plane distances, of order 1, carry an
/// error below 5e-6, so that a threshold of 0.015 decides by chance for about 1e-3 of those that lie evenly below it;
/// a pixel looks at up to 216 of them along its traces, most of which lie in one plane, far below it.
inline constexpr double kUndecidedShare = 0.02;

/// A frame on a device, with the one before, which has no pixels where there is none.
struct DeviceFrame {
  reference::HostFrame frame;
  WalrStages previous;
  WalrStages current;
};

/// Hold every stage of a frame, but the regression over blocks, against the double-precision reference. Each stage is
/// given what the device's own stage before it left, so that a difference belongs to one stage and errors do not add
/// up.
void expectStages(const DeviceFrame& frame, const AnyWalr& settings);

/// Denoise frames in turn; every output must be finite, and the last frame's stages hold.
void expectSequence(const fg::vk::Device& device, const std::vector<reference::HostFrame>& frames,
                    const AnyWalr& settings);

}  // namespace walr::test
