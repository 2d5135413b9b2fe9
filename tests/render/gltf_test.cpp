// Loading glTF: supported features, warnings, and malformed files, which must give an error and never crash.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numeric>
#include <random>
#include <string>

#include <glm/matrix.hpp>
#include <nlohmann/json.hpp>

#include "samples/render/film.h"
#include "samples/render/instance.h"
#include "samples/render/load_scene.h"
#include "samples/render/scene_error.h"
#include "samples/render/view.h"
#include "tests/error_text.h"
#include "tests/samples/temporary_directory.h"

namespace walr::render {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class Gltf : public testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& bytes) const {
    std::ofstream(directory_.path() / name, std::ios::binary) << bytes;
    return directory_.path() / name;
  }

  /// Writes the box scene after `change`.
  fs::path boxWith(const std::function<void(Json&)>& change) const {
    Json json = Json::parse(std::ifstream(WALR_SCENES "/box.gltf"));
    change(json);
    return write("scene.gltf", json.dump());
  }

  /// Expects that loading fails with a message that contains the file's name and `text`.
  static void expectError(const fs::path& file, const std::string& text) {
    fg::test::expectError<SceneError>([&] { loadScene(file); }, {text, file.string()});
  }

  static void expectWarning(const fs::path& file, const std::string& text) {
    const Scene scene = loadScene(file);
    EXPECT_TRUE(std::any_of(scene.warnings.begin(), scene.warnings.end(), [&](const std::string& warning) {
      return warning.find(text) != std::string::npos;
    })) << testing::PrintToString(scene.warnings);
  }

  walr::test::TemporaryDirectory directory_;
};

// The scene of a .gltf file as the bytes of a .glb file.
std::string asGlb(const fs::path& file) {
  Json json = Json::parse(std::ifstream(file));
  // Base64, RFC 4648.
  const auto encoded = json["buffers"][0]["uri"].get<std::string>();
  std::string data;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : encoded.substr(encoded.find(',') + 1)) {
    static const std::string kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    if (c == '=') {
      break;
    }
    bits = bits << 6U | static_cast<std::uint32_t>(kAlphabet.find(c));
    count += 6;
    if (count >= 8) {
      count -= 8;
      data += static_cast<char>(bits >> static_cast<unsigned>(count) & 0xffU);
    }
  }
  json["buffers"][0].erase("uri");
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  data.resize((data.size() + 3) / 4 * 4, '\0');
  std::string glb;
  const auto word = [&](std::size_t value) {
    const auto narrow = static_cast<std::uint32_t>(value);
    glb.append(reinterpret_cast<const char*>(&narrow), sizeof narrow);
  };
  glb += "glTF";
  word(2);
  word(12 + 8 + text.size() + 8 + data.size());
  word(text.size());
  glb += "JSON" + text;
  word(data.size());
  glb += std::string("BIN\0", 4) + data;
  return glb;
}

TEST_F(Gltf, BuiltInScenesLoadWithoutWarnings) {
  for (const char* name : {"box", "turntable", "kitchen", "stair", "garden", "gloss", "kitchen_gloss", "mirrors"}) {
    const Scene scene = loadScene(fs::path(WALR_SCENES) / (std::string(name) + ".gltf"));
    EXPECT_TRUE(scene.warnings.empty()) << testing::PrintToString(scene.warnings);
    EXPECT_GT(scene.meshes.size(), 6U);
    EXPECT_EQ(findCamera(scene, ""), findCamera(scene, "camera"));
    EXPECT_GT(scene.skyRadiance.z, scene.skyRadiance.x);
  }
}

TEST_F(Gltf, BinaryFileHoldsTheSameScene) {
  const Scene text = loadScene(WALR_SCENES "/box.gltf");
  const Scene binary = loadScene(write("box.glb", asGlb(WALR_SCENES "/box.gltf")));
  ASSERT_EQ(text.meshes.size(), binary.meshes.size());
  for (std::size_t i = 0; i < text.meshes.size(); ++i) {
    EXPECT_EQ(text.meshes[i].positions, binary.meshes[i].positions);
    EXPECT_EQ(text.meshes[i].triangles, binary.meshes[i].triangles);
  }
  ASSERT_EQ(text.images.size(), binary.images.size());
  EXPECT_EQ(text.images[0].rgba, binary.images[0].rgba);
}

TEST_F(Gltf, ReadsMaterialsLightsAndEmission) {
  const fs::path file = boxWith([](Json& json) {
    json["materials"][0]["pbrMetallicRoughness"]["metallicFactor"] = 1.0;
    json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "directional"}, {"color", {1.0, 0.5, 0.25}}, {"intensity", 8.0}},
        {{"type", "spot"}, {"intensity", 2.0}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.5}}}}};
    json["extensionsUsed"].push_back("KHR_lights_punctual");
    json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    json["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 1;
  });
  const Scene scene = loadScene(file);
  EXPECT_TRUE(scene.warnings.empty()) << testing::PrintToString(scene.warnings);
  EXPECT_EQ(scene.materials[0].metallic, 1.0F);
  EXPECT_EQ(scene.lights[0].intensity, glm::vec3(8.0F, 4.0F, 2.0F));
  EXPECT_EQ(scene.lights[1].kind, PunctualLight::Kind::Spot);
  EXPECT_NEAR(scene.lights[1].cosOuterCone, std::cos(0.5F), 1e-6F);
  const auto lamp = std::find_if(scene.materials.begin(), scene.materials.end(),
                                 [](const Material& material) { return material.name == "lamp"; });
  ASSERT_NE(lamp, scene.materials.end());
  EXPECT_NEAR(lamp->emission.x, 34.0F, 1e-4F);
  EXPECT_NEAR(lamp->emission.z, 20.0F, 1e-4F);
  EXPECT_FALSE(lamp->doubleSided);
}

TEST_F(Gltf, CutOutLeavesHoles) {
  Scene scene = loadScene(WALR_SCENES "/box.gltf");
  World world(scene);
  const auto plate = std::find_if(world.instances().begin(), world.instances().end(), [&](const Instance& instance) {
    return scene.materials[scene.meshes[instance.mesh].material].alphaCutoff.has_value();
  });
  ASSERT_NE(plate, world.instances().end());
  // Rays perpendicular to the plate: at its middle holes and at the metal between them.
  const Mesh& mesh = scene.meshes[plate->mesh];
  const glm::vec3 u = (mesh.positions[1] - mesh.positions[0]) / 9.0F;
  const glm::vec3 v = (mesh.positions[3] - mesh.positions[0]) / 8.0F;
  const auto instanceMet = [&](float column, float row) {
    const glm::vec3 point = mesh.positions[0] + u * column + v * row;
    return world.rays().closest({point + mesh.normals[0] * 0.05F, -mesh.normals[0], 0.1F}).has_value();
  };
  EXPECT_FALSE(instanceMet(4.5F, 3.5F));
  EXPECT_FALSE(instanceMet(2.5F, 6.5F));
  EXPECT_TRUE(instanceMet(4.02F, 3.5F));
  EXPECT_TRUE(instanceMet(4.5F, 3.98F));
}

TEST_F(Gltf, AnimationIsLinearAndConstantBeyondItsKeys) {
  Scene scene = loadScene(WALR_SCENES "/turntable.gltf");
  const auto channel = std::find_if(scene.animation.begin(), scene.animation.end(), [&](const AnimationChannel& c) {
    return scene.nodes[c.node].name == "sliding block";
  });
  ASSERT_NE(channel, scene.animation.end());
  const auto place = [&](double seconds) { return worldTransforms(scene, seconds)[channel->node][3].x; };
  EXPECT_NEAR(place(0.0), 0.9F, 1e-6F);
  EXPECT_NEAR(place(-1.0), 0.9F, 1e-6F);
  EXPECT_NEAR(place(10.5 / 24.0), 0.9F - 0.03F * 10.5F, 1e-5F);
  EXPECT_NEAR(place(100.0), 0.9F - 0.03F * 47.0F, 1e-5F);
  channel->interpolation = AnimationChannel::Interpolation::Step;
  EXPECT_NEAR(place(10.5 / 24.0), 0.9F - 0.03F * 10.0F, 1e-5F);
}

TEST_F(Gltf, WarnsOfUnsupportedFeatures) {
  expectWarning(boxWith([](Json& json) { json["extensionsUsed"].push_back("KHR_materials_clearcoat"); }),
                "KHR_materials_clearcoat");
  expectWarning(boxWith([](Json& json) { json["materials"][0]["alphaMode"] = "BLEND"; }), "alpha mode BLEND");
  expectWarning(boxWith([](Json& json) { json["meshes"][0]["primitives"][0]["mode"] = 1; }), "points and lines");
  expectWarning(boxWith([](Json& json) {
                  json["cameras"][0] = {{"type", "orthographic"},
                                        {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"zfar", 9}, {"znear", 1}}}};
                }),
                "only perspective cameras");
  expectWarning(boxWith([](Json& json) { json["animations"][0]["samplers"][0]["interpolation"] = "CUBICSPLINE"; }),
                "CUBICSPLINE");
}

TEST_F(Gltf, MissingImageGivesAWarning) {
  const fs::path missing = boxWith([](Json& json) {
    json["images"][0].erase("bufferView");
    json["images"][0]["uri"] = "nowhere.png";
  });
  expectWarning(missing, "nowhere.png");
  EXPECT_NO_THROW(World(loadScene(missing)));
  expectError(boxWith([](Json& json) { json["images"][0]["bufferView"] = 999; }), "image[0]");
}

TEST_F(Gltf, DamagedOrOversizedImageGivesAWarning) {
  expectWarning(boxWith([](Json& json) { json["images"][0]["bufferView"] = 2; }), "not a PNG or JPEG image");
  // A PNG file of 20000 x 8 texels whose data are empty. Newer versions of stb read on from the header to the data
  // before they tell the size.
  write("huge.png", {"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x4e\x20\0\0\0\x08\x08\x06\0\0\0\0\0\0\0"
                     "\0\0\0\0IDAT\0\0\0\0\0\0\0\0IEND\0\0\0\0",
                     57});
  expectWarning(boxWith([](Json& json) {
                  json["images"][0].erase("bufferView");
                  json["images"][0]["uri"] = "huge.png";
                }),
                "20000 x 8");
}

TEST_F(Gltf, RefusesMalformedFiles) {
  expectError(directory_.path() / "none.gltf", "no such file");
  expectError(directory_.path(), "not a regular file");
  expectError(write("empty.gltf", ""), "not a valid glTF");
  expectError(write("text.gltf", "this is no JSON"), "not a valid glTF");
  expectError(write("deep.gltf", std::string(100000, '[')), "nested");
  expectError(write("short.glb", "glTF\2"), "truncated");
  expectError(boxWith([](Json& json) { json.erase("scenes"); }), "scene");
  expectError(boxWith([](Json& json) { json["scenes"][0]["nodes"] = Json::array(); }), "no triangles");
}

TEST_F(Gltf, RefusesIndicesOutOfRange) {
  expectError(boxWith([](Json& json) { json["scenes"][0]["nodes"].push_back(999); }), "999");
  expectError(boxWith([](Json& json) { json["nodes"][0]["mesh"] = 999; }), "999");
  expectError(boxWith([](Json& json) { json["nodes"][0]["camera"] = 7; }), "camera");
  expectError(boxWith([](Json& json) { json["meshes"][0]["primitives"][0]["material"] = 99; }), "material 99");
  expectError(boxWith([](Json& json) { json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 999; }), "999");
  expectError(boxWith([](Json& json) { json["materials"][0]["normalTexture"] = {{"index", 55}}; }), "texture 55");
  expectError(boxWith([](Json& json) { json["animations"][0]["channels"][0]["target"]["node"] = 999; }), "999");
}

TEST_F(Gltf, RefusesRangesBeyondTheBuffer) {
  expectError(boxWith([](Json& json) { json["accessors"][0]["count"] = 4000000000U; }), "do not fit");
  expectError(boxWith([](Json& json) { json["accessors"][0]["byteOffset"] = 4000000000U; }), "do not fit");
  for (const char* key : {"byteOffset", "byteLength"}) {
    const fs::path file = boxWith([&](Json& json) {
      json["bufferViews"][json["accessors"][0]["bufferView"].get<std::size_t>()][key] = 4000000000U;
    });
    expectError(file, "exceeds buffer");
  }
}

// A file of 90 KB with a mesh of one vertex and 21845 triangles that is used many times.
TEST_F(Gltf, RefusesDataUsedTooOften) {
  constexpr std::size_t kBytes = 65535;
  const auto file = [&](std::size_t primitives, std::size_t nodes) {
    Json json = {
        {"asset", {{"version", "2.0"}}},
        {"buffers",
         {{{"byteLength", kBytes},
           {"uri", "data:application/octet-stream;base64," + std::string(kBytes / 3 * 4, 'A')}}}},
        {"bufferViews", {{{"buffer", 0}, {"byteLength", kBytes}}}},
        {"accessors",
         {{{"bufferView", 0}, {"componentType", 5126}, {"count", 1}, {"type", "VEC3"}},
          {{"bufferView", 0}, {"componentType", 5121}, {"count", kBytes}, {"type", "SCALAR"}}}},
        {"scene", 0},
    };
    const Json primitive = {{"attributes", {{"POSITION", 0}}}, {"indices", 1}};
    json["meshes"] = {{{"primitives", std::vector<Json>(primitives, primitive)}}};
    json["nodes"] = std::vector<Json>(nodes, {{"mesh", 0}});
    std::vector<std::size_t> numbers(nodes);
    std::iota(numbers.begin(), numbers.end(), 0);
    json["scenes"] = {{{"nodes", numbers}}};
    return write("often.gltf", json.dump());
  };
  EXPECT_NO_THROW(loadScene(file(1, 1)));
  expectError(file((std::size_t{1} << 27U) / kBytes + 1, 1), "counted once for each use");
  expectError(file(1, (std::size_t{1} << 26U) / (kBytes / 3) + 1), "triangles; the limit is");
}

TEST_F(Gltf, RefusesHierarchiesThatAreNotTrees) {
  expectError(boxWith([](Json& json) { json["nodes"][0]["children"] = {1}; }), "in the hierarchy twice");
  expectError(boxWith([](Json& json) { json["nodes"][0]["children"] = {0}; }), "in the hierarchy twice");
}

TEST_F(Gltf, RefusesInvalidNumbers) {
  expectError(boxWith([](Json& json) { json["nodes"][0]["rotation"] = {0.0, 0.0, 0.0, 0.0}; }), "quaternion");
  expectError(boxWith([](Json& json) { json["cameras"][0]["perspective"]["yfov"] = 4.0; }), "field of view");
  expectError(boxWith([](Json& json) { json["scenes"][0]["extras"]["sky_radiance"] = {1.0}; }), "sky_radiance");
  const fs::path far = boxWith([](Json& json) { json["nodes"][0]["translation"] = {1e30, 0.0, 0.0}; });
  const Scene scene = loadScene(far);
  EXPECT_THROW(World{scene}, SceneError);
}

TEST_F(Gltf, RefusesACameraBeyondTheWorld) {
  const Scene scene = loadScene(boxWith([](Json& json) {
    for (Json& node : json["nodes"]) {
      if (node.contains("camera")) node["translation"] = {2e18, 0.0, 0.0};
    }
    json.erase("animations");  // One of them moves the camera.
  }));
  World world(scene);
  fg::test::expectError<SceneError>(
      [&] { viewFrom(world, findCamera(scene, ""), 4, 3, glm::vec2(0.0F), glm::vec2(0.0F)); }, {"camera", "1e6"});
}

// Ray casting inverts the transforms of objects, also of those that an animation has flattened or shrunk away.
TEST_F(Gltf, RendersObjectsWithoutThickness) {
  for (const auto& scale : {std::array{0.0, 1.0, 1.0}, std::array{1.0, 0.0, 0.0}, std::array{0.0, 0.0, 0.0},
                            std::array{1e-20, 1e-20, 1e-20}, std::array{1.0, 1.0, -1e-30}}) {
    const Scene scene = loadScene(boxWith([&](Json& json) {
      for (Json& node : json["nodes"]) {
        if (node.contains("mesh")) node["scale"] = scale;
      }
    }));
    World world(scene);
    world.moveTo(0.5, 0.45);
    const View view = viewFrom(world, findCamera(scene, ""), 8, 6, glm::vec2(0.0F), glm::vec2(0.0F));
    renderFilm(world, view, {});
    for (const Instance& instance : world.instances()) {
      EXPECT_NE(glm::determinant(glm::dmat4(instance.worldFromObject)), 0.0);
    }
  }
}

TEST_F(Gltf, CameraIsFoundByNameOrRefused) {
  const Scene scene = loadScene(WALR_SCENES "/box.gltf");
  for (const char* const name : {"fence", "tiled wall", "window"}) {
    EXPECT_NE(findCamera(scene, ""), findCamera(scene, name));
  }
  fg::test::expectError<SceneError>([&] { findCamera(scene, "other"); }, {"'camera'"});
  EXPECT_THROW(findCamera(Scene{}, ""), SceneError);
}

// Loads a file and traces a few rays. The file may be refused, but only with a SceneError.
void loadAndTrace(const fs::path& file) {
  try {
    const Scene scene = loadScene(file);
    World world(scene);
    world.moveTo(0.5, 0.45);
    const View view = viewFrom(world, findCamera(scene, ""), 4, 3, glm::vec2(0.0F), glm::vec2(0.0F));
    renderFilm(world, view, {});
  } catch (const SceneError& error) {
    EXPECT_GT(std::strlen(error.what()), file.string().size());
  }
}

TEST_F(Gltf, TruncatedFilesAreErrors) {
  const std::string glb = asGlb(WALR_SCENES "/box.gltf");
  // Every length near the header, then steps through the whole file.
  for (std::size_t size = 0; size < glb.size(); size += size < 64 ? 1 : 997) {
    const fs::path file = write("cut.glb", glb.substr(0, size));
    EXPECT_THROW(loadScene(file), SceneError) << size << " bytes";
  }
}

// Replaces every number of the file, one at a time, by an unusual value.
TEST_F(Gltf, AnyWrongNumberNeverCrashes) {
  const Json original = Json::parse(std::ifstream(WALR_SCENES "/turntable.gltf")).flatten();
  std::mt19937 random(7);
  for (const auto& [key, value] : original.items()) {
    if (!value.is_number()) {
      continue;
    }
    const Json replacements[] = {-1, 0, 3000000000U, 1e300, "text", nullptr, 17};
    Json changed = original;
    changed[key] = replacements[random() % std::size(replacements)];
    loadAndTrace(write("changed.gltf", changed.unflatten().dump()));
  }
}

}  // namespace
}  // namespace walr::render
