#pragma once

#include <cstdint>

#include <CLI/CLI.hpp>

#include "passes/conventions/light_pattern.h"

namespace walr {

/// Largest value of `--resampled-frames`.
inline constexpr std::uint32_t kMostResampledFrames = 1000;

/// Adds `--resampled-frames` to a command.
void addResampledFrames(CLI::App& command, std::uint32_t& frames);

/// @param frames    value of `--resampled-frames`
/// @param light     pixels that have light
/// @param specular  whether surfaces have a specular lobe
/// @param onDevice  whether paths are traced on a Vulkan device
/// @throws UsageError if light is to be resampled and cannot be
void checkResampledFrames(std::uint32_t frames, const LightPattern& light, bool specular, bool onDevice);

}  // namespace walr
