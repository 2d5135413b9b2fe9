// What the files of a scene may make the loader allocate, and how long damaged ones may take.
#include "samples/render/scene_limits.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "samples/render/film.h"
#include "samples/render/image_decode.h"
#include "samples/render/load_scene.h"
#include "samples/render/scene_error.h"
#include "samples/render/view.h"
#include "samples/render/world.h"
#include "tests/damaged_files.h"
#include "tests/error_text.h"
#include "tests/limits_table.h"
#include "tests/render/gltf_builder.h"
#include "tests/render/small_jpeg.h"
#include "tests/render/small_png.h"
#include "tests/samples/temporary_directory.h"

namespace walr::render {
namespace {

using Json = nlohmann::json;
using test::GltfBuilder;
using walr::test::below;

TEST(SceneLimits, AreThoseOfTheManual) {
  walr::test::checkTableOfLimits(kSceneLimits, "samples/docs/render.md", "Limits of scenes");
}

// ---- Images ----

std::span<const std::uint8_t> bytesOf(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

std::string png(std::uint32_t side, int bits, int colour, bool interlaced, std::size_t dataBytes) {
  return test::smallPng(side, bits, colour, interlaced, std::string(dataBytes, '\0'));
}

/// A JPEG that says of itself to be larger.
std::string largeJpeg() {
  std::string jpeg = test::smallJpeg();
  const std::size_t at = jpeg.find("\xff\xc0");  // The frame's header: length, bits, height, width.
  EXPECT_NE(at, std::string::npos);
  std::memcpy(&jpeg[at + 5], "\x40\x00\x40\x00", 4);
  return jpeg;
}

// The widest image, in some hundred bytes.
TEST(ImageLimits, AnImageThatItsBytesCannotHoldIsRefusedBeforeMemoryIsAllocated) {
  for (const std::string& image : {png(16384, 8, 0, false, 100), png(16384, 16, 6, false, 100),
                                   png(16384, 8, 6, true, 100), png(16384, 1, 3, false, 100), largeJpeg()}) {
    std::uint64_t budget = kMostTexels.most;
    std::string warning;
    walr::test::takeLargestRequest();
    fg::test::expectError<SceneError>([&] { decodeImage(bytesOf(image), budget, warning); },
                                      {"its data cannot hold 16384 x 16384 texels"});
    EXPECT_LT(walr::test::takeLargestRequest(), 1U << 17U);
  }
}

TEST(ImageLimits, ASmallPngDoesNotExpandToMoreThanItsPixels) {
  std::uint64_t budget = 1000;
  std::string warning;
  const std::string large = png(4, 8, 0, false, std::size_t{1} << 24U);
  walr::test::takeLargestRequest();
  EXPECT_EQ(decodeImage(bytesOf(large), budget, warning).width, 4U);
  EXPECT_LT(walr::test::takeLargestRequest(), 1U << 17U);
}

std::vector<std::string> images() {
  std::vector<std::string> all{test::smallJpeg()};
  for (const bool interlaced : {false, true}) {
    for (const auto& [bits, colour] : {std::pair{1, 0}, {8, 0}, {16, 0}, {8, 2}, {2, 3}, {8, 3}, {8, 4}, {16, 6}}) {
      all.push_back(png(9, bits, colour, interlaced, 9 * (9 * 8 + 1)));
    }
  }
  return all;
}

/// Changes some bytes, mostly of the header, where sizes and types are.
std::string changed(std::string bytes, std::size_t header, std::mt19937_64& random) {
  constexpr std::array<unsigned char, 8> kBytes{0, 1, 2, 0x10, 0x40, 0x7f, 0x80, 0xff};
  for (std::size_t changes = 1 + below(random, 3); changes > 0; --changes) {
    const std::size_t at = below(random, below(random, 3) == 0 ? bytes.size() : std::min(header, bytes.size()));
    bytes[at] = static_cast<char>(below(random, 2) == 0 ? kBytes[below(random, kBytes.size())] : random());
  }
  if (below(random, 8) == 0) bytes.resize(below(random, bytes.size()));
  return bytes;
}

TEST(ImageLimits, DamagedImagesNeitherCrashNorHangNorFillMemory) {
  const std::vector<std::string> whole = images();
  walr::test::tryDamagedFiles({.read =
                                   [&](std::mt19937_64& random, std::uint64_t seed) {
                                     const std::string& image = whole[seed % whole.size()];
                                     const std::string bytes = changed(image, 64, random);
                                     std::uint64_t budget = kMostTexels.most;
                                     std::string warning;
                                     try {
                                       const Image read = decodeImage(bytesOf(bytes), budget, warning);
                                       EXPECT_EQ(read.rgba.size(), std::size_t{4} * read.width * read.height);
                                       return true;
                                     } catch (const SceneError&) {
                                       return false;
                                     }
                                   },
                               // RGBA of the most texels that a byte of a PNG can hold, 1032 bytes of 8 texels each, in
                               // a kilobyte.
                               .largestRequest = std::size_t{4 * 1032 * 8} * 1024});
}

// ---- Scenes ----

/// A scene with most of what is read, and its bytes.
GltfBuilder scene() {
  GltfBuilder builder;
  builder.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0.25F});
  Json& attributes = builder.primitive()["attributes"];
  const std::vector<std::int8_t> normals{0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0};
  attributes["TEXCOORD_0"] = builder.accessor<float>(GltfBuilder::Float, "VEC2", {0, 0, 1, 0, 0, 1, 1, 1});
  attributes["COLOR_0"] =
      builder.accessor<std::uint8_t>(GltfBuilder::UnsignedByte, "VEC4", std::vector<std::uint8_t>(16, 200));
  builder.json["accessors"][2]["normalized"] = true;
  attributes["NORMAL"] = builder.zeros(GltfBuilder::Byte, "VEC3", 4);
  builder.json["accessors"][3].update({{"bufferView", builder.view(normals)}, {"normalized", true}});
  builder.json["bufferViews"].back()["byteStride"] = 4;
  builder.primitive()["indices"] =
      builder.accessor<std::uint16_t>(GltfBuilder::UnsignedShort, "SCALAR", {0, 1, 2, 1, 3, 2});
  // Replaces one of the positions.
  builder.json["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", builder.view<std::uint16_t>({3})}, {"componentType", GltfBuilder::UnsignedShort}}},
      {"values", {{"bufferView", builder.view<float>({1, 1, 0.5F})}}}};
  const std::size_t times = builder.accessor<float>(GltfBuilder::Float, "SCALAR", {0, 1});
  const std::size_t turns = builder.accessor<float>(GltfBuilder::Float, "VEC4", {0, 0, 0, 1, 0, 1, 0, 0});
  builder.json["nodes"] = {{{"mesh", 0}, {"children", {1, 2}}},
                           {{"translation", {0, 0, 3}}, {"camera", 0}},
                           {{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1}},
                            {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}};
  builder.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}}}};
  builder.json["animations"] = {{{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "rotation"}}}}}},
                                 {"samplers", {{{"input", times}, {"output", turns}}}}}};
  builder.json["extensionsUsed"] = {"KHR_lights_punctual", "KHR_texture_transform", "KHR_materials_emissive_strength"};
  builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "spot"}, {"intensity", 3}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.5}}}}};
  const std::string image = png(9, 8, 2, false, 9 * (9 * 3 + 1));
  builder.json["images"] = {
      {{"bufferView", builder.view(std::vector<char>(image.begin(), image.end()))}, {"mimeType", "image/png"}}};
  builder.json["samplers"] = {{{"wrapS", 33648}}};
  builder.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
  builder.material() = {
      {"pbrMetallicRoughness",
       {{"baseColorFactor", {0.5, 0.5, 0.5, 1}},
        {"baseColorTexture", {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"scale", {2, 2}}}}}}}}}},
      {"emissiveFactor", {0.1, 0, 0}},
      {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 2}}}}},
      {"alphaMode", "MASK"}};
  return builder;
}

/// Every value of a text, as a path.
void addPaths(const Json& value, const Json::json_pointer& at, std::vector<Json::json_pointer>& paths) {
  paths.push_back(at);
  if (value.is_object()) {
    for (const auto& [name, item] : value.items()) addPaths(item, at / name, paths);
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) addPaths(value[i], at / i, paths);
  }
}

Json someValue(std::mt19937_64& random) {
  static const std::vector<Json> values{0,
                                        1,
                                        2,
                                        3,
                                        -1,
                                        255,
                                        5121,
                                        5126,
                                        65535,
                                        1U << 30U,
                                        0x7fffffff,
                                        1.5e9,
                                        4e9,
                                        1e19,
                                        1e39,
                                        -1e300,
                                        0.5,
                                        "",
                                        "VEC3",
                                        "MAT4",
                                        "none.bin",
                                        "data:application/octet-stream;base64,AAAA",
                                        true,
                                        nullptr,
                                        Json::array(),
                                        Json::object(),
                                        Json::array({1, 2, 3}),
                                        std::string(300, 'x'),
                                        0xffffffffU};
  return values[below(random, values.size())];
}

/// Changes values of the text: most damage that a byte would do ends the parser at once.
void change(Json& json, const std::vector<Json::json_pointer>& paths, std::mt19937_64& random) {
  for (std::size_t changes = 1 + below(random, 3); changes > 0; --changes) {
    const Json::json_pointer& path = paths[1 + below(random, paths.size() - 1)];
    if (!json.contains(path)) continue;
    const Json::json_pointer parent = path.parent_pointer();
    switch (below(random, 6)) {
      case 0:
        if (json[parent].is_object()) json[parent].erase(path.back());
        break;
      case 1: {
        const Json::json_pointer& other = paths[below(random, paths.size())];
        if (json.contains(other)) json[path] = Json(json[other]);
        break;
      }
      case 2:
        if (json[parent].is_array()) json[parent].push_back(Json(json[path]));
        break;
      default:
        json[path] = someValue(random);
    }
  }
}

TEST(SceneLimits, DamagedScenesNeitherCrashNorHangNorFillMemory) {
  const walr::test::TemporaryDirectory directory;
  const std::filesystem::path file = directory.path() / "a.glb";
  const GltfBuilder whole = scene();
  std::vector<Json::json_pointer> paths;
  addPaths(whole.json, Json::json_pointer(), paths);
  const auto read = [&](std::mt19937_64& random, std::uint64_t seed) {
    GltfBuilder builder = whole;
    const bool inBytes = below(random, 8) == 0;
    if (!inBytes) change(builder.json, paths, random);
    std::string bytes = builder.glb();
    if (inBytes) bytes = changed(bytes, 40, random);
    std::ofstream(file, std::ios::binary) << bytes;
    try {
      const Scene loaded = loadScene(file);
      // Rendering takes longer than all else, so that not every scene is rendered.
      if (seed % 16 != 0) return true;
      World world(loaded);
      world.moveTo(0.5, 0.45);
      renderFilm(world, viewFrom(world, findCamera(loaded, ""), 4, 3, glm::vec2(0.0F), glm::vec2(0.0F)), {});
      return true;
    } catch (const SceneError& error) {
      EXPECT_NE(std::string(error.what()).size(), 0U);
      return false;
    }
  };
  // Zeros of accessors without a buffer view, of four floats.
  walr::test::tryDamagedFiles({.read = read, .largestRequest = std::size_t{4 * 4} * kMostZeros.most, .files = 300});
}

TEST(SceneLimits, TheSceneThatIsDamagedIsWhole) {
  const walr::test::TemporaryDirectory directory;
  const std::filesystem::path file = directory.path() / "a.glb";
  std::ofstream(file, std::ios::binary) << scene().glb();
  const Scene loaded = loadScene(file);
  EXPECT_TRUE(loaded.warnings.empty()) << testing::PrintToString(loaded.warnings);
  EXPECT_EQ(loaded.images.size(), 1U);
}

}  // namespace
}  // namespace walr::render
