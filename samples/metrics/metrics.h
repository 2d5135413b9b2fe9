#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "samples/image/image.h"
#include "samples/metrics/display.h"

namespace walr {

/// How far a picture is from its reference, after the tone map x / (1 + x) (`toneMap`), over the pixels of a mask.
/// A figure is absent where it has no value: all of them where the mask is empty, PSNR where the pictures are equal,
/// SSIM where no 11 x 11 window fits.
struct ErrorFigures {
  std::optional<double> rmse;  ///< Root of the mean squared difference over pixels and RGB; 0..1, 0 is equal.
  std::optional<double> psnr;  ///< Decibel against a peak of 1: -20 log10(rmse).
  std::optional<double> ssim;  ///< Structural similarity, mean over pixels and RGB; at most 1, 1 is equal.
};

/// Pixels with a diffuse lobe: albedo of at least 0.01 in some channel, a normal that is not zero, and a depth below
/// `skyDepth`. Pixels where the reference is not finite are left out.
PixelMask diffuseMask(const Image& albedo, const Image& normal, const Image& depth, float skyDepth,
                      const Image& reference);

/// Compare two linear RGB pictures of one size.
///
/// SSIM as in Wang et al. 2004 (III.B and III.C): 11 x 11 Gaussian window of sigma 1.5,
/// K1 = 0.01, K2 = 0.03, dynamic range 1, only windows that lie inside the picture. Pixels outside the mask take the
/// reference's value in both pictures, and do not count in the mean. Values that are not finite: see `display`.
ErrorFigures compare(const Image& test, const Image& reference, const PixelMask& mask);
/// The same for pictures that were made displayable with that mask already.
ErrorFigures compare(const DisplayedPair& pair, const PixelMask& mask);

/// Mean over the mask's pixels and RGB of (x - r)^2 / (r^2 + 0.01), in linear radiance without a tone map (Rousselle et
/// al. 2011). A value of `test` that is not finite counts as 65504, the largest half float.
/// @returns nothing where the mask is empty
std::optional<double> relativeMse(const Image& test, const Image& reference, const PixelMask& mask);

/// Noise of a reference R from one half A of its samples, B = 2 R - A the other: the root mean square of
/// (T(A) - T(B)) / 2, with T the tone map, which is the RMSE (`compare`) that a perfect result would have against R.
/// @returns nothing where the mask is empty
std::optional<double> referenceNoise(const Image& reference, const Image& half, const PixelMask& mask);

/// Number of values of an image that are not finite.
std::size_t countNonFinite(const Image& image);

/// Mean of figures over frames, each over those frames that have it.
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
