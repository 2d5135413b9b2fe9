#pragma once

#include <cstdint>

#include <glm/vec4.hpp>

namespace walr::reference {

/// Integer hash of four words (pcg4d, Jarzynski and Olano 2020).
glm::uvec4 pcg4d(glm::uvec4 key);

/// A random number in 0 .. count - 1, uniform over keys: the hash's first word as a fraction of 2^32, times `count`.
std::uint32_t hashBelow(glm::uvec4 key, std::uint32_t count);

}  // namespace walr::reference
