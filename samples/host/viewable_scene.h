#pragma once

#include <filesystem>
#include <span>

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include "samples/render/scene.h"

namespace walr::host {

/// Load a scene so that something is seen of it: one without a camera gets one that sees all of it from the front, and
/// one without light gets a white sky. `Scene::warnings` says so.
/// @throws render::SceneError see `render::loadScene`
render::Scene loadViewableScene(const std::filesystem::path& file, const std::filesystem::path& sky);

/// Centre (x, y, z) and radius (w) of a bounding sphere of the scene, in scene units.
/// @param worldFromNode  world transforms of the scene's nodes
glm::vec4 boundingSphere(const render::Scene& scene, std::span<const glm::mat4> worldFromNode);

}  // namespace walr::host
