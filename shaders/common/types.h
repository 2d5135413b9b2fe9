// GLSL's scalar, vector and matrix names, for headers that C++ and shaders share. Members are ordered so that std140,
// std430 and C++ give the same layout; a static_assert at each struct and the reflected block size check it.
#ifndef WALR_SHADERS_COMMON_TYPES_H
#define WALR_SHADERS_COMMON_TYPES_H
#ifdef __cplusplus
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
namespace walr {
using uint = glm::uint;
using glm::ivec2;
using glm::mat4;
using glm::uvec2;
using glm::uvec4;
using glm::vec2;
using glm::vec4;
}  // namespace walr
#endif
#endif
