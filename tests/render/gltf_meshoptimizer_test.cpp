// Buffer views of EXT_meshopt_compression, encoded by meshoptimizer itself.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include <meshoptimizer.h>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include "samples/render/load_scene.h"
#include "samples/render/scene_error.h"
#include "tests/error_text.h"
#include "tests/render/gltf_builder.h"
#include "tests/samples/temporary_directory.h"

namespace walr::render {
namespace {

using Json = nlohmann::json;
using test::GltfBuilder;

const std::vector<float> kPositions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0.25F};

std::vector<unsigned char> encodeAttributes(const void* values, std::size_t count, std::size_t stride) {
  std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(count, stride));
  meshopt_encodeVertexVersion(0);
  bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), values, count, stride));
  return bytes;
}

// The file holds no uncompressed data: their buffer has no file.
class MeshoptGltf : public testing::Test {
 protected:
  // An accessor of a compressed view. @returns the extension of the view
  Json& add(GltfBuilder::ComponentType componentType, const std::string& type, const std::vector<unsigned char>& bytes,
            const char* mode, std::size_t count, std::size_t stride) {
    const std::size_t stored = builder.view(bytes);
    const std::size_t accessor = builder.zeros(componentType, type, count);
    builder.json["accessors"][accessor]["bufferView"] = stored + 1;
    Json& view = builder.json["bufferViews"].emplace_back(Json{{"buffer", 1}, {"byteLength", count * stride}});
    if (type != "SCALAR") view["byteStride"] = stride;
    Json& extension = view["extensions"]["EXT_meshopt_compression"];
    extension = {{"buffer", 0},
                 {"byteOffset", builder.json["bufferViews"][stored]["byteOffset"]},
                 {"byteLength", bytes.size()},
                 {"byteStride", stride},
                 {"count", count},
                 {"mode", mode}};
    return extension;
  }

  Json& addPositions() {
    builder.primitive()["attributes"]["POSITION"] = 0;
    return add(GltfBuilder::Float, "VEC3", encodeAttributes(kPositions.data(), 4, 12), "ATTRIBUTES", 4, 12);
  }

  Scene load() {
    builder.json["buffers"][1] = {{"byteLength", 1U << 30U}};
    builder.json["extensionsUsed"] =
        builder.json["extensionsRequired"] = {"EXT_meshopt_compression", "KHR_mesh_quantization"};
    return loadScene(builder.write(directory_.path()));
  }

  GltfBuilder builder;
  walr::test::TemporaryDirectory directory_;
};

TEST_F(MeshoptGltf, HoldsWhatWasEncoded) {
  const std::vector<std::uint32_t> indices = {0, 1, 2, 2, 1, 3};
  addPositions();
  // (0, 0, 1) has no rounding error in its octahedral encoding.
  const std::vector<float> normals = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0};
  std::vector<std::int8_t> octahedral(16);
  meshopt_encodeFilterOct(octahedral.data(), 4, 4, 8, normals.data());
  add(GltfBuilder::Byte, "VEC3", encodeAttributes(octahedral.data(), 4, 4), "ATTRIBUTES", 4, 4)["filter"] =
      "OCTAHEDRAL";
  builder.json["accessors"][1]["normalized"] = true;
  builder.primitive()["attributes"]["NORMAL"] = 1;
  std::vector<unsigned char> list(meshopt_encodeIndexBufferBound(indices.size(), 4));
  meshopt_encodeIndexVersion(1);
  list.resize(meshopt_encodeIndexBuffer(list.data(), list.size(), indices.data(), indices.size()));
  add(GltfBuilder::UnsignedShort, "SCALAR", list, "TRIANGLES", indices.size(), 2);
  builder.primitive()["indices"] = 2;
  const Scene scene = load();
  const Mesh& mesh = scene.meshes.at(0);
  EXPECT_EQ(mesh.positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0.25F}}));
  EXPECT_EQ(mesh.normals, std::vector<glm::vec3>(4, {0, 0, 1}));
  // The codec may turn the corners of a triangle.
  ASSERT_EQ(mesh.triangles.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    glm::uvec3 corners = mesh.triangles[i];
    const glm::uvec3 expected(indices[3 * i], indices[3 * i + 1], indices[3 * i + 2]);
    for (int turn = 0; turn < 3 && corners != expected; ++turn) corners = {corners.y, corners.z, corners.x};
    EXPECT_EQ(corners, expected);
  }
}

TEST_F(MeshoptGltf, HoldsASequenceOfIndices) {
  const std::vector<std::uint32_t> strip = {0, 1, 2, 3};
  addPositions();
  std::vector<unsigned char> bytes(meshopt_encodeIndexSequenceBound(strip.size(), 4));
  bytes.resize(meshopt_encodeIndexSequence(bytes.data(), bytes.size(), strip.data(), strip.size()));
  add(GltfBuilder::UnsignedInt, "SCALAR", bytes, "INDICES", strip.size(), 4);
  builder.primitive()["indices"] = 1;
  builder.primitive()["mode"] = 5;
  EXPECT_EQ(load().meshes.at(0).triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {1, 3, 2}}));
}

TEST_F(MeshoptGltf, RefusesWhatTheLibraryMustNotSee) {
  const struct {
    const char* key;
    Json value;
    const char* text;
  } cases[] = {{"byteStride", 6, "invalid mode"},
               {"byteStride", 260, "invalid mode"},
               {"mode", "TRIANGLES", "invalid mode"},
               {"mode", "OTHER", "invalid mode"},
               {"filter", "QUATERNION", "invalid mode"},
               {"filter", "OTHER", "invalid mode"},
               {"count", 0, "invalid mode"},
               {"count", -4, "count: must be"},
               {"count", 1 << 30, "exceed what its bytes"},
               {"buffer", 7, "there is no buffer 7"},
               {"byteLength", 1 << 30, "exceeds buffer"},
               {"byteLength", 9, "damaged"}};
  for (const auto& [key, value, text] : cases) {
    builder = {};
    addPositions()[key] = value;
    fg::test::expectError<SceneError>([&] { load(); }, {text, "buffer view 1 EXT_meshopt_compression"});
  }
}

}  // namespace
}  // namespace walr::render
