#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "framegraph/declare/graph.h"
#include "samples/denoise/roughness_classes.h"
#include "samples/metrics/metrics.h"

namespace walr {

/// How often something happened inside a method in a frame (`Inspection`).
struct CounterValue {
  std::string name;
  std::uint64_t value = 0;
};

/// Errors of a light; absent if it is not denoised or has no reference.
struct LightErrors {
  ErrorFigures denoised;  ///< Of the result.
  ErrorFigures noisy;     ///< Of the noisy input.
  /// RMSE that the noise of the reference itself adds to every result; absent if the file of the reference does not
  /// hold the mean of half of its samples.
  std::optional<double> referenceNoise;
};

/// Measurements of one frame.
struct FrameReport {
  int frame = 0;
  bool resetHistory = false;
  std::optional<double> gpuMilliseconds;  ///< All passes, from timestamps; absent if the queue has no timestamps.
  LightErrors indirect;
  LightErrors direct;
  LightErrors specular;
  FiguresByRoughness byRoughness;      ///< RMSE of the denoised specular light.
  std::size_t nonFiniteOutput = 0;     ///< Number of non-finite values in the result.
  std::vector<CounterValue> counters;  ///< The same names in every frame; empty unless counters were requested.
};

/// Name and value of every setting of a method.
using SettingsText = std::vector<std::pair<std::string, std::string>>;

/// A run's method, device, input and measurements.
struct DenoiseReport {
  std::string method;
  SettingsText settings;  ///< Of the indirect light, or of the light that is denoised by itself.
  std::string device;
  std::string driver;
  bool softwareDevice = false;
  std::string layout;
  std::string light = "indirect";  ///< Which light is denoised: indirect, direct, both of them, specular, or all.
  fg::Extent extent;               ///< Of the frames.
  std::vector<FrameReport> frames = {};
  SettingsText directSettings = {};  ///< Of the direct light, if both are denoised.
  int average = 1;  ///< Pixels of a frame along each axis for one of its pictures; see `averagedLights`.
};

/// Number of frames at the start of a sequence in which history builds up. A second mean leaves them out.
inline constexpr std::size_t kWarmUpFrames = 4;

/// Mean over the frames from index `first` on; each value over the frames that have it.
FrameReport meanReport(const std::vector<FrameReport>& frames, std::size_t first);

/// The report as JSON, as samples/denoise/denoise.schema.json describes it.
std::string reportJson(const DenoiseReport& report);

/// Print the report as a table.
void printReport(std::ostream& stream, const DenoiseReport& report);

}  // namespace walr
