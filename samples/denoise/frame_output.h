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

/// A view of the method's inner workings.
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
  bool composite = false;  ///< Write the lit picture, albedo * (direct + indirect) + emission, not the indirect light.
  /// Light pictures with the reference's direct light where there is one, so that only the indirect light differs.
  bool referenceDirect = false;
  bool png = false;               ///< Also write tone-mapped pictures.
  std::optional<float> exposure;  ///< Of the PNGs, in stops; absent: chosen from the pictures, see `FrameWriter`.
};

/// The lit picture without specular light: albedo * (direct + indirect) + emission. Values of albedo, direct light or
/// emission that are not finite count as 0.
Image composite(const Image& indirect, const Image& direct, const Image& albedo, const Image& emission);

/// Writes the files of one frame after another.
class FrameWriter {
 public:
  explicit FrameWriter(OutputOptions options) : options_(std::move(options)) {}

  /// Write `denoised_FFFF.exr`. Views go to `view_NAME_FFFF.exr`, in single precision.
  ///
  /// With PNGs also `denoised_FFFF.png`, and `comparison_FFFF.png`: noisy | denoised | reference at one exposure. With
  /// composites the lit picture comes first in both and the light alone beside it or in a row below.
  ///
  /// Where no exposure is given, it is that of `autoExposure` for the lit picture and another for the light alone, from
  /// the reference or else the result of the first frame and of each frame after a camera cut. It stays in between, so
  /// that frames can be compared.
  /// @throws OutputError; every file is whole or absent
  void write(const DenoisedFrame& denoised);

 private:
  /// The same frame noisy, denoised and, where there is one, as its reference.
  using Versions = std::vector<Image>;
  void writePngs(const DenoisedFrame& denoised, const Versions& light, const Versions& lit);

  OutputOptions options_;
  std::optional<float> litExposure_;
  std::optional<float> lightExposure_;
};

/// Measure a result against the frame's reference, if it has one.
FrameReport measure(const DenoisedFrame& denoised);

}  // namespace walr
