#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "samples/denoise/report.h"
#include "samples/image/image.h"
#include "samples/sequence/frame.h"

namespace walr {

/// A view of a quantity inside the method.
struct ViewPicture {
  std::string name;
  Image image;  ///< 3 components.
};

/// How the light changes with x, y and z of the normal, view space: 3 components each; empty if not asked for.
using LightSlopes = std::array<Image, 3>;

/// A frame with its result.
struct DenoisedFrame {
  Frame frame;
  Image indirect;  ///< 3 components: denoised demodulated diffuse indirect radiance; empty if it is not denoised.
  Image direct;    ///< The same of direct radiance.
  Image specular;  ///< The same of `Frame::specular`.
  std::optional<double> gpuMilliseconds;
  std::vector<ViewPicture> views;
  std::vector<CounterValue> counters;
  LightSlopes slopes;
};

struct OutputOptions {
  std::filesystem::path directory;
  /// Write the lit image, albedo * (direct + indirect) + emission + light that is not diffuse, beside the lights.
  bool composite = false;
  std::string indirectPlane = "Indirect";  ///< Names of the planes with the denoised lights.
  std::string directPlane = "Direct";
  /// Take the direct light of lit images from the reference, if there is one, so that only the indirect light differs.
  bool referenceDirect = false;
  bool png = false;                    ///< Also write tone-mapped images as PNG.
  std::optional<float> exposure = {};  ///< Exposure of the PNGs in stops; absent: automatic, see `FrameWriter::write`.
};

/// The lit image without light that is not diffuse: albedo * (direct + indirect) + emission. Non-finite values of
/// albedo, direct light and emission count as 0.
Image composite(const Image& indirect, const Image& direct, const Image& albedo, const Image& emission);

/// Writes the output files of frames.
class FrameWriter {
 public:
  explicit FrameWriter(OutputOptions options) : options_(std::move(options)) {}

  /// Write `denoised_FFFF.exr` with the denoised lights and, if requested, the lit image as R,G,B; views as
  /// `view_NAME_FFFF.exr` in single precision; and slopes as `direction_FFFF.exr`.
  ///
  /// With PNGs also `denoised_FFFF.png`, and `comparison_FFFF.png`: noisy | denoised | reference at one exposure. With
  /// composites both show the lit image first. Each denoised light alone is beside it (denoised) or in a row below
  /// (comparison).
  ///
  /// If no exposure is given, it is chosen by `autoExposure`, separately for the lit image and for each light, from the
  /// reference or, without one, from the result. It is chosen at the first frame and at each camera cut, and is
  /// constant in between so that frames can be compared.
  ///
  /// @param shown  the lights as the pictures show them: `averagedLights`, or the frame itself. The lit image is lit at
  ///               the size of the frame, and then averaged over all pixels of a square of `shown`. Views and slopes
  ///               keep the size of the frame.
  /// @throws OutputError; every file is either complete or absent
  void write(const DenoisedFrame& denoised, const DenoisedFrame& shown);
  void write(const DenoisedFrame& denoised) { write(denoised, denoised); }

 private:
  /// A picture of a frame: noisy, denoised and, if there is one, the reference.
  using Versions = std::vector<const Image*>;
  [[nodiscard]] std::filesystem::path path(const std::string& prefix, const Frame& frame,
                                           const char* extension = "exr") const;
  /// The lit image in its versions.
  [[nodiscard]] std::vector<Image> litImages(const DenoisedFrame& denoised) const;
  /// Write the pictures of the lights and of the lit image, which have one size.
  void writePictures(const DenoisedFrame& shown, const std::vector<Image>& lit);
  /// @param rows  the pictures of the frame, the same in all frames
  void writePngs(const Frame& frame, const std::vector<Versions>& rows);

  OutputOptions options_;
  std::vector<std::optional<float>> exposures_;  // Of the rows.
};

/// Measure a result against the frame's reference, if it has one.
/// @param shown  as for `FrameWriter::write`; errors are those of its lights. Non-finite values are counted in
/// `denoised`.
FrameReport measure(const DenoisedFrame& denoised, const DenoisedFrame& shown);
inline FrameReport measure(const DenoisedFrame& denoised) {
  return measure(denoised, denoised);
}

}  // namespace walr
