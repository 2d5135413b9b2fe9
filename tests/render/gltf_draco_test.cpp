// Meshes of KHR_draco_mesh_compression, encoded by Draco itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include "samples/render/load_scene.h"
#include "samples/render/scene_error.h"
#include "tests/error_text.h"
#include "tests/render/gltf_builder.h"
#include "tests/samples/temporary_directory.h"

namespace walr::render {
namespace {

using test::GltfBuilder;
using Triangle = std::array<std::array<float, 3>, 3>;

const std::vector<Triangle> kTriangles = {{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {{{1, 0, 0}, {1, 1, 0.25F}, {0, 1, 0}}}};

struct Encoded {
  std::vector<char> bytes;
  std::uint32_t positionId = 0;
};

// Without quantisation, so that positions stay as they are.
Encoded encode(draco::MeshEncoderMethod method) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(static_cast<int>(kTriangles.size()));
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  for (std::size_t i = 0; i < kTriangles.size(); ++i) {
    const Triangle& t = kTriangles[i];
    builder.SetAttributeValuesForFace(position, draco::FaceIndex(static_cast<std::uint32_t>(i)), t[0].data(),
                                      t[1].data(), t[2].data());
  }
  const auto mesh = builder.Finalize();
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
  return {{buffer.data(), buffer.data() + buffer.size()}, mesh->attribute(position)->unique_id()};
}

// With its least corner first, which keeps the winding.
Triangle canonical(Triangle triangle) {
  std::rotate(triangle.begin(), std::ranges::min_element(triangle), triangle.end());
  return triangle;
}

class DracoGltf : public testing::Test {
 protected:
  Scene load(const Encoded& encoded) {
    GltfBuilder builder;
    builder.primitive()["attributes"]["POSITION"] = builder.zeros(GltfBuilder::Float, "VEC3", 4);
    builder.primitive()["indices"] = builder.zeros(GltfBuilder::UnsignedShort, "SCALAR", 6);
    builder.primitive()["extensions"]["KHR_draco_mesh_compression"] = {
        {"bufferView", builder.view(encoded.bytes)}, {"attributes", {{"POSITION", encoded.positionId}}}};
    builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    return loadScene(builder.write(directory_.path()));
  }

  void expectError(const Encoded& encoded, const std::string& text) {
    fg::test::expectError<SceneError>([&] { load(encoded); }, {text, "mesh 0 primitive 0 KHR_draco"});
  }

  walr::test::TemporaryDirectory directory_;
};

TEST_F(DracoGltf, HoldsTheTrianglesThatWereEncoded) {
  for (const auto method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
    const Scene scene = load(encode(method));
    const Mesh& mesh = scene.meshes.at(0);
    EXPECT_EQ(mesh.positions.size(), 4U);
    std::vector<Triangle> found;
    for (const glm::uvec3& corners : mesh.triangles) {
      Triangle triangle{};
      for (glm::length_t i = 0; i < 3; ++i) {
        const glm::vec3& p = mesh.positions[corners[i]];
        triangle.at(static_cast<std::size_t>(i)) = {p.x, p.y, p.z};
      }
      found.push_back(canonical(triangle));
    }
    std::vector<Triangle> expected;
    std::ranges::transform(kTriangles, std::back_inserter(expected), canonical);
    std::ranges::sort(expected);
    std::ranges::sort(found);
    EXPECT_EQ(found, expected) << method;
  }
}

TEST_F(DracoGltf, RefusesDamagedData) {
  const Encoded whole = encode(draco::MESH_EDGEBREAKER_ENCODING);
  for (std::size_t size = 1; size < whole.bytes.size(); ++size) {
    Encoded cut = whole;
    cut.bytes.resize(size);
    expectError(cut, "");
  }
  Encoded other = whole;
  other.bytes[6] = 1;
  expectError(other, "bitstream 2.2");
  Encoded unknown = whole;
  ++unknown.positionId;
  expectError(unknown, "POSITION: the compressed data have no such attribute");
}

// The library would allocate what these numbers say: 2^32 - 1, of faces or of points.
TEST_F(DracoGltf, RefusesSizesThatTheBytesCannotHold) {
  const std::string number = "\xff\xff\xff\xff\x0f";
  for (const bool edgebreaker : {false, true}) {
    for (const std::string& numbers : {number + '\1', '\1' + number}) {
      const std::string bytes = std::string("DRACO\2\2\1", 8) + static_cast<char>(edgebreaker) + std::string(2, '\0') +
                                (edgebreaker ? std::string(1, '\0') : "") + numbers + std::string(64, '\0');
      expectError({{bytes.begin(), bytes.end()}, 0}, "4294967295 faces or points");
    }
  }
}

}  // namespace
}  // namespace walr::render
