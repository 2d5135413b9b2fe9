// Tangents for normal maps of meshes without any, on squares of side 1 in the plane z = 0 whose texture is mirrored.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "samples/render/scene.h"
#include "samples/render/tangents.h"

namespace walr::render {
namespace {

/// Adds a vertex at (x, y, 0) that faces +z.
std::uint32_t vertex(Mesh& mesh, float x, float y, const glm::vec2& uv) {
  mesh.positions.emplace_back(x, y, 0.0F);
  mesh.normals.emplace_back(0.0F, 0.0F, 1.0F);
  mesh.colors.emplace_back(x, y, 0.5F, 1.0F);
  mesh.uvs.push_back(uv);
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

/// A square between x and x + 1. Its u rises from 0 to 1, or falls if the texture is mirrored; v is 0 on top.
glm::vec2 uvAt(float x, float y, bool mirrored) {
  return {mirrored ? 1.0F - x : x, 1.0F - y};
}

/// Two squares side by side. The texture of the right one is the mirror image of that of the left one.
Mesh mirroredSquares(bool shareVertices) {
  Mesh mesh;
  std::vector<std::uint32_t> seam;
  for (const bool mirrored : {false, true}) {
    const float left = mirrored ? 1.0F : 0.0F;
    std::vector<std::uint32_t> at;
    for (const auto& [x, y] : {std::pair(0.0F, 0.0F), {1.0F, 0.0F}, {1.0F, 1.0F}, {0.0F, 1.0F}}) {
      const bool onSeam = mirrored ? x == 0.0F : x == 1.0F;
      const std::size_t height = y == 0.0F ? 0 : 1;
      if (shareVertices && mirrored && onSeam) {
        at.push_back(seam[height]);
        continue;
      }
      at.push_back(vertex(mesh, left + x, y, uvAt(x, y, mirrored)));
      if (onSeam) seam.push_back(at.back());
    }
    mesh.triangles.emplace_back(at[0], at[1], at[2]);
    mesh.triangles.emplace_back(at[0], at[2], at[3]);
  }
  return mesh;
}

TEST(Tangents, OfSharedVerticesAreThoseOfSplitOnes) {
  Mesh shared = mirroredSquares(true);
  Mesh split = mirroredSquares(false);
  EXPECT_EQ(shared.positions.size(), 6U);
  deriveTangents(shared, 0);
  deriveTangents(split, 0);
  ASSERT_EQ(shared.triangles.size(), split.triangles.size());
  EXPECT_EQ(shared.positions.size(), 8U);
  EXPECT_EQ(split.positions.size(), 8U);
  for (std::size_t i = 0; i < split.triangles.size(); ++i) {
    for (glm::length_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t a = shared.triangles[i][corner];
      const std::uint32_t b = split.triangles[i][corner];
      EXPECT_EQ(shared.positions[a], split.positions[b]);
      EXPECT_EQ(shared.normals[a], split.normals[b]);
      EXPECT_EQ(shared.colors[a], split.colors[b]);
      EXPECT_EQ(shared.uvs[a], split.uvs[b]);
      EXPECT_EQ(shared.tangents[a], split.tangents[b]);
      // Along the rising u; the bitangent points up on both sides.
      const float side = i < 2 ? 1.0F : -1.0F;
      EXPECT_EQ(shared.tangents[a], glm::vec4(side, 0.0F, 0.0F, side));
    }
  }
}

// Every set of texture coordinates follows the vertices, also if the normal map has another one than the first.
TEST(Tangents, KeepAllTextureCoordinatesOfASplitVertex) {
  Mesh mesh = mirroredSquares(true);
  const std::vector<glm::vec2> uvs = mesh.uvs;
  mesh.uvs.clear();
  for (std::size_t i = 0; i < uvs.size(); ++i) mesh.uvs.emplace_back(10.0F + static_cast<float>(i), 0.0F);
  mesh.uvs.insert(mesh.uvs.end(), uvs.begin(), uvs.end());
  const Mesh before = mesh;
  deriveTangents(mesh, 1);
  ASSERT_EQ(mesh.uvs.size(), 2 * mesh.positions.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (glm::length_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t now = mesh.triangles[i][corner];
      const std::uint32_t was = before.triangles[i][corner];
      EXPECT_EQ(mesh.uvs[now], before.uvs[was]);
      EXPECT_EQ(mesh.uvs[now + mesh.positions.size()], before.uvs[was + before.positions.size()]);
    }
  }
}

// Long triangles whose corners meet in one point of the texture, at the corners of a mirrored square.
TEST(Tangents, TrianglesWithoutAreaInTheTextureHaveNoSay) {
  Mesh mesh;
  for (const auto& [x, y] : {std::pair(0.0F, 0.0F), {1.0F, 0.0F}, {1.0F, 1.0F}, {0.0F, 1.0F}}) {
    vertex(mesh, x, y, uvAt(x, y, true));
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  const std::uint32_t below = vertex(mesh, 1.5F, -9.0F, mesh.uvs[1]);
  const std::uint32_t above = vertex(mesh, -0.5F, 9.0F, mesh.uvs[3]);
  mesh.triangles.emplace_back(1, below, 2);
  mesh.triangles.emplace_back(0, 3, above);
  deriveTangents(mesh, 0);
  EXPECT_EQ(mesh.positions.size(), 6U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(mesh.tangents[i], glm::vec4(-1.0F, 0.0F, 0.0F, -1.0F)) << i;
  // Without a triangle that shows the texture, normal mapping is off.
  for (const std::uint32_t i : {below, above}) EXPECT_EQ(glm::vec3(mesh.tangents[i]), glm::vec3(0.0F)) << i;
}

}  // namespace
}  // namespace walr::render
