#pragma once

#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "samples/render/scene.h"

namespace walr::render {

/// Compute tangents for a normal map if the file has none, from positions, normals and texture coordinates. The tangent
/// of a vertex is the mean of its triangles' directions of increasing u, weighted by the triangle's angle at the vertex
/// and made perpendicular to the normal, as in MikkTSpace. w is the sign of the bitangent: cross(normal, tangent) * w
/// points to the top of the texture, where v is 0. A vertex whose triangles have no area in the texture gets a zero
/// tangent, which turns normal mapping off there.
/// @param uvs  one per position
std::vector<glm::vec4> deriveTangents(const Mesh& mesh, std::span<const glm::vec2> uvs);

}  // namespace walr::render
