#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <tiny_gltf.h>
#include <glm/vec3.hpp>

#include "samples/render/scene.h"

/// The steps that convert a parsed file to a `Scene`. Each appends its part and its warnings to `scene`, and throws
/// `SceneError` if the file is malformed.
namespace walr::render::gltf {

/// Images and textures. A missing or undecodable image gives a warning, and materials do not use it.
/// @returns for every texture of the model its index in `Scene::textures`, or nullopt
std::vector<std::optional<std::uint32_t>> convertTextures(const tinygltf::Model& model, Scene& scene);

/// Materials, and a default material at the end for primitives without one.
void convertMaterials(const tinygltf::Model& model, const std::vector<std::optional<std::uint32_t>>& textures,
                      Scene& scene);

/// Triangle meshes.
/// @returns for every mesh of the model the indices of its primitives in `Scene::meshes`
std::vector<std::vector<std::uint32_t>> convertMeshes(const tinygltf::Model& model, Scene& scene);

/// The nodes of the file's default scene with their cameras, lights and animation, and its sky.
void convertNodes(const tinygltf::Model& model, const std::vector<std::vector<std::uint32_t>>& meshes, Scene& scene);

/// The animation channels of the nodes that are in the scene.
/// @param nodes  for every node of the model its index in `Scene::nodes`, or nullopt
void convertAnimation(const tinygltf::Model& model, const std::vector<std::optional<std::uint32_t>>& nodes,
                      Scene& scene);

/// The name of a part of the file in messages, such as "mesh 3 'wall'", cut if it is long.
std::string partName(const std::string& kind, std::size_t index, const std::string& name);

/// A member of an extension that is a number of things or an index.
/// @throws SceneError if it is missing or negative
std::size_t readCount(const tinygltf::Value& object, const char* key, const std::string& what);

/// A linear colour from three numbers of a file. Negative components become 0, with a warning that names `what`.
glm::vec3 readColor(const std::vector<double>& numbers, const std::string& what, Scene& scene);

}  // namespace walr::render::gltf
