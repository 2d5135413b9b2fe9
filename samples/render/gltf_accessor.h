#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <tiny_gltf.h>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

/// Readers for glTF accessors, also sparse ones and those without a buffer view, that check every index and range.
/// `what` names the use in errors: "mesh 3 POSITION".
namespace walr::render::gltf {

/// The bytes of a buffer view.
/// @throws SceneError if the view does not exist or exceeds its buffer
std::span<const std::uint8_t> bufferViewBytes(const tinygltf::Model& model, int view, const std::string& what);

/// A range of a buffer.
/// @throws SceneError if the buffer does not exist or is shorter
std::span<const std::uint8_t> bufferBytes(const tinygltf::Model& model, int buffer, std::size_t offset,
                                          std::size_t length, const std::string& what);

/// The number of an accessor's elements, before they are read.
/// @throws SceneError if there is no such accessor, or if it has none
std::size_t elementCount(const tinygltf::Model& model, int accessor, const std::string& what);

/// The elements of an accessor of floats or of integers of 8 or 16 bits, which may be normalised
/// (KHR_mesh_quantization). @throws SceneError also for values that are not finite
std::vector<float> readScalars(const tinygltf::Model& model, int accessor, const std::string& what);

/// The same for vectors.
/// @param flawed  takes the number of vectors that are not finite, which become zero; without it they are an error
std::vector<glm::vec2> readVec2s(const tinygltf::Model& model, int accessor, const std::string& what,
                                 std::size_t* flawed = nullptr);
std::vector<glm::vec3> readVec3s(const tinygltf::Model& model, int accessor, const std::string& what,
                                 std::size_t* flawed = nullptr);
std::vector<glm::vec4> readVec4s(const tinygltf::Model& model, int accessor, const std::string& what,
                                 std::size_t* flawed = nullptr);

/// The elements of an accessor of unsigned integers of 8, 16 or 32 bits.
std::vector<std::uint32_t> readIndices(const tinygltf::Model& model, int accessor, const std::string& what);

}  // namespace walr::render::gltf
