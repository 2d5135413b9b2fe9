#pragma once

#include <tiny_gltf.h>

#include "samples/render/scene.h"

/// A small file can name the same data many times over: limits that keep it from filling the memory.
namespace walr::render::gltf {

/// Before anything is read: vertices, indices and animation keys, each as often as it is used.
/// @throws SceneError if they are more than 2^27
void checkUses(const tinygltf::Model& model);

/// The triangles of all nodes, each of which gets a copy of its mesh.
/// @throws SceneError if they are more than 2^26
void checkPlacedTriangles(const Scene& scene);

}  // namespace walr::render::gltf
