#include "samples/render/gltf_convert.h"

#include <glm/common.hpp>

#include "samples/render/scene_error.h"

namespace walr::render::gltf {

std::string partName(const std::string& kind, std::size_t index, const std::string& name) {
  constexpr std::size_t kLongest = 60;
  const std::string shown = name.substr(0, kLongest) + (name.size() > kLongest ? "..." : "");
  return kind + " " + std::to_string(index) + (name.empty() ? "" : " '" + shown + "'");
}

std::size_t readCount(const tinygltf::Value& object, const char* key, const std::string& what) {
  const int value = object.Has(key) && object.Get(key).IsInt() ? object.Get(key).GetNumberAsInt() : -1;
  if (value < 0) throw SceneError(what + " " + key + ": must be a number that is not negative");
  return static_cast<std::size_t>(value);
}

glm::vec3 readColor(const std::vector<double>& numbers, const std::string& what, Scene& scene) {
  if (numbers.size() < 3) {
    throw SceneError(what + ": must have three numbers");
  }
  const glm::vec3 color(numbers[0], numbers[1], numbers[2]);
  constexpr float kLargest = 1e9F;
  if (!(glm::max(color.x, glm::max(color.y, color.z)) <= kLargest)) {
    throw SceneError(what + ": larger than 1e9");
  }
  if (color.x < 0.0F || color.y < 0.0F || color.z < 0.0F) {
    scene.warnings.push_back(what + ": negative components are set to 0");
  }
  return glm::max(color, glm::vec3(0.0F));
}

}  // namespace walr::render::gltf
