#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "samples/bench/build_info.h"
#include "samples/bench/variant.h"
#include "samples/denoise/gpu_device.h"
#include "samples/gpu_report/agreement.h"
#include "samples/gpu_report/bandwidth.h"
#include "samples/gpu_report/clocks.h"
#include "samples/gpu_report/method_times.h"
#include "samples/gpu_report/validation_run.h"
#include "samples/sequence/sequence.h"

namespace walr {

struct GpuReportOptions {
  GpuDevice::Options gpu;
  std::vector<Variant> variants;
  std::vector<fg::Extent> sizes;       ///< In pixels; methods are timed at each of them.
  std::filesystem::path output;        ///< Folder that receives all files.
  const Sequence* sequence = nullptr;  ///< Also time and compare frames of it; null: none.
  std::string sequenceName;
  /// A folder with an earlier report, from which results are taken to compare with; empty: a processor's Vulkan driver
  /// computes them, if there is one.
  std::filesystem::path against;
  std::string machine;   ///< Name of the machine of the estimates; empty: by the device's name.
  double minutes = 8.0;  ///< What has not begun after this time is left out.
  bool quick = false;    ///< As short as possible: a test of the command, whose times mean nothing.
};

/// The device of a report.
struct ReportedDevice {
  std::string name;
  std::string driver;
  bool software = false;
  std::string apiVersion;
  std::uint32_t vendorId = 0;
  std::uint32_t deviceId = 0;
  double timestampNanoseconds = 0.0;  ///< 0 if its queue has no timestamps.
  struct Heap {
    std::uint64_t bytes = 0;
    bool deviceLocal = false;
  };
  std::vector<Heap> heaps;
};

/// Everything that was measured.
struct GpuReport {
  BuildInfo build;
  ReportedDevice device;
  double seconds = 0.0;  ///< Duration of the whole run.
  bool quick = false;
  std::string clockSource;
  std::string whyNoClocks;
  std::vector<ClockReading> clocks;
  ValidationRun validation;
  Bandwidth bandwidth;
  std::optional<ModelMachines> machines;
  std::string whyNoMachine;  ///< Why there are no estimates; empty if there are.
  std::vector<ContentMethodTimes> times;
  std::string reference;  ///< What the results are compared with: a device or a folder; empty: nothing.
  std::string whyNoReference;
  std::vector<Agreement> agreements;
};

/// Validate, measure and compare.
/// @param progress called with a line about every step
/// @throws fg::vk::Error if there is no device or it fails; InputError; OutputError; std::invalid_argument naming an
///         unknown machine
GpuReport gpuReport(const GpuReportOptions& options, const std::function<void(const std::string&)>& progress);

}  // namespace walr
