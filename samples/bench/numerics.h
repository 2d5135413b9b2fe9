#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "samples/bench/variant.h"
#include "samples/denoise/frame_output.h"
#include "samples/denoise/gpu_device.h"

namespace walr {

/// One way of storing moments and solving the regression.
struct NumericsSetting {
  std::string storage;         ///< Value of `regression.moments`.
  std::string regularisation;  ///< Value of `regression.regularisation`.
  std::string epsilon;         ///< Value of `regression.ridge`: the ridge, or the floor of the pivots.
};

/// All combinations of storage, regularisation and a range of epsilons.
std::vector<NumericsSetting> numericsSettings();

/// Errors of a method's result for a hard case.
struct HardCaseErrors {
  std::string hardCase;
  /// Root mean square error divided by the root mean square of the truth, in linear radiance, for one frame without
  /// history. If the truth is 0, the error itself. Non-finite values are left out, and counted below.
  double error = 0.0;
  std::size_t nonFiniteIn = 0;   ///< Number of non-finite values in the noisy light.
  std::size_t nonFiniteOut = 0;  ///< Number of non-finite values in the result.
  std::size_t negativeOut = 0;   ///< Number of values below 0 in the result.
  /// Counters of the method, under the names that `walr denoise --counters` prints.
  std::vector<CounterValue> counters;
};

/// Errors with one way of storing and solving.
struct NumericsResult : HardCaseErrors {
  NumericsSetting setting;
};

/// Errors of one variant.
struct MethodHardCase : HardCaseErrors {
  std::string variant;
};

/// Run every hard case (`hardCases`) through the regression of `walr_paper` with every setting. The window is 27 x 27
/// pixels, and the temporal stages keep no history.
/// @throws fg::vk::Error when the device fails
std::vector<NumericsResult> numerics(const GpuDevice& device, std::span<const NumericsSetting> settings);

/// Run every hard case through every variant with its own settings, as the first frame of a history.
/// @throws fg::vk::Error when the device fails
std::vector<MethodHardCase> methodHardCases(const GpuDevice& device, std::span<const Variant> variants);

}  // namespace walr
