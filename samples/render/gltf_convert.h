#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <tiny_gltf.h>
#include <glm/vec3.hpp>

#include "samples/render/scene.h"

/// The parts of turning a parsed file into a `Scene`. Each appends to `scene`, its warnings included, and throws
/// `SceneError` for what is malformed.
namespace walr::render::gltf {

/// Images and textures. An image that is missing or cannot be decoded gives a warning; materials then do without it.
/// @returns for every texture of the model its index in `Scene::textures`, or nothing
std::vector<std::optional<std::uint32_t>> convertTextures(const tinygltf::Model& model, Scene& scene);

/// Materials, and one more at the end for primitives without a material.
void convertMaterials(const tinygltf::Model& model, const std::vector<std::optional<std::uint32_t>>& textures,
                      Scene& scene);

/// Triangle meshes.
/// @returns for every mesh of the model the indices of its primitives in `Scene::meshes`
std::vector<std::vector<std::uint32_t>> convertMeshes(const tinygltf::Model& model, Scene& scene);

/// The default scene's nodes with cameras and lights, its sky, and the animation of its nodes.
void convertNodes(const tinygltf::Model& model, const std::vector<std::vector<std::uint32_t>>& meshes, Scene& scene);

/// A glTF animation's channels for the nodes that are in the scene.
/// @param nodes  for every node of the model its index in `Scene::nodes`, or nothing
void convertAnimation(const tinygltf::Model& model, const std::vector<std::optional<std::uint32_t>>& nodes,
                      Scene& scene);

/// "mesh 3 'wall'": how a part of the file is called in messages.
std::string partName(const std::string& kind, std::size_t index, const std::string& name);

/// Three numbers of a file as a linear colour. Negative components become 0, with a warning naming `what`.
glm::vec3 readColor(const std::vector<double>& numbers, const std::string& what, Scene& scene);

}  // namespace walr::render::gltf
