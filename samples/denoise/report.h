#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "framegraph/declare/graph.h"
#include "samples/metrics/metrics.h"

namespace walr {

/// How often something happened inside a method in a frame (`Inspection`).
struct CounterValue {
  std::string name;
  std::uint64_t value = 0;
};

/// What a run measured on one frame.
struct FrameReport {
  int frame = 0;
  bool resetHistory = false;
  std::optional<double> gpuMilliseconds;  ///< By timestamps, all passes; absent where the queue has no timestamps.
  ErrorFigures denoised;                  ///< Absent figures where there is no reference.
  ErrorFigures noisy;                     ///< The input's own.
  /// RMSE that the noise of the reference itself adds to every result; absent if the reference lacks its two halves.
  std::optional<double> referenceNoise;
  std::size_t nonFiniteOutput = 0;     ///< Number of non-finite values in the result.
  std::vector<CounterValue> counters;  ///< The same names in every frame; empty unless counters were requested.
};

/// What a run was and what it measured.
struct DenoiseReport {
  std::string method;
  std::vector<std::pair<std::string, std::string>> settings;  ///< Name and value of every setting of the method.
  std::string device;
  std::string driver;
  bool softwareDevice = false;
  std::string layout;
  fg::Extent extent;
  std::vector<FrameReport> frames;
};

/// Frames at the start of a sequence in which history still builds up; a second mean leaves them out.
inline constexpr std::size_t kWarmUpFrames = 4;

/// Mean over the frames from `first` on, each figure over the frames that have it.
FrameReport meanReport(const std::vector<FrameReport>& frames, std::size_t first);

/// The report as JSON, as samples/denoise/denoise.schema.json describes it.
std::string reportJson(const DenoiseReport& report);

/// The report as a table for people.
void printReport(std::ostream& stream, const DenoiseReport& report);

}  // namespace walr
