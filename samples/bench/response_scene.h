#pragma once

#include <vector>

#include "framegraph/declare/graph.h"
#include "samples/denoise/packed_frame.h"

namespace walr {

/// A frame of a synthetic scene with known noise-free light.
struct KnownFrame {
  PackedFrame packed;  ///< In the project's own layout.
  Image truth;         ///< 3 components: the radiance that is the expected value of the noisy light.
  /// Number of frames since the surface of a pixel came into view; `kAlwaysInView` if it was never hidden, -1 on the
  /// moving slab.
  std::vector<int> age;
};

inline constexpr int kAlwaysInView = 1000;

/// First frame of `lightFrame` in which the light is dimmed to a tenth.
inline constexpr int kLightChange = 24;
inline constexpr int kLightFrames = 80;
inline constexpr int kSlabFrames = 40;

/// A static, normal-mapped wall in smooth light, which is dimmed to a tenth at `kLightChange`. Each pixel receives
/// light with a probability of 1/4, as from paths through a door: four times the mean, varied by up to a half.
KnownFrame lightFrame(fg::Extent extent, int frame);

/// The light of `movingLightFrame`: its movement to the right in pixels per frame, and its standard deviation in
/// pixels.
inline constexpr float kLightSpeed = 1.0F;
inline constexpr float kLightSigma = 20.0F;
inline constexpr int kMovingLightFrames = 48;

/// The same static wall, lit by a round spot of light that moves over it. Motion vectors are 0.
/// @param frame  may be below 0: a time before the first frame
KnownFrame movingLightFrame(fg::Extent extent, int frame);

/// First frame of `cutFrame` after the cut.
inline constexpr int kCut = 16;

/// A camera cut: before `kCut` the wall in constant light, from then on another, darker wall farther away. Motion
/// vectors are 0.
/// @param told  whether the frame of the cut requests a reset of the history
KnownFrame cutFrame(fg::Extent extent, int frame, bool told);

/// The same wall in constant light and, in front of it, a brighter slab that moves four pixels per frame to the right.
KnownFrame slabFrame(fg::Extent extent, int frame);

}  // namespace walr
