#pragma once

#include <tiny_gltf.h>

#include "samples/render/scene.h"

/// Limits on data that a file uses many times: without them a small file could fill the memory.
namespace walr::render::gltf {

/// Count vertices, indices and animation keys, each once per use. To be called before any of them is read.
/// @throws SceneError if there are more than `kMostElements`, or more than `kMostZeros` without a buffer view
void checkUses(const tinygltf::Model& model);

/// Count the triangles of all nodes, because every node gets a copy of its mesh.
/// @throws SceneError if there are more than `kMostTriangles`
void checkPlacedTriangles(const Scene& scene);

}  // namespace walr::render::gltf
