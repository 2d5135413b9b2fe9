#pragma once

#include <cstdint>

namespace walr {

/// What the alpha channel of a lighting texture says.
enum class LightingAlpha : std::uint8_t {
  Unused,       ///< Nothing, as in what a host hands over.
  SampleCount,  ///< Number of samples behind the colour, as accumulation leaves it; 0: there is none yet.
};

}  // namespace walr
