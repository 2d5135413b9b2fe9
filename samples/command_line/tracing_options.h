#pragma once

#include <cstdint>

#include <CLI/CLI.hpp>

#include "samples/command_line/arguments.h"

namespace walr {

/// Adds the options of the path tracer that `walr render` and `walr-host` share.
/// @param options receives their values: `render::RenderOptions` or `host::Tracer::Options`
template <typename Options>
void addTracingOptions(CLI::App& command, Options& options) {
  constexpr std::uint32_t kMostBounces = 1024;
  command.add_option("--bounces", options.bounces, "Largest number of surfaces after the first that reflect light")
      ->check(CLI::Range(0U, kMostBounces))
      ->capture_default_str();
  // Each has two sequences of random numbers, of noisy frames and of references.
  constexpr std::uint32_t kLargestSeed = (1U << 31U) - 1;
  command.add_option("--seed", options.seed, "Seed of the random numbers")
      ->check(CLI::Range(0U, kLargestSeed))
      ->capture_default_str();
  constexpr double kSlowest = 1e-3;
  constexpr double kFastest = 1e6;
  command.add_option("--fps", options.framesPerSecond, "Frames per second of the animation")
      ->check(numberFrom(kSlowest, kFastest))
      ->capture_default_str();
  command.add_option("--camera", options.camera, "Name of the camera or of its node; default: the first");
  command.add_option("--sky", options.sky,
                     "Equirectangular sky that replaces the scene's: an EXR file with R,G,B; its centre lies along -Z");
  command.add_flag("--jitter", options.jitter,
                   "Jitter the sample position within the pixel: 16 Halton points, one per frame");
}

}  // namespace walr
