#pragma once

#include <vector>

#include "framegraph/graph.h"
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

/// The same wall in steady light, and before it a brighter slab that moves four pixels a frame to the right.
KnownFrame slabFrame(fg::Extent extent, int frame);

}  // namespace walr
