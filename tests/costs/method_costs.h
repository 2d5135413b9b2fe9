#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "framegraph/declare/graph.h"
#include "samples/estimate/machine.h"
#include "tests/costs/listing.h"
#include "tests/costs/null_device.h"
#include "tests/costs/trip_counts.h"
#include "tests/light_sets.h"

namespace walr::costs {

/// A method with one of its presets, and the lights that it denoises in one graph.
struct MethodName {
  std::string method;
  std::string preset;  ///< Empty if the method has none.
  test::LightSet lights = {};

  /// "walr_paper:robust", "flr", "walr:standard both".
  [[nodiscard]] std::string text() const {
    return (preset.empty() ? method : method + ":" + preset) + lights.suffix(' ');
  }
};

/// All methods, each with all its presets and lights.
std::vector<MethodName> allMethods();

/// "METHOD", which stands for all its presets, or "METHOD:PRESET"; each with all lights.
/// @throws std::invalid_argument naming the unknown method or preset and the known ones
std::vector<MethodName> methodsNamed(const std::string& text);

/// What one pass of a plan costs. Passes one after the other that run the same pipeline, as the tiles of a picture do,
/// are one.
struct PassCosts {
  std::string pass;
  std::uint32_t batch = 0;  ///< Passes of one batch of the plan may run side by side. That of the first pass.
  std::string shader;
  std::vector<std::uint32_t> specialization;
  CompiledShader compiled;  ///< Without its assembly.
  std::uint64_t branches = 0;
  std::uint64_t fetchInstructions = 0;
  std::uint64_t groups = 0;
  std::uint64_t threads = 0;
  std::uint64_t bytes = 0;  ///< Of the plan: each texel that the pass accesses once.
  std::size_t loops = 0;
  std::optional<WaveCounts> wave;  ///< Nothing where the trip counts of the shader's loops are not known.

  /// Of a SIMD of Navi 21 for one wave, weighed by trip counts; nothing where these are not known.
  [[nodiscard]] std::optional<double> cyclesPerWave() const;
  /// ESTIMATED bounds of the pass's time on a machine; nothing where trip counts are not known.
  [[nodiscard]] std::optional<Bounds> boundsOn(const Machine& machine) const;
};

/// Costs of a method in the order of its plan.
struct MethodCosts {
  MethodName name;
  fg::Extent extent;
  std::vector<PassCosts> passes;
  std::uint64_t memoryBytes = 0;  ///< Of the plan: histories and transient textures.

  [[nodiscard]] double pixels() const { return static_cast<double>(extent.width) * extent.height; }
  /// Cycles of SIMDs of Navi 21 a pixel of the picture.
  [[nodiscard]] std::optional<double> cyclesPerPixel(const PassCosts& pass) const;
  [[nodiscard]] std::optional<double> cyclesPerPixel() const;
  /// ESTIMATED time on a machine: see `FrameEstimate`.
  [[nodiscard]] std::optional<double> microseconds(const Machine& machine) const;
};

/// @throws std::runtime_error naming what does not compile
MethodCosts methodCosts(const MethodName& name, fg::Extent extent, NullDevice& device, const TripCounts& trips);

}  // namespace walr::costs
