#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace walr::render::test {

/// Builds small glTF files: a mesh with one primitive of one material, seen by no camera and lit by a sky.
class GltfBuilder {
 public:
  enum ComponentType { Byte = 5120, UnsignedByte, Short, UnsignedShort, UnsignedInt = 5125, Float };

  nlohmann::json json = {{"asset", {{"version", "2.0"}}},
                         {"scenes", {{{"nodes", {0}}, {"extras", {{"sky_radiance", {1, 1, 1}}}}}}},
                         {"nodes", {{{"mesh", 0}}}},
                         {"materials", {nlohmann::json::object()}},
                         {"meshes", {{{"primitives", {{{"attributes", nlohmann::json::object()}, {"material", 0}}}}}}}};

  [[nodiscard]] nlohmann::json& primitive() { return json["meshes"][0]["primitives"][0]; }
  [[nodiscard]] nlohmann::json& material() { return json["materials"][0]; }

  /// Add a buffer view of values. @returns its index
  template <typename T>
  std::size_t view(const std::vector<T>& values) {
    bytes_.resize((bytes_.size() + 3) / 4 * 4);
    const std::size_t offset = bytes_.size();
    const std::size_t length = values.size() * sizeof(T);
    bytes_.append(reinterpret_cast<const char*>(values.data()), length);
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", length}});
    return json["bufferViews"].size() - 1;
  }

  /// Add an accessor without a buffer view. @returns its index
  std::size_t zeros(ComponentType componentType, const std::string& type, std::size_t count) {
    json["accessors"].push_back({{"componentType", componentType}, {"type", type}, {"count", count}});
    return json["accessors"].size() - 1;
  }

  /// Add an accessor of values. @returns its index
  template <typename T>
  std::size_t accessor(ComponentType componentType, const std::string& type, const std::vector<T>& values) {
    const std::size_t components = type == "SCALAR" ? 1 : static_cast<std::size_t>(type.back() - '0');
    const std::size_t index = zeros(componentType, type, values.size() / components);
    json["accessors"][index]["bufferView"] = view(values);
    return index;
  }

  /// Give the primitive positions. @returns their accessor
  std::size_t positions(const std::vector<float>& values) {
    const std::size_t index = accessor(Float, "VEC3", values);
    primitive()["attributes"]["POSITION"] = index;
    return index;
  }

  /// The bytes of a .glb file.
  [[nodiscard]] std::string glb() {
    if (!bytes_.empty()) json["buffers"][0] = {{"byteLength", bytes_.size()}};
    const auto word = [](std::size_t value) {
      const auto narrow = static_cast<std::uint32_t>(value);
      return std::string(reinterpret_cast<const char*>(&narrow), sizeof narrow);
    };
    const auto chunk = [&](const std::string& type, std::string data, char padding) {
      data.resize((data.size() + 3) / 4 * 4, padding);
      return word(data.size()) + type + data;
    };
    const std::string chunks = chunk("JSON", json.dump(), ' ') + chunk({"BIN", 4}, bytes_, '\0');
    return "glTF" + word(2) + word(12 + chunks.size()) + chunks;
  }

  /// Write the file and its buffer to a folder.
  [[nodiscard]] std::filesystem::path write(const std::filesystem::path& folder) {
    if (!bytes_.empty()) {
      json["buffers"][0] = {{"uri", "built.bin"}, {"byteLength", bytes_.size()}};
      std::ofstream(folder / "built.bin", std::ios::binary) << bytes_;
    }
    std::ofstream(folder / "built.gltf") << json.dump();
    return folder / "built.gltf";
  }

 private:
  std::string bytes_;
};

}  // namespace walr::render::test
