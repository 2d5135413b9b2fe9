#pragma once

#include <cstdint>

namespace fg::vk {

/// Selects the copies of resources that a frame uses.
struct FrameIndex {
  std::uint32_t slot = 0;    ///< Copy of upload buffers: 0 to frames in flight - 1.
  std::uint32_t parity = 0;  ///< Image of each history that is written, 0 or 1; the other one is read.
};

inline constexpr std::uint32_t kParities = 2;

}  // namespace fg::vk
