#pragma once

#include <cstddef>

#include "samples/render/scene.h"

namespace walr::render {

/// Compute tangents for a normal map if the file has none, from positions, normals and texture coordinates. The tangent
/// of a vertex is the mean of its triangles' directions of increasing u, weighted by the triangle's angle at the vertex
/// and made perpendicular to the normal, as in MikkTSpace. w is the sign of the bitangent: cross(normal, tangent) * w
/// points to the top of the texture, where v is 0. A vertex between triangles that show the texture mirrored and
/// triangles that do not becomes two, one for each kind, with all other attributes alike. A triangle without area in
/// the texture has no say; a vertex that has only such triangles gets a zero tangent, which turns normal mapping off
/// there.
/// @param mesh  takes the tangents, and the new vertices at the end of its attributes
/// @param set  which of the mesh's sets of texture coordinates the normal map has
void deriveTangents(Mesh& mesh, std::size_t set);

}  // namespace walr::render
