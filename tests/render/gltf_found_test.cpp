// glTF files as they are found: what a file must not require, and what exporters and optimizers write beyond plain
// lists of floats. Expected values are those of the specification (glTF 2.0.1, Khronos), computed by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <nlohmann/json.hpp>

#include "samples/render/gbuffer.h"
#include "samples/render/load_scene.h"
#include "samples/render/scene_error.h"
#include "samples/render/sky.h"
#include "samples/render/surface.h"
#include "samples/render/view.h"
#include "samples/render/world.h"
#include "tests/error_text.h"
#include "tests/render/gltf_builder.h"
#include "tests/render/scene_builder.h"
#include "tests/samples/temporary_directory.h"

namespace walr::render {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using test::GltfBuilder;

const std::vector<float> kTriangle = {0, 0, 0, 1, 0, 0, 0, 1, 0};

class FoundGltf : public testing::Test {
 protected:
  [[nodiscard]] Scene load(GltfBuilder& builder) const { return loadScene(builder.write(directory_.path())); }
  [[nodiscard]] Mesh mesh(GltfBuilder& builder) const { return load(builder).meshes.at(0); }

  void expectError(GltfBuilder& builder, const std::string& text) const {
    fg::test::expectError<SceneError>([&] { static_cast<void>(load(builder)); }, {text, "built.gltf"});
  }

  walr::test::TemporaryDirectory directory_;
};

// All of these also have what the parser refuses, an index accessor that does not exist.
TEST_F(FoundGltf, NamesWhatIsRequiredBeforeTheParserRefuses) {
  const struct {
    const char* pointer;
    Json value;
    const char* text;
  } cases[] = {
      {"/asset/version", "1.0", "asset.version is '1.0'"},
      {"/asset/minVersion", "2.1", "asset.minVersion is '2.1'"},
      {"/extensionsRequired", {"KHR_lights_punctual", "ACME_gizmo"}, "requires the extension ACME_gizmo"},
      {"/extensionsRequired", {"KHR_texture_basisu"}, "requires the extension KHR_texture_basisu"},
  };
  for (const auto& [pointer, value, text] : cases) {
    GltfBuilder builder;
    builder.positions(kTriangle);
    builder.primitive()["indices"] = 99;
    builder.json[Json::json_pointer(pointer)] = value;
    expectError(builder, text);
  }
  GltfBuilder later;  // May be read as 2.0, says 3.2.
  later.positions(kTriangle);
  later.json["asset"]["version"] = "2.1";
  EXPECT_EQ(mesh(later).triangles.size(), 1U);
}

TEST_F(FoundGltf, NamesWhatAContainerLacks) {
  const auto refuse = [&](std::uint32_t version, std::string text, const std::string& part) {
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string glb = "glTF";
    const auto word = [&](std::size_t value) {
      const auto narrow = static_cast<std::uint32_t>(value);
      glb.append(reinterpret_cast<const char*>(&narrow), sizeof narrow);
    };
    word(version);
    word(20 + text.size() + 12);
    word(text.size());
    glb += "JSON" + text;
    word(4);
    glb += std::string("BIN\0", 4) + "data";
    const fs::path file = directory_.path() / "built.glb";
    std::ofstream(file, std::ios::binary) << glb;
    fg::test::expectError<SceneError>([&] { loadScene(file); }, {part});
  };
  refuse(1, "{}", "GLB container has version 1");
  // Each of these buffers would be a copy of the file's bytes.
  refuse(2, R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4},{"byteLength":4}]})", "buffer 1: has no uri");
}

TEST_F(FoundGltf, AssemblesListsStripsAndFans) {
  const struct {
    int mode;
    std::vector<glm::uvec3> expected;  // 3.7.2.1
  } cases[] = {{4, {{0, 1, 2}}}, {5, {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}}, {6, {{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}}};
  for (const auto& [mode, expected] : cases) {
    GltfBuilder builder;
    builder.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0});
    builder.primitive()["mode"] = mode;
    if (mode == 4) {
      builder.primitive()["indices"] = builder.accessor<std::uint8_t>(GltfBuilder::UnsignedByte, "SCALAR", {0, 1, 2});
    }
    EXPECT_EQ(mesh(builder).triangles, expected) << mode;
  }
  for (const auto& [mode, text] : {std::pair(1, "points and lines"), std::pair(7, "there is no mode 7")}) {
    GltfBuilder builder;
    builder.positions(kTriangle);
    builder.primitive()["mode"] = mode;
    expectError(builder, text);
  }
}

// 3.11: f = max(c / (2^(bits - 1) - 1), -1) or c / (2^bits - 1). KHR_mesh_quantization: also c itself.
TEST_F(FoundGltf, ReadsIntegerAttributes) {
  const auto expect = [&](auto type, GltfBuilder::ComponentType componentType, bool normalized, auto raw,
                          const glm::vec3& expected) {
    using T = decltype(type);
    GltfBuilder builder;
    std::vector<T> values(9, T{0});
    std::copy(raw.begin(), raw.end(), values.begin());
    const std::size_t index = builder.accessor<T>(componentType, "VEC3", values);
    builder.json["accessors"][index]["normalized"] = normalized;
    builder.primitive()["attributes"]["POSITION"] = index;
    builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {"KHR_mesh_quantization"};
    const Scene scene = load(builder);
    EXPECT_EQ(scene.meshes[0].positions[0], expected) << componentType << normalized;
  };
  expect(std::int8_t{}, GltfBuilder::Byte, true, std::vector{-128, -127, 127}, {-1, -1, 1});
  expect(std::uint8_t{}, GltfBuilder::UnsignedByte, true, std::vector{0, 51, 255}, {0, 51.0F / 255.0F, 1});
  expect(std::int16_t{}, GltfBuilder::Short, true, std::vector{-32768, -32767, 32767}, {-1, -1, 1});
  expect(std::uint16_t{}, GltfBuilder::UnsignedShort, true, std::vector{0, 13107, 65535}, {0, 13107.0F / 65535.0F, 1});
  expect(std::int8_t{}, GltfBuilder::Byte, false, std::vector{-128, -1, 127}, {-128, -1, 127});
  expect(std::uint16_t{}, GltfBuilder::UnsignedShort, false, std::vector{0, 300, 65535}, {0, 300, 65535});
}

TEST_F(FoundGltf, ReadsRotationsOfNormalisedIntegers) {
  GltfBuilder builder;
  builder.positions(kTriangle);
  const std::size_t times = builder.accessor<float>(GltfBuilder::Float, "SCALAR", {0, 1});
  // The second one is a half turn about z.
  const std::size_t keys =
      builder.accessor<std::int16_t>(GltfBuilder::Short, "VEC4", {0, 0, 0, 32767, 0, 0, -32768, 0});
  builder.json["accessors"][keys]["normalized"] = true;
  builder.json["animations"] = {{{"samplers", {{{"input", times}, {"output", keys}}}},
                                 {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}}}}}};
  const Scene scene = load(builder);
  ASSERT_EQ(scene.animation.size(), 1U);
  EXPECT_EQ(scene.animation[0].values, (std::vector<glm::vec4>{{0, 0, 0, 1}, {0, 0, -1, 0}}));
}

// 3.6.2.3: elements of a view, or zeros, some of which are replaced.
TEST_F(FoundGltf, ReadsSparseAccessors) {
  for (const bool base : {true, false}) {
    GltfBuilder builder;
    const std::size_t index = builder.positions(kTriangle);
    Json& accessor = builder.json["accessors"][index];
    if (!base) accessor.erase("bufferView");
    accessor["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", builder.view<std::uint16_t>({0, 2})}, {"componentType", 5123}}},
        {"values", {{"bufferView", builder.view<float>({9, 9, 9, 7, 8, 9, 4, 5, 6})}, {"byteOffset", 12}}}};
    EXPECT_EQ(mesh(builder).positions, (std::vector<glm::vec3>{{7, 8, 9}, {base ? 1.0F : 0.0F, 0, 0}, {4, 5, 6}}));
  }
}

TEST_F(FoundGltf, ReadsZerosWhereThereIsNoView) {
  GltfBuilder builder;
  builder.positions(kTriangle);
  builder.primitive()["indices"] = builder.zeros(GltfBuilder::UnsignedShort, "SCALAR", 3);
  EXPECT_EQ(mesh(builder).triangles, (std::vector<glm::uvec3>{{0, 0, 0}}));
}

TEST_F(FoundGltf, RefusesDamagedSparseAccessors) {
  const struct {
    const char* pointer;
    int value;
    const char* text;
  } cases[] = {{"/count", 4, "replaces 4 of 3 elements"},
               {"/count", -1, "replaces -1 of 3 elements"},
               {"/count", 2, "do not fit buffer view"},
               {"/indices/bufferView", 99, "there is no buffer view 99"},
               {"/indices/byteOffset", 8, "do not fit buffer view"},
               {"/indices/componentType", 5126, "indices must be unsigned integers"},
               {"/values/bufferView", 1, "do not fit buffer view"},
               {"/indices/bufferView", 3, "index 3 exceeds its 3 elements"}};
  for (const auto& [pointer, value, text] : cases) {
    GltfBuilder builder;
    const std::size_t index = builder.positions(kTriangle);
    Json sparse = {{"count", 1},
                   {"indices", {{"bufferView", builder.view<std::uint32_t>({2})}, {"componentType", 5125}}},
                   {"values", {{"bufferView", builder.view<float>({7, 8, 9})}}}};
    builder.view<std::uint32_t>({3});
    sparse[Json::json_pointer(pointer)] = value;
    builder.json["accessors"][index]["sparse"] = sparse;
    expectError(builder, text);
  }
}

// Files of some hundred bytes that would fill gigabytes, were their numbers believed.
TEST_F(FoundGltf, RefusesMoreZerosThanTheFileCouldMean) {
  constexpr std::size_t kMany = std::size_t{1} << 31U;
  GltfBuilder positions;
  positions.primitive()["attributes"]["POSITION"] = positions.zeros(GltfBuilder::Float, "VEC3", kMany);
  expectError(positions, "without a buffer view have more than 4194304");
  GltfBuilder normals;
  normals.positions(kTriangle);
  normals.primitive()["attributes"]["NORMAL"] = normals.zeros(GltfBuilder::Float, "VEC3", kMany);
  expectError(normals, "NORMAL: has 2147483648 elements for 3 positions");
  GltfBuilder keys;
  keys.positions(kTriangle);
  const std::size_t times = keys.accessor<float>(GltfBuilder::Float, "SCALAR", {0});
  keys.json["animations"] = {
      {{"samplers", {{{"input", times}, {"output", keys.zeros(GltfBuilder::Float, "VEC4", kMany)}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}}}}}};
  expectError(keys, "has 2147483648 values for 1 times");
}

TEST_F(FoundGltf, RefusesMoreJsonValuesThanAnySceneHas) {
  const fs::path file = directory_.path() / "values.gltf";
  std::string values((std::size_t{1} << 25U) + 1, ',');
  values.front() = '[';
  std::ofstream(file) << values;
  fg::test::expectError<SceneError>([&] { loadScene(file); }, {"values; the limit is 33554432"});
}

// The corners of a box of 2 x 4 x 1 all lie in the picture, and one of them 1 / 1.05 of the way to its edge.
TEST_F(FoundGltf, ACameraFramesASceneWithoutOne) {
  GltfBuilder builder;
  builder.positions({5, 1, -3, 7, 1, -3, 5, 5, -2});
  const Scene scene = load(builder);
  ASSERT_EQ(scene.warnings.size(), 1U) << testing::PrintToString(scene.warnings);
  EXPECT_NE(scene.warnings[0].find("no camera"), std::string::npos);
  const World world(scene);
  constexpr std::uint32_t kSide = 100;
  const View view = viewFrom(world, findCamera(scene, ""), kSide, kSide, glm::vec2(0.0F), glm::vec2(0.0F));
  float largest = 0.0F;
  for (const float x : {5.0F, 7.0F}) {
    for (const float y : {1.0F, 5.0F}) {
      for (const float z : {-3.0F, -2.0F}) {
        const glm::vec4 point = view.viewFromWorld * glm::vec4(x, y, z, 1.0F);
        ASSERT_LT(point.z, 0.0F);
        const glm::vec2 offset = glm::abs(project(view, glm::vec3(point)) - glm::vec2(50.0F));
        largest = std::max({largest, offset.x, offset.y});
      }
    }
  }
  EXPECT_NEAR(largest, 50.0F / 1.05F, 1e-3F);
  // From the front, the right and above.
  const glm::vec3 eye(glm::inverse(view.viewFromWorld)[3]);
  EXPECT_GT(eye.x, 7.0F);
  EXPECT_GT(eye.y, 5.0F);
  EXPECT_GT(eye.z, -2.0F);
}

TEST_F(FoundGltf, ASkyLightsASceneWithoutLight) {
  GltfBuilder builder;
  builder.positions(kTriangle);
  builder.json["scenes"][0].erase("extras");
  builder.json["nodes"].push_back({{"camera", 0}});
  builder.json["scenes"][0]["nodes"].push_back(1);
  builder.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
  const Scene scene = load(builder);
  const Sky sky(scene);
  EXPECT_EQ(sky.radiance({0, 1, 0}), glm::vec3(1.0F));
  EXPECT_EQ(sky.radiance({0, -1, 0}), glm::vec3(0.25F));
  // Half way between; the polar angle is rounded.
  EXPECT_NEAR(sky.radiance({1, 0, 0}).x, 0.625F, 1e-6F);
  ASSERT_EQ(scene.warnings.size(), 1U) << testing::PrintToString(scene.warnings);
  EXPECT_NE(scene.warnings[0].find("no light"), std::string::npos);
}

// Without a camera, what glows is rather a part of an object than a lamp.
TEST_F(FoundGltf, ASkyLightsAGlowingObjectWithoutACamera) {
  for (const bool camera : {false, true}) {
    GltfBuilder builder;
    builder.positions(kTriangle);
    builder.material() = {{"emissiveFactor", {1, 1, 1}}};
    builder.json["scenes"][0].erase("extras");
    if (camera) builder.json["nodes"][0]["camera"] = 0;
    builder.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
    EXPECT_NE(load(builder).skyMap.has_value(), camera);
  }
}

// A file whose vertices all lie in one point has no box to frame.
TEST_F(FoundGltf, ACameraStandsBeforeASceneWithoutExtent) {
  GltfBuilder builder;
  builder.positions(std::vector<float>(9, 2.0F));
  const Scene scene = load(builder);
  const World world(scene);
  const View view = viewFrom(world, findCamera(scene, ""), 4, 4, glm::vec2(0.0F), glm::vec2(0.0F));
  EXPECT_NEAR(glm::length(glm::vec3(view.viewFromWorld * glm::vec4(2, 2, 2, 1))), 1.0F, 1e-5F);
}

// 3.7.2.1: clamped; alpha is 1 if there is none.
TEST_F(FoundGltf, ReadsVertexColours) {
  GltfBuilder floats;
  floats.positions(kTriangle);
  floats.primitive()["attributes"]["COLOR_0"] =
      floats.accessor<float>(GltfBuilder::Float, "VEC3", {0, 0.25F, 0.5F, 1, 1, 1, -1, 2, 0});
  EXPECT_EQ(mesh(floats).colors, (std::vector<glm::vec4>{{0, 0.25F, 0.5F, 1}, {1, 1, 1, 1}, {0, 1, 0, 1}}));
  GltfBuilder bytes;
  bytes.positions(kTriangle);
  const std::size_t index = bytes.accessor<std::uint8_t>(GltfBuilder::UnsignedByte, "VEC4",
                                                         {0, 51, 102, 153, 255, 255, 255, 255, 0, 0, 0, 0});
  bytes.json["accessors"][index]["normalized"] = true;
  bytes.primitive()["attributes"]["COLOR_0"] = index;
  EXPECT_EQ(mesh(bytes).colors[0], glm::vec4(0.0F, 51.0F, 102.0F, 153.0F) / 255.0F);
}

Surface surfaceSeen(const World& world) {
  const View view = viewFrom(world, findCamera(world.scene(), ""), 1, 1, glm::vec2(0.0F), glm::vec2(0.0F));
  return tracePrimary(world, view, 0, 0).surface.value();
}

// Where the ray meets the triangle, the corners weigh 1/2, 1/4 and 1/4.
TEST_F(FoundGltf, VertexColoursMultiplyTheBaseColour) {
  GltfBuilder builder;
  builder.positions(kTriangle);
  builder.primitive()["attributes"]["COLOR_0"] =
      builder.accessor<float>(GltfBuilder::Float, "VEC4", {0, 0.25F, 0.5F, 1, 1, 1, 1, 0, 0, 1, 0, 0});
  builder.material() = {{"alphaMode", "MASK"},
                        {"pbrMetallicRoughness", {{"metallicFactor", 0}, {"baseColorFactor", {0.5, 0.5, 1, 1}}}}};
  builder.json["nodes"].push_back({{"camera", 0}, {"translation", {0.25, 0.25, 1}}});
  builder.json["scenes"][0]["nodes"].push_back(1);
  builder.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
  const Scene scene = load(builder);
  const Surface surface = surfaceSeen(World(scene));
  // The position of the hit is rounded, and so are its weights.
  constexpr float kRoundoff = 1e-6F;
  EXPECT_NEAR(surface.albedo.x, 0.5F * 0.25F, kRoundoff);
  EXPECT_NEAR(surface.albedo.y, 0.5F * 0.625F, kRoundoff);
  EXPECT_NEAR(surface.albedo.z, 0.5F, kRoundoff);
  // Alpha is the weight of the first corner; below 0.5 there is a hole.
  EXPECT_FALSE(isHole(scene, scene.meshes[0], 0, {0.2F, 0.25F}));
  EXPECT_TRUE(isHole(scene, scene.meshes[0], 0, {0.3F, 0.25F}));
}

// The first coordinates lie in the black texel, the second ones in the white one.
TEST(TextureCoordinates, AreThoseOfTheTexture) {
  test::SceneBuilder builder;
  builder.quad(builder.material(glm::vec3(1.0F)), {-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  builder.camera({0, 0, 1}, {0, 0, 0});
  Scene& scene = builder.scene();
  scene.images.push_back({.name = "", .width = 2, .height = 1, .rgba = {0, 0, 0, 0, 255, 255, 255, 255}});
  scene.materials[0].coordinates = {{.set = 0}, {.set = 1}};
  scene.meshes[0].uvs.assign(4, {0.25F, 0.5F});
  scene.meshes[0].uvs.insert(scene.meshes[0].uvs.end(), 4, {0.75F, 0.5F});
  for (const std::uint32_t coordinates : {0U, 1U}) {
    scene.textures = {{.coordinates = coordinates}};
    scene.materials[0].baseColorTexture = 0;
    EXPECT_EQ(surfaceSeen(World(scene)).albedo, glm::vec3(static_cast<float>(coordinates)));
  }
}

// A PNG file of one white texel.
const std::vector<std::uint8_t> kPng = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00,
    0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x00, 0x00, 0x00, 0x00, 0x3a, 0x7e, 0x9b, 0x55, 0x00,
    0x00, 0x00, 0x0a, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0xf8, 0x0f, 0x00, 0x01, 0x01, 0x01, 0x00,
    0xb1, 0x38, 0xf6, 0x14, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};

// The example of KHR_texture_transform: with these numbers a texture shows the lower left quadrant of its image,
// turned. Its corners are (0, 0.5), (0.5, 0.5), (0, 1), (0.5, 1), with v down.
TEST_F(FoundGltf, TexturesHaveTheirOwnCoordinates) {
  GltfBuilder builder;
  builder.positions(kTriangle);
  builder.primitive()["attributes"]["TEXCOORD_0"] =
      builder.accessor<float>(GltfBuilder::Float, "VEC2", {0, 0, 1, 0, 0, 1});
  builder.primitive()["attributes"]["TEXCOORD_1"] =
      builder.accessor<float>(GltfBuilder::Float, "VEC2", {3, 4, 5, 6, 7, 8});
  builder.json["images"] = {{{"bufferView", builder.view(kPng)}, {"mimeType", "image/png"}}};
  builder.json["textures"] = {{{"source", 0}}};
  const Json transform = {{"offset", {0, 1}}, {"rotation", 1.57079632679}, {"scale", {0.5, 0.5}}};
  builder.material() = {
      {"emissiveTexture", {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}}},
      {"pbrMetallicRoughness",
       {{"baseColorTexture", {{"index", 0}, {"texCoord", 1}}},
        {"metallicRoughnessTexture", {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"texCoord", 1}}}}}}}}}};
  builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {"KHR_texture_transform"};
  const Scene scene = load(builder);
  ASSERT_EQ(scene.images.size(), 1U) << testing::PrintToString(scene.warnings);
  const Material& material = scene.materials[0];
  const Mesh& mesh = scene.meshes[0];
  const auto expectCoordinates = [&](const std::optional<std::uint32_t>& texture,
                                     const std::vector<glm::vec2>& expected) {
    ASSERT_TRUE(texture.has_value());
    const std::size_t first = scene.textures[*texture].coordinates * mesh.positions.size();
    for (std::size_t i = 0; i < expected.size(); ++i) {
      // The rotation of the file is rounded to 12 digits, its sine to float.
      EXPECT_NEAR(mesh.uvs.at(first + i).x, expected[i].x, 1e-6F);
      EXPECT_NEAR(mesh.uvs.at(first + i).y, expected[i].y, 1e-6F);
    }
  };
  expectCoordinates(material.baseColorTexture, {{3, 4}, {5, 6}, {7, 8}});
  expectCoordinates(material.metallicRoughnessTexture, {{3, 4}, {5, 6}, {7, 8}});
  expectCoordinates(material.emissiveTexture, {{0, 1}, {0, 0.5F}, {0.5F, 1}});
  EXPECT_EQ(mesh.uvs.size(), 6U) << "textures at the same coordinates share them";
}

TEST_F(FoundGltf, NamesTheExtensionThatAnImageNeeds) {
  GltfBuilder builder;
  builder.positions(kTriangle);
  builder.json["images"] = {{{"uri", "picture.ktx2"}}};
  builder.json["textures"] = {{{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}}};
  const std::vector<std::string> warnings = load(builder).warnings;
  EXPECT_TRUE(std::ranges::any_of(warnings, [](const std::string& warning) {
    return warning.find("texture 0: its image needs the extension KHR_texture_basisu") != std::string::npos;
  })) << testing::PrintToString(warnings);
}

}  // namespace
}  // namespace walr::render
