// glTF files with the flaws that exporters leave: what has one obvious meaning is rendered, and nothing is passed over
// in silence. Expected values are those of the specification (glTF 2.0.1, Khronos), computed by hand.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include "samples/render/animation.h"
#include "samples/render/load_scene.h"
#include "samples/render/scene_error.h"
#include "tests/error_text.h"
#include "tests/render/gltf_builder.h"
#include "tests/samples/temporary_directory.h"

namespace walr::render {
namespace {

using Json = nlohmann::json;
using test::GltfBuilder;
namespace fs = std::filesystem;

const std::vector<float> kFlawedTriangle = {0, 0, 0, 1, 0, 0, 0, 1, 0};
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

class FlawedGltf : public testing::Test {
 protected:
  FlawedGltf() { builder.positions(kFlawedTriangle); }

  [[nodiscard]] Scene load() { return loadScene(builder.write(directory.path())); }
  void expectError(std::initializer_list<std::string_view> parts) {
    fg::test::expectError<SceneError>([&] { static_cast<void>(load()); }, parts);
  }
  /// The scene whose only warnings, beside that of the camera, have these parts.
  Scene loadWithWarning(std::initializer_list<std::string_view> parts) {
    Scene scene = load();
    EXPECT_EQ(scene.warnings.size(), 2U) << testing::PrintToString(scene.warnings);
    fg::test::expectContains(scene.warnings.at(0), parts);
    return scene;
  }
  void animate(const std::vector<float>& times) {
    std::vector<float> positions;
    for (std::size_t i = 0; i < times.size(); ++i) positions.insert(positions.end(), {0, 0, static_cast<float>(i)});
    const std::size_t input = builder.accessor<float>(GltfBuilder::Float, "SCALAR", times);
    const std::size_t output = builder.accessor<float>(GltfBuilder::Float, "VEC3", positions);
    builder.json["animations"] = {
        {{"samplers", {{{"input", input}, {"output", output}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
  }

  GltfBuilder builder;
  walr::test::TemporaryDirectory directory;
};

// The first vertex belongs to two triangles of areas 1/2 and 1, which face +z and +x.
TEST_F(FlawedGltf, NormalsWithoutADirectionAreThoseOfTheTriangles) {
  for (const std::array<float, 3> bad : {std::array<float, 3>{0, 0, 0}, {kNan, 0, 1}}) {
    builder = GltfBuilder();
    builder.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 2});
    builder.primitive()["indices"] =
        builder.accessor<std::uint8_t>(GltfBuilder::UnsignedByte, "SCALAR", {0, 1, 2, 0, 2, 3});
    builder.primitive()["attributes"]["NORMAL"] =
        builder.accessor<float>(GltfBuilder::Float, "VEC3", {bad[0], bad[1], bad[2], 0, 0, 5, 0, 1, 0, 0, 1, 0});
    const Scene scene = loadWithWarning({"NORMAL", "1 of 4"});
    const std::vector<glm::vec3>& normals = scene.meshes[0].normals;
    EXPECT_NEAR(normals[0].x, 2.0F / std::sqrt(5.0F), 1e-6F);  // Roundings of a square root and a division.
    EXPECT_NEAR(normals[0].z, 1.0F / std::sqrt(5.0F), 1e-6F);
    EXPECT_EQ(normals[1], glm::vec3(0, 0, 1));
  }
}

// No triangle of its own tells a direction: any will do, for no ray hits it.
TEST_F(FlawedGltf, NormalsOfTrianglesWithoutAreaAreUnitVectors) {
  builder.positions({0, 0, 0, 0, 0, 0, 0, 0, 0});
  builder.primitive()["attributes"]["NORMAL"] =
      builder.accessor<float>(GltfBuilder::Float, "VEC3", std::vector<float>(9, 0.0F));
  EXPECT_EQ(loadWithWarning({"3 of 3"}).meshes[0].normals[0], glm::vec3(0, 0, 1));
}

TEST_F(FlawedGltf, WhatOnlyShadesMayBeNan) {
  builder.primitive()["attributes"]["COLOR_0"] =
      builder.accessor<float>(GltfBuilder::Float, "VEC3", {1, kNan, 1, 0.5F, 0.25F, 1, 1, 1, 1});
  const Scene scene = loadWithWarning({"COLOR_0: 1 values are not finite"});
  EXPECT_EQ(scene.meshes[0].colors[0], glm::vec4(0, 0, 0, 1));
  EXPECT_EQ(scene.meshes[0].colors[1], glm::vec4(0.5F, 0.25F, 1, 1));
  builder.positions({kNan, 0, 0, 1, 0, 0, 0, 1, 0});
  expectError({"POSITION: element 0 is not finite"});
}

// JavaScript writes null for NaN. The parser takes an array that holds more than numbers for absent.
TEST_F(FlawedGltf, NamesWhatIsNoNumber) {
  const Json matrix(std::vector<Json>(16, nullptr));
  const struct {
    const char* pointer;
    Json value;
    std::initializer_list<std::string_view> parts;
  } cases[] = {
      {"/nodes/0/matrix", matrix, {"nodes[0].matrix[0]", "null"}},
      {"/nodes/0/translation", {0, "1", 2}, {"nodes[0].translation[1]", "\"1\""}},
      {"/materials/0/pbrMetallicRoughness/baseColorFactor", {1, 1, nullptr, 1}, {"baseColorFactor[2]", "null"}},
      {"/materials/0/pbrMetallicRoughness/baseColorFactor", {1, 1, 1}, {"baseColorFactor", "must be 4"}},
      {"/asset/version", 2.0, {"asset.version", "2.0", "text"}}};
  for (const auto& [pointer, value, parts] : cases) {
    builder = GltfBuilder();
    builder.positions(kFlawedTriangle);
    builder.json[Json::json_pointer(pointer)] = value;
    expectError(parts);
  }
}

TEST_F(FlawedGltf, MembersMayBeNullAndExtrasMayHoldAnything) {
  builder.json["nodes"][0]["skin"] = nullptr;
  builder.json["nodes"][0]["extras"] = {nullptr, "1"};
  EXPECT_EQ(load().nodes.size(), 2U);  // With the camera.
}

// 4.4: chunks are padded to 4 bytes, and an empty one may be left out. Writers forget it, or count wrongly.
TEST_F(FlawedGltf, ReadsContainersWithWrongLengths) {
  const auto write = [&](std::size_t length, bool padded, std::size_t cut) {
    const auto file = directory.path() / "built.glb";
    std::ifstream stream(builder.write(directory.path()).replace_extension(".bin"), std::ios::binary);
    std::string data((std::istreambuf_iterator<char>(stream)), {});
    Json json = builder.json;
    json["buffers"][0].erase("uri");
    std::string text = json.dump();
    while (padded && text.size() % 4 != 0) text += ' ';
    while (!padded && text.size() % 4 != 1) text += ' ';
    if (!padded) data += 'x';
    std::string glb = "glTF";
    const auto word = [&](std::size_t value) {
      const auto narrow = static_cast<std::uint32_t>(value);
      glb.append(reinterpret_cast<const char*>(&narrow), sizeof narrow);
    };
    word(2);
    word(length);
    word(text.size());
    glb += "JSON" + text;
    word(data.size());
    glb += std::string("BIN\0", 4) + data;
    std::ofstream(file, std::ios::binary) << glb.substr(0, glb.size() - cut);
    return file;
  };
  for (const std::size_t length : {12U, 99999U}) {
    EXPECT_EQ(loadScene(write(length, true, 0)).meshes.at(0).positions[1], glm::vec3(1, 0, 0)) << length;
  }
  EXPECT_EQ(loadScene(write(99999, false, 0)).meshes.at(0).positions[1], glm::vec3(1, 0, 0));
  fg::test::expectError<SceneError>([&] { loadScene(write(500, true, 6)); },
                                    {"truncated", "binary chunk should have 36 bytes, the file has 30"});
}

// 3.6.1.1: a buffer may have more bytes than it states. 5.28: a skin needs no inverseBindMatrices.
TEST_F(FlawedGltf, ReadsWhatTheSpecificationAllowsAndTheParserDoesNot) {
  builder.json["skins"] = {{{"joints", {0}}}};
  builder.json["nodes"][0]["skin"] = 0;
  const auto file = builder.write(directory.path());
  std::ofstream(directory.path() / "built.bin", std::ios::binary | std::ios::app) << "more";
  const Scene scene = loadScene(file);
  EXPECT_EQ(scene.meshes.at(0).positions[1], glm::vec3(1, 0, 0));
  fg::test::expectContains(scene.warnings.at(0),
                           {"node 0: skinning is not supported", "as it was modelled, where its node is"});
}

TEST_F(FlawedGltf, NamesABufferWithoutData) {
  std::ofstream(directory.path() / "empty.gltf") << R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4}]})";
  fg::test::expectError<SceneError>([&] { loadScene(directory.path() / "empty.gltf"); },
                                    {"buffer 0: has no uri", "GLB file with a binary chunk"});
}

// RFC 2397: the media type may have parameters, or be missing. 3.6.1.1: a buffer may hold more than it states.
TEST_F(FlawedGltf, ReadsDataUrisOfAnyType) {
  // Three vertices, (0, 0, 0), (1, 0, 0), (0, 1, 0), and a byte more.
  const std::string data = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAA==";
  for (const char* type : {"", "application/octet-stream", "application/x-bin;charset=utf-8", "image/webp"}) {
    builder.json["buffers"] = {{{"uri", "data:" + std::string(type) + ";base64," + data}, {"byteLength", 36}}};
    std::ofstream(directory.path() / "embedded.gltf") << builder.json.dump();
    const Scene scene = loadScene(directory.path() / "embedded.gltf");
    EXPECT_EQ(scene.meshes.at(0).positions[1], glm::vec3(1, 0, 0)) << type;
  }
  const struct {
    std::string uri;
    std::string_view text;
  } cases[] = {{"data:;base64,AAAA", "buffer 0: its data URI holds 3 bytes, byteLength states 36"},
               {"data:,abc", "buffer 0: its data URI is not in base64"}};
  for (const auto& [uri, text] : cases) {
    builder.json["buffers"][0]["uri"] = uri;
    std::ofstream(directory.path() / "embedded.gltf") << builder.json.dump();
    fg::test::expectError<SceneError>([&] { loadScene(directory.path() / "embedded.gltf"); }, {text});
  }
}

// Nothing of a file may command the terminal, and nobody reads a name of a million characters.
TEST_F(FlawedGltf, PrintsNamesSafelyAndShort) {
  builder.json["images"] = {{{"uri", "\x1b[2J" + std::string(1000, 'x')}}};
  const std::string warning = loadWithWarning({"\\x1b[2Jxxx", "..."}).warnings[0];
  EXPECT_LT(warning.size(), 150U);
  EXPECT_EQ(warning.find('\x1b'), std::string::npos);
  builder.json["extensionsRequired"] = {"\x1b[2J"};
  expectError({"extension \\x1b[2J"});
}

// 3.11 wants rising times, but exporters write a jump as two values at one time.
TEST_F(FlawedGltf, TwoKeysAtOneTimeAreAJump) {
  animate({0, 1, 1, 2});
  const Scene scene = load();
  const auto z = [&](double seconds) { return worldTransforms(scene, seconds)[0][3].z; };
  EXPECT_EQ(z(0.5), 0.5F);
  EXPECT_EQ(z(1.0), 2.0F);
  EXPECT_EQ(z(1.5), 2.5F);
  animate({0, 2, 1});
  expectError({"channel 0 input", "times must not fall"});
}

// 3.5.2 forbids both.
TEST_F(FlawedGltf, SaysThatAMatrixHidesAnAnimation) {
  animate({0, 1});
  builder.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  loadWithWarning({"animation 0 channel 0", "node 0 has a matrix", "ignored"});
}

// Blender's lamps without a soft edge.
TEST_F(FlawedGltf, ConesOfASpotMayBeEqual) {
  builder.json["extensionsUsed"] = {"KHR_lights_punctual"};
  builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.5}, {"outerConeAngle", 0.5}}}}};
  EXPECT_EQ(load().lights.at(0).cosInnerCone, std::cos(0.5F));
}

TEST_F(FlawedGltf, SaysThatAFileHasNoScenes) {
  builder.json.erase("scenes");
  expectError({"has no scenes", "add one"});
}

// Its diffuse colour is c_diff = diffuse * (1 - max(specular)).
TEST_F(FlawedGltf, ReadsDiffuseColoursOfSpecularGlossiness) {
  const std::string name = "KHR_materials_pbrSpecularGlossiness";
  builder.json["extensionsUsed"] = builder.json["extensionsRequired"] = {name};
  builder.material() = {
      {"extensions", {{name, {{"diffuseFactor", {0.5, 0.25, 1, 0.75}}, {"specularFactor", {0.25, 0.5, 0.125}}}}}}};
  Scene scene = load();
  EXPECT_EQ(scene.materials[0].baseColor, glm::vec3(0.25F, 0.125F, 0.5F));
  EXPECT_EQ(scene.materials[0].baseAlpha, 0.75F);
  EXPECT_EQ(scene.materials[0].metallic, 0.0F);
  // The image does not exist; that the texture is looked for shows that it is read.
  builder.json["images"] = {{{"uri", "nowhere.png"}}};
  builder.material()["extensions"][name] = {{"diffuseTexture", {{"index", 7}}}};
  expectError({"material 0 diffuseTexture", "no texture 7"});
}

// Its roughness is 1 - glossiness. Without diffuse light it is a metal, and F0 of .04 is that of all dielectrics.
TEST_F(FlawedGltf, ReadsTheSpecularLobeOfSpecularGlossinessAsFarAsItCan) {
  const std::string name = "KHR_materials_pbrSpecularGlossiness";
  builder.json["extensionsUsed"] = {name};
  Json& material = builder.material()["extensions"][name];
  material = {{"diffuseFactor", {0, 0, 0, 1}}, {"specularFactor", {1.0, 0.75, 0.25}}, {"glossinessFactor", 0.75}};
  Scene scene = load();
  EXPECT_EQ(scene.warnings.size(), 1U) << testing::PrintToString(scene.warnings);  // Of the camera.
  EXPECT_EQ(scene.materials[0].metallic, 1.0F);
  EXPECT_EQ(scene.materials[0].baseColor, glm::vec3(1.0F, 0.75F, 0.25F));
  EXPECT_EQ(scene.materials[0].roughness, 0.25F);
  material = {{"diffuseFactor", {0.5, 0.5, 0.5, 1}}, {"specularFactor", {0.04, 0.04, 0.04}}, {"glossinessFactor", 0.5}};
  scene = load();
  EXPECT_EQ(scene.warnings.size(), 1U) << testing::PrintToString(scene.warnings);
  EXPECT_EQ(scene.materials[0].metallic, 0.0F);
  EXPECT_EQ(scene.materials[0].roughness, 0.5F);
  material["specularFactor"] = {0.5, 0.25, 0.25};
  loadWithWarning({"material 0", "specular colours", "--specular"});
  material = {{"specularFactor", {0, 0, 0}}, {"specularGlossinessTexture", {{"index", 0}}}};
  EXPECT_EQ(loadWithWarning({"material 0", "glossiness textures"}).materials[0].roughness, 1.0F);
}

// 3.7.2.1 makes both a metal, which would be black without specular light.
TEST_F(FlawedGltf, ObjectsWithoutAnyColourAreWhite) {
  for (const bool named : {false, true}) {
    if (named) {
      builder.json["materials"] = {{{"name", "clay"}, {"doubleSided", true}}};
    } else {
      builder.primitive().erase("material");
    }
    const Scene scene = load();
    const Material& material = scene.materials[scene.meshes.at(0).material];
    EXPECT_EQ(material.baseColor, glm::vec3(1.0F)) << named;
    EXPECT_EQ(material.metallic, 0.0F) << named;
    EXPECT_EQ(material.roughness, 1.0F) << named;
    builder.primitive()["material"] = 0;
  }
  builder.material() = {{"pbrMetallicRoughness", Json::object()}};
  EXPECT_EQ(load().materials[0].metallic, 1.0F);
}

// The factor alone would make all of the object a lamp.
TEST_F(FlawedGltf, AMaterialWithoutItsEmissiveTextureDoesNotEmit) {
  builder.json["images"] = {{{"uri", "nowhere.png"}}};
  builder.json["textures"] = {{{"source", 0}}};
  builder.material() = {{"emissiveFactor", {1, 1, 1}}, {"emissiveTexture", {{"index", 0}}}};
  const Scene scene = load();
  EXPECT_FALSE(scene.materials[0].emits());
  ASSERT_EQ(scene.warnings.size(), 3U) << testing::PrintToString(scene.warnings);
  fg::test::expectContains(scene.warnings[0], {"nowhere.png", "not found"});
  fg::test::expectContains(scene.warnings[1], {"material 0", "emissive texture is missing", "does not emit"});
}

// 5.5: a channel may have no node; 3.11: extensions may say what it animates.
TEST_F(FlawedGltf, ChannelsWithoutANodeAreIgnored) {
  for (const char* path : {"pointer", "translation"}) {
    animate({0, 1});
    builder.json["animations"][0]["channels"].push_back({{"sampler", 0}, {"target", {{"path", path}}}});
    EXPECT_EQ(loadWithWarning({"animation 0 channel 1", path, "is ignored"}).animation.size(), 1U);
  }
  builder.json["animations"][0]["channels"][1]["target"]["node"] = -1;
  builder.json["animations"][0]["channels"][1]["target"]["path"] = "scale";
  expectError({"animation 0 channel 1", "there is no node -1"});
}

// Clips of a character, such as "walk" and "run", move the same nodes: one of them can be shown.
TEST_F(FlawedGltf, ShowsTheFirstOfSeveralClips) {
  animate({0, 1, 2});
  Json clip = builder.json["animations"][0];
  clip["name"] = "run";
  animate({0, 1});
  Json& animations = builder.json["animations"];
  const Json walk = animations[0];
  animations = Json::array({walk, clip, clip});
  const Scene scene = loadWithWarning({"animation 1 'run', animation 2 'run': left out"});
  ASSERT_EQ(scene.animation.size(), 1U);
  EXPECT_EQ(scene.animation[0].times, (std::vector<float>{0, 1}));
  for (int i = 0; i < 5; ++i) animations.push_back(clip);
  loadWithWarning({"animation 5 'run' and 2 more: left out"});
  animations = Json::array({walk, clip, clip});
  // Of other nodes or other properties, they belong together.
  animations[1]["channels"][0]["target"]["path"] = "scale";
  EXPECT_EQ(loadWithWarning({"animation 2 'run'", "left out"}).animation.size(), 2U);
}

// RFC 3986: only a form has a plus for a space.
TEST_F(FlawedGltf, APlusInTheNameOfAFileIsAPlus) {
  const fs::path file = builder.write(directory.path());
  fs::rename(directory.path() / "built.bin", directory.path() / "a+b.bin");
  builder.json["buffers"][0]["uri"] = "a+b.bin";
  for (const char* uri : {"a+b.bin", "a%2Bb.bin"}) {
    builder.json["buffers"][0]["uri"] = uri;
    std::ofstream(file) << builder.json.dump();
    EXPECT_EQ(loadScene(file).meshes.at(0).positions[1], glm::vec3(1, 0, 0)) << uri;
  }
  // The image of the other name is no picture.
  std::ofstream(directory.path() / "c d.png") << "nothing";
  builder.json["images"] = {{{"uri", "c+d.png"}}};
  std::ofstream(file) << builder.json.dump();
  fg::test::expectContains(loadScene(file).warnings.at(0), {"image 0", "not found"});
}

// 3.10.3: without zfar, the projection has no far plane.
TEST_F(FlawedGltf, ANearPlaneMayLieFarAway) {
  builder.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 2000.0}}}}};
  builder.json["nodes"][0]["camera"] = 0;
  const Camera camera = load().cameras.at(0);
  EXPECT_EQ(camera.znear, 2000.0F);
  EXPECT_GT(camera.zfar, 100 * camera.znear);
  Json& perspective = builder.json["cameras"][0]["perspective"];
  perspective["znear"] = 0.0;
  expectError({"camera 0", "0 < znear < 1e30"});
  perspective["znear"] = 2.0;
  perspective["zfar"] = 1.0;
  expectError({"camera 0", "0 < znear < zfar"});
}

// Of a diagonal of 1.4, a thousandth is reached at 2^18 * .0014 = 371 units.
TEST_F(FlawedGltf, SaysThatASceneIsFarFromTheOrigin) {
  builder.json["nodes"][0]["translation"] = {0, -360, 0};
  EXPECT_EQ(load().warnings.size(), 1U);
  builder.json["nodes"][0]["translation"] = {0, -390, 0};
  const Scene scene = load();
  ASSERT_EQ(scene.warnings.size(), 2U) << testing::PrintToString(scene.warnings);
  fg::test::expectContains(scene.warnings[1], {"far from the origin", "0.00148"});
}

TEST_F(FlawedGltf, SaysThatASceneIsTooLargeForACameraThatFramesIt) {
  builder.json["nodes"][0]["scale"] = {9e5, 9e5, 9e5};
  expectError({"has no camera", "frames all of it", "1e6"});
}

}  // namespace
}  // namespace walr::render
