#pragma once

#include <cstddef>
#include <filesystem>
#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include "samples/bench/bench_frame.h"
#include "samples/bench/build_info.h"
#include "samples/bench/numerics.h"
#include "samples/bench/plan_costs.h"
#include "samples/bench/response.h"
#include "samples/bench/run_record.h"
#include "samples/bench/variant.h"
#include "samples/denoise/gpu_device.h"
#include "samples/sequence/sequence.h"

namespace walr {

/// A sequence and its name, which is that of its folder.
struct NamedSequence {
  std::string name;
  std::filesystem::path folder;
  Sequence sequence;
};

/// Open sequences.
/// @throws InputError naming a folder that cannot be read, has no reference, or shares its name with another
std::vector<NamedSequence> openSequences(const std::vector<std::filesystem::path>& folders,
                                         const SequenceOptions& options);

struct BenchOptions {
  std::vector<Variant> variants;  ///< The baseline first (`withBaseline`).
  std::filesystem::path output;   ///< Folder in which finished runs are stored, and found again.
  std::size_t repetitions = 3;    ///< Timed passes over each sequence; 0: no times.
  /// Number of variants that run in alternation, including the baseline, which runs in every batch. More variants need
  /// more device memory and lose more work when interrupted.
  std::size_t batch = 10;
  bool hardCases = false;    ///< Also run the hard cases of the arithmetic (`numerics`, `methodHardCases`).
  bool allPictures = false;  ///< Keep the images of all frames with a reference, not of `pictureFrames` only.
  bool response = false;     ///< Also run all variants on the synthetic scenes (`responses`).
};

/// Results of one sequence.
struct SequenceReport {
  std::string name;
  std::string layout;
  fg::Extent extent;
  std::vector<FrameFacts> frames;
  std::vector<int> pictureFrames;
  std::vector<RunRecord> runs;  ///< In the order of the variants.
};

/// The device of the measurements.
struct DeviceFacts {
  std::string name;
  std::string driver;
  bool software = false;  ///< The device is a CPU implementation of Vulkan: its times do not predict those of a GPU.
  double timestampNanoseconds = 0.0;  ///< Resolution of the timer; 0: none.
};

/// All results of a benchmark.
struct BenchReport {
  bool specular = false;  ///< Of which light: specular or indirect.
  BuildInfo build;
  DeviceFacts device;
  std::size_t repetitions = 0;
  std::vector<Variant> variants;
  std::map<std::string, std::vector<SettingValue>> settings;  ///< All settings of every variant, by variant name.
  std::map<std::string, std::vector<PlanCosts>> costs;  ///< At the sequences' sizes and 720p to 4K; by variant name.
  std::vector<SequenceReport> sequences;
  std::vector<Response> responses;  ///< One per variant, or empty.
  std::vector<NumericsResult> numerics;
  std::vector<MethodHardCase> methodHardCases;
};

/// Run all variants that have no stored run, and report on all variants.
/// @param log  receives notes and progress
/// @param terminal  whether `log` is a terminal
/// @throws InputError, OutputError, fg::vk::Error
BenchReport bench(const GpuDevice& device, const std::vector<NamedSequence>& sequences, const BenchOptions& options,
                  std::ostream& log, bool terminal);

/// The folder with the images of a sequence: `VARIANT_FFFF.npy`, `VARIANT.errors_FFFF.npy` (RMSE, SSIM, FLIP),
/// `VARIANT.change_FFFF.npy` (`errorChange`, if the previous frame also has a reference), `_reference_FFFF.npy`,
/// `_noisy_FFFF.npy` and `_age_FFFF.npy` (for how many earlier frames the pixel's surface has been visible without a
/// gap).
std::filesystem::path pictureFolder(const std::filesystem::path& output, const std::string& sequence);

}  // namespace walr
