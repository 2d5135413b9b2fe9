#pragma once

#include <filesystem>

#include <tiny_gltf.h>

#include "samples/image/fingerprint.h"

namespace walr::render::gltf {

/// Parse a glTF or GLB file and read its buffers. Images stay encoded: an image with a URI in `tinygltf::Image::image`
/// (empty if its file is missing), any other image in its buffer view.
/// @param contents takes in the bytes of the file and of all files that it names; may be null
/// @throws SceneError
tinygltf::Model readModel(const std::filesystem::path& file, Fingerprint* contents);

}  // namespace walr::render::gltf
