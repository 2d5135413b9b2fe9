#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "samples/estimate/wave_counts.h"

namespace walr {

/// The machine that estimates are for unless another one is named: the GPU of the WALR paper.
inline constexpr std::string_view kDefaultMachine = "w6800";

/// Peak rates of a GPU: an entry of machines.json, which is embedded in the program.
struct Machine {
  std::string name;
  std::string gpu;
  std::string deviceName;  ///< A part of the name that the Vulkan driver gives the GPU.
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

/// All machines of machines.json.
const std::vector<Machine>& machines();

/// @throws std::invalid_argument naming the unknown machine and the known ones
const Machine& machineNamed(std::string_view name);

/// The machine whose `deviceName` is a part of a Vulkan device's name; null if there is none.
const Machine* machineOfDevice(std::string_view vulkanName);

/// What bounds a dispatch on a machine, in microseconds.
struct Bounds {
  double bytes = 0.0;         ///< All memory traffic of the plan at the memory's peak rate.
  double instructions = 0.0;  ///< All instructions at the peak rate of all SIMDs.
  double fetches = 0.0;       ///< All fetches at the peak rate of all texture units.
  double latency = 0.0;       ///< One wave by itself, times the rounds in which the machine takes all waves.
  double slots = 0.0;         ///< As `latency`, but the last round counts by the share of the machine that it fills.

  /// The estimate: the largest of them.
  [[nodiscard]] double largest() const;
  /// "bytes", "instructions", "fetches" or "latency".
  [[nodiscard]] std::string_view nameOfLargest() const;
};

/// @param waves of 64 threads that AMD's SIMD holds at a time; a SIMD of other makers is taken to hold as many of its
/// own
Bounds boundsOn(const Machine& machine, const WaveCounts& wave, double threads, double waves, double bytes);

/// Bounds of dispatches that run side by side: the machine does the work of all of them, but waits for the slowest
/// alone, unless their waves do not fit on it together.
Bounds sideBySide(const Bounds& a, const Bounds& b);

/// Cycles of a SIMD of Navi 21 for a wave of 64 threads: 2 an instruction, 8 an integer multiplication. Transcendentals
/// run beside them at 8 each.
double simdCycles(const WaveCounts& wave);

}  // namespace walr
