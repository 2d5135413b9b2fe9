#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace walr {

/// Widths of the networks of `smallFlnrWeights` and `paperFlnrWeights`.
inline constexpr std::array<std::uint32_t, 4> kFlnrWidths{16, 24, 32, 48};

/// Trained weights: passes/weights/flnr_small.f16 and flnr_paper.f16, which CMake turns into source code. The .json
/// files beside them say how they were trained.
std::span<const std::byte> smallFlnrWeights();
std::span<const std::byte> paperFlnrWeights();

}  // namespace walr
