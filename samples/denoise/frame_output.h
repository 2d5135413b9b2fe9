#pragma once

#include <filesystem>
#include <optional>
#include <string>
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
  bool png = false;        ///< Also write tone-mapped pictures.
};

/// The lit picture without specular light: albedo * (direct + indirect) + emission. Values of albedo, direct light or
/// emission that are not finite count as 0.
Image composite(const Image& indirect, const Image& direct, const Image& albedo, const Image& emission);

/// Write `denoised_FFFF.exr`, and with PNGs `denoised_FFFF.png` and `comparison_FFFF.png` (noisy | denoised |
/// reference). Views go to `view_NAME_FFFF.exr`, in single precision.
/// @throws OutputError; every file is whole or absent
void writeDenoisedFrame(const DenoisedFrame& denoised, const OutputOptions& options);

/// Measure a result against the frame's reference, if it has one.
FrameReport measure(const DenoisedFrame& denoised);

}  // namespace walr
