#pragma once

#include <vector>

#include <glm/mat4x4.hpp>

#include "samples/render/scene.h"

namespace walr::render {

/// For every node, the matrix from its object space to world space at one time of the animation.
/// @param seconds  time; before its first key and after its last one, a channel keeps that key's value
std::vector<glm::mat4> worldTransforms(const Scene& scene, double seconds);

/// For every node, whether it or one of its ancestors is animated.
std::vector<bool> animatedNodes(const Scene& scene);

}  // namespace walr::render
