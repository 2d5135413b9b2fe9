#pragma once

#include "framegraph/declare/graph.h"
#include "samples/denoise/frame_output.h"
#include "samples/image/image.h"

namespace walr {

/// The largest side of the squares of pixels that one pixel of a picture may stand for.
inline constexpr int kMostAveraged = 8;

/// The extent of a picture whose pixels are means over squares of `side` x `side` pixels.
/// @throws std::invalid_argument if the squares do not fill the extent
fg::Extent averagedExtent(fg::Extent extent, int side);

/// The mean of every square of `side` x `side` pixels.
Image averaged(const Image& image, int side);

/// A frame and its lights as a picture with fewer pixels shows them, for frames with several primary hits per pixel of
/// the picture.
///
/// A light is the mean over those pixels of a square that have a diffuse surface, because demodulated light means
/// nothing elsewhere, and over all if none has. Where indirect light is sparse, the noisy one is the mean over those
/// that have a sample. Albedo, normal and depth are those of the square's first diffuse surface, so that errors count a
/// square that has one. Emission, motion, views and slopes are left out.
DenoisedFrame averagedLights(const DenoisedFrame& denoised, int side);

}  // namespace walr
