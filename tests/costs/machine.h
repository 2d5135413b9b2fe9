#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "tests/costs/listing.h"

namespace walr::costs {

/// Peak rates of a GPU: read from machines.json.
struct Machine {
  std::string name;
  std::string gpu;
  double simds = 0.0;
  double threadsPerWave = 0.0;
  double cyclesPerSecond = 0.0;
  double cyclesPerInstruction = 0.0;  ///< Of a wave and SIMD.
  double cyclesPerMultiplication = 0.0;
  double latencyCyclesPerInstruction = 0.0;  ///< Between two instructions of a wave that is alone.
  double texelsPerSecond = 0.0;
  double fetchLatency = 0.0;  ///< Seconds.
  double bytesPerSecond = 0.0;
};

/// @throws std::runtime_error naming the unknown machine and the known ones, or the file
Machine readMachine(const std::filesystem::path& file, std::string_view name);

/// What bounds a dispatch on a machine, in microseconds.
struct Bounds {
  double bytes = 0.0;         ///< All memory traffic of the plan at the memory's peak rate.
  double instructions = 0.0;  ///< All instructions at the peak rate of all SIMDs.
  double fetches = 0.0;       ///< All fetches at the peak rate of all texture units.
  double latency = 0.0;       ///< One wave by itself, times the rounds in which the machine takes all waves.

  /// The estimate: the largest of them.
  [[nodiscard]] double largest() const;
};

/// @param waves of 64 threads that AMD's SIMD holds at a time; a SIMD of other makers is taken to hold as many of its
/// own
Bounds boundsOn(const Machine& machine, const WaveCounts& wave, double threads, double waves, double bytes);

/// Cycles of a SIMD of Navi 21 for a wave of 64 threads: 2 an instruction, 8 an integer multiplication. Transcendentals
/// run beside them at 8 each.
double simdCycles(const WaveCounts& wave);

}  // namespace walr::costs
