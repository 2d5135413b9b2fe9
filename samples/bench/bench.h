#pragma once

#include <cstddef>
#include <filesystem>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "samples/bench/bench_frame.h"
#include "samples/bench/build_info.h"
#include "samples/bench/content_times.h"
#include "samples/bench/device_facts.h"
#include "samples/bench/numerics.h"
#include "samples/bench/plan_costs.h"
#include "samples/bench/response.h"
#include "samples/bench/run_record.h"
#include "samples/bench/size_times.h"
#include "samples/bench/variant.h"
#include "samples/bench/vmaf.h"
#include "samples/denoise/gpu_device.h"
#include "samples/sequence/sequence.h"

namespace walr {

/// A sequence under the name of its folder.
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
  std::filesystem::path output;   ///< Finished runs are kept and found again in it.
  std::size_t repetitions = 3;    ///< Timed passes over each sequence.
  std::vector<fg::Extent> sizes;  ///< Also time all variants on synthetic frames of these sizes (`sizeTimes`).
  /// Variants that run beside each other. More need more device memory at once, and lose more when interrupted. The
  /// baseline runs in every batch.
  std::size_t batch = 10;
  std::optional<VmafTool> vmaf;  ///< Computes VMAF where there is one.
  std::string whyNoVmaf;         ///< In words, where there is none.
  bool hardCases = false;        ///< Also run the hard cases of the arithmetic (`numerics`, `methodHardCases`).
  bool content = false;          ///< Also time all variants by what the picture holds (`contentTimes`).
  bool response = false;         ///< Also run all variants on the synthetic scenes (`responses`).
};

/// What came of one sequence.
struct SequenceReport {
  std::string name;
  std::string layout;
  fg::Extent extent;
  std::vector<FrameFacts> frames;
  std::vector<int> pictureFrames;
  std::vector<RunRecord> runs;  ///< In the order of the variants.
};

/// All that a benchmark found.
struct BenchReport {
  BuildInfo build;
  DeviceFacts device;
  std::size_t repetitions = 0;
  std::string vmaf;       ///< What computed VMAF; empty where nothing did.
  std::string whyNoVmaf;  ///< In words, where nothing did.
  std::vector<Variant> variants;
  std::map<std::string, std::vector<SettingValue>> settings;  ///< All settings of every variant, by its name.
  std::map<std::string, std::vector<PlanCosts>> costs;        ///< At the sequences' sizes and 720p to 4K, by variant.
  std::vector<SequenceReport> sequences;
  std::vector<SizeTimes> sizes;
  std::vector<ContentTimes> contents;  ///< Of all variants, or empty.
  std::vector<Response> responses;     ///< Of all variants, or empty.
  std::vector<NumericsResult> numerics;
  std::vector<MethodHardCase> methodHardCases;
};

/// Run what has not been run yet, and report on all.
/// @param log  takes notes and progress
/// @param terminal  whether `log` is a terminal
/// @throws InputError, OutputError, fg::vk::Error
BenchReport bench(const GpuDevice& device, const std::vector<NamedSequence>& sequences, const BenchOptions& options,
                  std::ostream& log, bool terminal);

/// Where `bench` leaves the pictures of a sequence: `VARIANT_FFFF.npy`, `VARIANT.errors_FFFF.npy` (RMSE, SSIM, FLIP),
/// `VARIANT.change_FFFF.npy` (`errorChange`, where the frame before has a reference, too), `_reference_FFFF.npy` and
/// `_noisy_FFFF.npy`.
std::filesystem::path pictureFolder(const std::filesystem::path& output, const std::string& sequence);

}  // namespace walr
