#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "passes/network/guide_network.h"

namespace walr {

/// Widths of the networks of `flnrWeights`.
inline constexpr std::array<std::uint32_t, 4> kFlnrWidths{16, 24, 32, 48};

/// Trained weights: the files passes/network/weights/flnr_*.f16, which CMake turns into source code. The .json files
/// beside them say how they were trained.
std::span<const std::byte> flnrWeights(NetworkKind kind);

}  // namespace walr
