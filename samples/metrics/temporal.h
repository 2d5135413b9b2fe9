#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "samples/metrics/display.h"

namespace walr {

/// The surfaces that a frame shows, per pixel.
struct VisibleSurfaces {
  Image depth;     ///< 1 component: linear view depth, scene units.
  Image normal;    ///< 3 components: unit normal; all frames use one space.
  Image motion;    ///< 3 components: pixels, previous = current + motion, y down; z: previous minus current view depth.
  PixelMask mask;  ///< Pixels that count.
};

/// The value in `previousPixels` for a pixel without a previous pixel.
inline constexpr std::uint32_t kNoPixel = ~0U;

/// For every pixel of the mask, the index of the pixel of the previous frame that shows the same surface: the pixel
/// nearest to where the motion leads. `kNoPixel` for pixels outside the mask and for disocclusions: where that nearest
/// pixel lies outside the image or the previous mask, its depth differs by more than 3 % from the depth that the motion
/// predicts, or its normal differs by more than 30 degrees.
std::vector<std::uint32_t> previousPixels(const VisibleSurfaces& current, const VisibleSurfaces& previous);

/// Fraction of the mask's pixels that have no previous pixel; nullopt if the mask is empty.
std::optional<double> disoccludedShare(const std::vector<std::uint32_t>& previousPixels, const PixelMask& mask);

/// How much the luminance changes from one frame to the next.
struct LuminanceChange {
  double test = 0.0;       ///< Mean over pixels of |Y_t - Y_(t-1)|, in 0..1.
  double reference = 0.0;  ///< The same mean for the reference.
};

/// Luminance change at fixed pixel positions, as seen by an eye that does not follow motion, over the pixels in both
/// masks. Compare it with the change of the reference, which is not zero either when the camera or objects move.
/// @returns nullopt if no pixel is in both masks
std::optional<LuminanceChange> luminanceChange(const DisplayedPair& current, const DisplayedPair& previous,
                                               const PixelMask& currentMask, const PixelMask& previousMask);

/// At every pixel, the change of the error in luminance from the previous frame to this one on the same surface,
/// divided by the square root of 2. NaN where there is no previous pixel. Uses the nearest previous pixel, because
/// interpolation would smooth the noise.
std::vector<double> errorChange(const DisplayedPair& current, const DisplayedPair& previous,
                                const std::vector<std::uint32_t>& previousPixels);

/// Flicker along motion: the root mean square of `errorChange`. White noise of standard deviation s on top of the
/// reference gives s; an error that stays on its surface gives 0. Pixels without a previous pixel do not count.
/// @returns nullopt if no pixel has a previous pixel
std::optional<double> flicker(std::span<const double> errorChange);

}  // namespace walr
