#pragma once

#include <vector>

#include <glm/vec4.hpp>

#include "samples/render/scene.h"

namespace walr::render {

/// Tangents for a normal map where the file gives none, from positions, normals and texture coordinates: for every
/// vertex the mean of its triangles' directions of rising u, weighted by the triangle's angle at the vertex and made
/// perpendicular to the normal, as in MikkTSpace. w is the sign of the bitangent: cross(normal, tangent) * w points to
/// the top of the picture, towards falling v. A vertex whose triangles have no extent in the texture gets a zero
/// tangent: no normal mapping.
std::vector<glm::vec4> deriveTangents(const Mesh& mesh);

}  // namespace walr::render
