#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "samples/image/image.h"
#include "samples/metrics/display.h"

namespace walr {

/// Errors of an image against its reference, after the tone map x / (1 + x) (`toneMap`), over the pixels of a mask. All
/// are absent if the mask is empty; PSNR is absent if the images are equal; SSIM is absent if no 11 x 11 window fits.
struct ErrorFigures {
  std::optional<double> rmse;  ///< Root mean square difference over pixels and RGB, 0..1; 0 if the images are equal.
  std::optional<double> psnr;  ///< Decibels against a peak of 1: -20 log10(rmse).
  std::optional<double> ssim;  ///< Structural similarity, mean over pixels and RGB; 1 if the images are equal.
};

/// Mask of the pixels with a diffuse lobe: an albedo of at least 0.01 in some channel, a normal that is not zero, and a
/// depth below `skyDepth`.
PixelMask diffuseMask(const Image& albedo, const Image& normal, const Image& depth, float skyDepth);
/// Those of them where the reference is known, which means finite.
PixelMask diffuseMask(const Image& albedo, const Image& normal, const Image& depth, float skyDepth,
                      const Image& reference);

/// Compare two linear RGB images of one size. `display` tone-maps them and handles masked and non-finite pixels.
///
/// SSIM as in Wang et al. 2004 (III.B, III.C): 11 x 11 Gaussian window of sigma 1.5, K1 = 0.01, K2 = 0.03, dynamic
/// range 1. Only windows that lie inside the image are used. Pixels outside the mask lie in windows, with the
/// reference's value in both images, but their own SSIM does not count in the mean.
ErrorFigures compare(const Image& test, const Image& reference, const PixelMask& mask);
/// The same for the result of `display` with the same mask.
ErrorFigures compare(const DisplayedPair& pair, const PixelMask& mask);

/// Their RMSE alone, which takes far less time; nullopt if the mask is empty.
std::optional<double> rmseOf(const DisplayedPair& pair, const PixelMask& mask);

/// Relative mean squared error in linear radiance, without a tone map: the mean of (x - r)^2 / (r^2 + 0.01) over the
/// mask's pixels and RGB (Rousselle et al. 2011). A non-finite value of `test` counts as 65504, the largest half float.
/// @returns nullopt if the mask is empty
std::optional<double> relativeMse(const Image& test, const Image& reference, const PixelMask& mask);

/// Estimate the noise of a reference R: the RMSE (`compare`) that a noise-free image would have against R. `half` is A,
/// the mean of one half of R's samples; the mean of the other half is B = 2 R - A. The estimate is the root mean square
/// of (T(A) - T(B)) / 2, where T is the tone map.
/// @returns nullopt if the mask is empty
std::optional<double> referenceNoise(const Image& reference, const Image& half, const PixelMask& mask);

/// The mean squared error of a result without the reference's noise: the mean of (T(x) - T(A)) (T(x) - T(B)), A, B and
/// T as for `referenceNoise`. Where light is rare, that subtracts the noise more exactly than the square of
/// `referenceNoise` does, which the tone map makes too small. Chance can make it negative.
/// @param test  T(x), as `display` makes it
/// @returns nullopt if the mask is empty
std::optional<double> cleanSquare(const Image& test, const Image& reference, const Image& half, const PixelMask& mask);

/// Number of values of an image that are not finite.
std::size_t countNonFinite(const Image& image);

/// Means of error figures over frames. A frame without a value for a figure does not count in the mean of that figure.
class MeanFigures {
 public:
  void add(const ErrorFigures& figures);
  [[nodiscard]] ErrorFigures mean() const;

 private:
  struct Sum {
    double total = 0.0;
    std::size_t count = 0;
    void add(const std::optional<double>& value);
    [[nodiscard]] std::optional<double> mean() const;
  };
  Sum rmse_;
  Sum psnr_;
  Sum ssim_;
};

}  // namespace walr
