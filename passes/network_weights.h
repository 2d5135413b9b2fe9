#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace walr {

/// Widths of the network of which `smallFlnrWeights` are.
inline constexpr std::array<std::uint32_t, 4> kSmallFlnrWidths{16, 24, 32, 48};

/// Trained weights: passes/weights/flnr_small.f16, which CMake turns into source code. flnr_small.json beside it says
/// how they were trained.
std::span<const std::byte> smallFlnrWeights();

}  // namespace walr
