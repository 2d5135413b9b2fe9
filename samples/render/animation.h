#pragma once

#include <vector>

#include <glm/mat4x4.hpp>

#include "samples/render/scene.h"

namespace walr::render {

/// The matrices that bring every node's object space to world space, at one time of the animation.
/// @param seconds  before the first key and after the last one a channel holds that key's value
std::vector<glm::mat4> worldTransforms(const Scene& scene, double seconds);

/// For every node: whether it, or a node above it, is animated.
std::vector<bool> animatedNodes(const Scene& scene);

}  // namespace walr::render
