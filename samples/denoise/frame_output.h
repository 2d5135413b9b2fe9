#pragma once

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

/// A frame with its result.
struct DenoisedFrame {
  Frame frame;
  Image indirect;  ///< 3 components: denoised demodulated diffuse indirect radiance.
  std::optional<double> gpuMilliseconds;
  std::vector<ViewPicture> views;
  std::vector<CounterValue> counters;
};

struct OutputOptions {
  std::filesystem::path directory;
  /// Write the lit image, albedo * (direct + indirect) + emission, instead of the indirect light.
  bool composite = false;
  /// Take the direct light of lit images from the reference, if there is one, so that only the indirect light differs.
  bool referenceDirect = false;
  bool png = false;               ///< Also write tone-mapped images as PNG.
  std::optional<float> exposure;  ///< Exposure of the PNGs in stops; absent: automatic, see `FrameWriter::write`.
};

/// The lit image without specular light: albedo * (direct + indirect) + emission. Non-finite values of albedo, direct
/// light and emission count as 0.
Image composite(const Image& indirect, const Image& direct, const Image& albedo, const Image& emission);

/// Writes the output files of frames.
class FrameWriter {
 public:
  explicit FrameWriter(OutputOptions options) : options_(std::move(options)) {}

  /// Write `denoised_FFFF.exr`, and views as `view_NAME_FFFF.exr` in single precision.
  ///
  /// With PNGs also `denoised_FFFF.png`, and `comparison_FFFF.png`: noisy | denoised | reference at one exposure. With
  /// composites both show the lit image first, and the light alone beside it (denoised) or in a row below (comparison).
  ///
  /// If no exposure is given, it is chosen by `autoExposure`, separately for the lit image and for the light alone,
  /// from the reference or, without one, from the result. It is chosen at the first frame and at each camera cut, and
  /// is constant in between so that frames can be compared.
  /// @throws OutputError; every file is either complete or absent
  void write(const DenoisedFrame& denoised);

 private:
  /// One frame in its versions: noisy, denoised and, if there is one, the reference.
  using Versions = std::vector<Image>;
  void writePngs(const DenoisedFrame& denoised, const Versions& light, const Versions& lit);

  OutputOptions options_;
  std::optional<float> litExposure_;
  std::optional<float> lightExposure_;
};

/// Measure a result against the frame's reference, if it has one.
FrameReport measure(const DenoisedFrame& denoised);

}  // namespace walr
