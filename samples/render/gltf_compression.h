#pragma once

#include <tiny_gltf.h>

/// Decoders of compressed meshes. Each is built if CMake found its library.
namespace walr::render::gltf {

inline constexpr const char* kDracoExtension = "KHR_draco_mesh_compression";
inline constexpr const char* kMeshoptExtension = "EXT_meshopt_compression";

/// Replace the buffer views of EXT_meshopt_compression by decoded ones.
/// @throws SceneError naming the view that cannot be decoded, or whose decoded size exceeds what its bytes can hold
void decodeMeshopt(tinygltf::Model& model);

/// Give the primitives of KHR_draco_mesh_compression accessors of decoded indices and attributes.
/// @throws SceneError naming the primitive that cannot be decoded, has more than 256 faces or points for each byte, or
/// is the one with which all have more than 2^26
void decodeDraco(tinygltf::Model& model);

}  // namespace walr::render::gltf
