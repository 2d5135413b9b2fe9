#pragma once

#include <filesystem>

#include <tiny_gltf.h>

namespace walr::render::gltf {

/// Parse a glTF or GLB file and read its buffers. Images stay encoded: those of a URI in `tinygltf::Image::image`
/// (empty where the file is missing), the others in their buffer view.
/// @throws SceneError
tinygltf::Model readModel(const std::filesystem::path& file);

}  // namespace walr::render::gltf
