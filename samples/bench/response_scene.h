#pragma once

#include <vector>

#include "framegraph/declare/graph.h"
#include "samples/denoise/packed_frame.h"

namespace walr {

/// A frame of a synthetic scene, whose noise-free light is known.
struct KnownFrame {
  PackedFrame packed;  ///< In the project's own layout.
  Image truth;         ///< 3 components: the radiance that the noisy light is a sample of.
  /// Frames since the surface of a pixel came into view; `kAlwaysInView` where nothing ever hid it, -1 on what moves.
  std::vector<int> age;
};

inline constexpr int kAlwaysInView = 1000;

/// Frame of `lightFrame` from which on the light is down to a tenth.
inline constexpr int kLightChange = 24;
inline constexpr int kLightFrames = 80;
inline constexpr int kSlabFrames = 40;

/// A still, normal-mapped wall in smooth light, which goes down to a tenth at `kLightChange`. Every pixel gets light
/// with a probability of 1/4, as paths through a door do: four times the mean, give or take half.
KnownFrame lightFrame(fg::Extent extent, int frame);

/// Pixels a frame by which the light of `movingLightFrame` moves to the right, and its standard deviation in pixels.
inline constexpr float kLightSpeed = 1.0F;
inline constexpr float kLightSigma = 20.0F;
inline constexpr int kMovingLightFrames = 48;

/// The same still wall, lit by a round spot of light that moves over it, which no motion vector tells.
/// @param frame  may be below 0: where the light has been before
KnownFrame movingLightFrame(fg::Extent extent, int frame);

/// Frame of `cutFrame` that shows another place.
inline constexpr int kCut = 16;

/// A cut of the camera: until `kCut` the wall in steady light, from then on another, darker one farther away. Motion
/// vectors say that nothing moved.
/// @param told  whether the frame of the cut says that history is void
KnownFrame cutFrame(fg::Extent extent, int frame, bool told);

/// The same wall in steady light, and before it a brighter slab that moves four pixels a frame to the right.
KnownFrame slabFrame(fg::Extent extent, int frame);

}  // namespace walr
