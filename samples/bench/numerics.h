#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "samples/bench/variant.h"
#include "samples/denoise/frame_output.h"
#include "samples/denoise/gpu_device.h"

namespace walr {

/// One way of storing and solving.
struct NumericsSetting {
  std::string storage;         ///< As `regression.moments` takes it.
  std::string regularisation;  ///< As `regression.regularisation` takes it.
  std::string epsilon;         ///< As `regression.ridge` takes it: the ridge or the floor.
};

/// Every storage, both ways of solving, a range of epsilons.
std::vector<NumericsSetting> numericsSettings();

/// What was made of a hard case.
struct HardCaseErrors {
  std::string hardCase;
  /// Root mean square error over the root mean square of the truth, linear, one frame without history; the error itself
  /// where the truth is 0. Values that are not finite are left out and counted.
  double error = 0.0;
  std::size_t nonFiniteIn = 0;   ///< Values of the noisy light that are not finite.
  std::size_t nonFiniteOut = 0;  ///< The result's.
  std::size_t negativeOut = 0;   ///< Values of the result below 0.
  /// What the method counted: values that are not finite and how they were met, samples and fits that were missing,
  /// regularised or clamped. By the names that `walr denoise --counters` prints.
  std::vector<CounterValue> counters;
};

/// By one way of storing and solving.
struct NumericsResult : HardCaseErrors {
  NumericsSetting setting;
};

/// By a method.
struct MethodHardCase : HardCaseErrors {
  std::string variant;
};

/// Every hard case (`hardCases`) through WALR's regression, 27 x 27 pixels, with every setting. The temporal stages
/// keep no history.
/// @throws fg::vk::Error when the device fails
std::vector<NumericsResult> numerics(const GpuDevice& device, std::span<const NumericsSetting> settings);

/// Every hard case through every method as it is, first frame of a history.
/// @throws fg::vk::Error when the device fails
std::vector<MethodHardCase> methodHardCases(const GpuDevice& device, std::span<const Variant> variants);

}  // namespace walr
