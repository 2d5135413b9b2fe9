#pragma once

#include <cstddef>
#include <deque>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include <tiny_gltf.h>

/// What is checked in the JSON text of a file before the parser reads it, so that the message names the true cause.
namespace walr::render::gltf {

inline constexpr const char* kSpecularGlossinessExtension = "KHR_materials_pbrSpecularGlossiness";

/// The node of an animation channel that has none, see `prepareJson`.
inline constexpr int kNoNode = std::numeric_limits<int>::min();

/// Whether the loader renders what an extension says, so that a file may require it.
bool isSupported(const std::string& extension);

/// Check the text's nesting and size, the version, the required extensions, numbers, data URIs and which buffers have
/// no file.
/// @param hasChunk  the text is that of a GLB file with a binary chunk
/// @param fileLengths  takes the bytes that are used of each buffer that is a file, in their order
/// @returns another text for the parser if it would refuse this one although it is valid, or misread it;
/// `restoreAbsentViews` undoes what concerns views
/// @throws SceneError
std::optional<std::string> prepareJson(std::string_view text, bool hasChunk, std::deque<std::size_t>& fileLengths);

/// Give the accessors that have no buffer view in the file none in the model.
void restoreAbsentViews(tinygltf::Model& model);

}  // namespace walr::render::gltf
