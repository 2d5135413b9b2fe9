#pragma once

#include <cstdint>

namespace walr {

/// What the alpha channel of a lighting texture holds.
enum class LightingAlpha : std::uint8_t {
  Unused,       ///< Nothing, as in the host's lighting.
  SampleCount,  ///< History length of the colour, as accumulation writes it; 0: no sample yet.
};

}  // namespace walr
