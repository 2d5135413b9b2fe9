#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "samples/metrics/display.h"

namespace walr {

/// The surfaces that a frame shows.
struct VisibleSurfaces {
  Image depth;     ///< 1 component: linear view depth, scene units.
  Image normal;    ///< 3 components: unit normal, in one space for all frames.
  Image motion;    ///< 3 components: pixels, previous = current + motion, y down; z: previous minus current view depth.
  PixelMask mask;  ///< Pixels that count.
};

/// Stands for no pixel in `previousPixels`.
inline constexpr std::uint32_t kNoPixel = ~0U;

/// For every pixel that counts, the pixel of the frame before that shows the same surface: the nearest one to where the
/// motion leads. `kNoPixel` where that lies outside the picture, does not count, or is another surface, its depth off
/// by more than 3 % of what motion says or its normal by more than 30 degrees: a disocclusion.
std::vector<std::uint32_t> previousPixels(const VisibleSurfaces& current, const VisibleSurfaces& previous);

/// Share of the pixels that count which were not visible in the frame before; nothing where no pixel counts.
std::optional<double> disoccludedShare(const std::vector<std::uint32_t>& previousPixels, const PixelMask& mask);

/// How much of a picture's luminance changes from a frame to the next.
struct LuminanceChange {
  double test = 0.0;       ///< Mean over pixels of |Y_t - Y_(t-1)|, in 0..1.
  double reference = 0.0;  ///< The reference's own.
};

/// Change at fixed pixels, over those that count in both frames: what an eye that does not move sees. It is to be read
/// beside the reference's own, which moves too where the camera does.
/// @returns nothing where no pixel counts in both
std::optional<LuminanceChange> luminanceChange(const DisplayedPair& current, const DisplayedPair& previous,
                                               const PixelMask& currentMask, const PixelMask& previousMask);

/// Change, from a frame to the next on the same surface, of the error in luminance, divided by the square root of 2, at
/// every pixel; not a number where there is no previous pixel. The nearest pixel is taken, because interpolation would
/// smooth the noise.
std::vector<double> errorChange(const DisplayedPair& current, const DisplayedPair& previous,
                                const std::vector<std::uint32_t>& previousPixels);

/// Flicker along motion: the root mean square of `errorChange`. White noise of standard deviation s on top of the
/// reference gives s; an error that stays with its surface gives 0. Pixels without a previous one do not count.
/// @returns nothing where no pixel has a previous one
std::optional<double> flicker(std::span<const double> errorChange);

}  // namespace walr
