#include "samples/sequence/cameras.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>

#include <glm/gtc/type_ptr.hpp>
#include <nlohmann/json.hpp>

#include "samples/errors.h"

namespace walr {
namespace {

using Json = nlohmann::json;

void requireFinite(const float* values, std::size_t count, const std::string& what) {
  for (std::size_t i = 0; i < count; ++i) {
    if (!std::isfinite(values[i])) {
      throw InputError(what + " holds a value that is not finite");
    }
  }
}

/// The number of a frame in `cameras.json`.
int readFrameNumber(const Json& entry, const std::string& file) {
  const auto number = entry.is_object() ? entry.find("frame") : entry.end();
  if (number == entry.end() || !number->is_number_integer()) {
    throw InputError(file + ": an entry of \"frames\" lacks the integer \"frame\"");
  }
  // As a double, because unsigned numbers of 64 bits have no signed type that holds them.
  const double value = number->get<double>();
  if (value < 0.0 || value > std::numeric_limits<int>::max()) {
    throw InputError(file + ": frame " + number->dump() + " is out of range");
  }
  return number->get<int>();
}

/// Copies the array `key` of `count` numbers to `values`.
void readNumbers(const Json& object, const char* key, const std::string& where, float* values, std::size_t count) {
  const auto entry = object.find(key);
  if (entry == object.end()) {
    throw InputError(where + " lacks \"" + key + "\" (" + std::to_string(count) + " numbers)");
  }
  const bool areNumbers = entry->is_array() && std::ranges::all_of(*entry, [](const Json& e) { return e.is_number(); });
  if (!areNumbers || entry->size() != count) {
    throw InputError(where + ": \"" + key + "\" must be an array of " + std::to_string(count) + " numbers" +
                     (count == 16 ? ", the matrix column after column" : ""));
  }
  for (std::size_t i = 0; i < count; ++i) values[i] = (*entry)[i].get<float>();
  requireFinite(values, count, where + ": \"" + key + "\"");
}

glm::mat4 readMatrix(const Json& object, const char* key, const std::string& where) {
  glm::mat4 matrix(1.0F);
  readNumbers(object, key, where, glm::value_ptr(matrix), 16);
  return matrix;
}

/// @throws std::invalid_argument naming the attribute if a component is no whole number or is far out of range
glm::uvec2 wholeNumbers(glm::vec2 value, const char* attribute) {
  constexpr float kMost = 1000.0F;
  for (int c = 0; c < 2; ++c) {
    const bool whole = value[c] >= 0.0F && value[c] <= kMost && value[c] == std::floor(value[c]);
    if (!whole) throw std::invalid_argument(std::string("header attribute ") + attribute + " holds no whole numbers");
  }
  return glm::uvec2(value);
}

}  // namespace

std::map<int, Camera> readCameraFile(const std::filesystem::path& path) {
  requireRegularFile(path);
  std::ifstream stream(path);
  if (!stream) {
    throw InputError("cannot read " + path.string() +
                     ": the frames need a cameras.json in their folder with view, prev_view and projection "
                     "of every frame");
  }
  Json document;
  try {
    document = Json::parse(stream);
  } catch (const Json::exception& error) {  // Also of numbers that no double holds.
    throw InputError(path.string() + " is not valid JSON: " + error.what());
  }
  if (!document.is_object() || !document.contains("frames") || !document["frames"].is_array()) {
    throw InputError(path.string() + " lacks the array \"frames\"");
  }
  std::map<int, Camera> cameras;
  for (const Json& entry : document["frames"]) {
    const int number = readFrameNumber(entry, path.string());
    const std::string where = path.string() + ": frame " + std::to_string(number);
    Camera camera;
    camera.view = readMatrix(entry, "view", where);
    camera.previousView = readMatrix(entry, "prev_view", where);
    camera.projection = readMatrix(entry, "projection", where);
    if (entry.contains("jitter")) {
      readNumbers(entry, "jitter", where, glm::value_ptr(camera.jitter), 2);
    }
    if (entry.contains("cut")) {
      if (!entry["cut"].is_boolean()) {
        throw InputError(where + ": \"cut\" must be true or false");
      }
      camera.cut = entry["cut"].get<bool>();
    }
    if (!cameras.emplace(number, camera).second) {
      throw InputError(where + " is listed twice");
    }
  }
  return cameras;
}

SparseLight readLightAttributes(const ExrReader& file) {
  const std::optional<glm::vec2> group = file.vector(kLightGroupAttribute);
  const std::optional<glm::vec2> offset = file.vector(kLightOffsetAttribute);
  SparseLight light;
  if (!group && !offset) return light;
  try {
    const glm::uvec2 size = wholeNumbers(group.value_or(glm::vec2(1.0F)), kLightGroupAttribute);
    light.pattern = {.columns = size.x, .rows = size.y};
    checkLightPattern(light.pattern);
    light.offset = glm::ivec2(wholeNumbers(offset.value_or(glm::vec2(0.0F)), kLightOffsetAttribute));
    checkLightOffset(light.pattern, light.offset);
  } catch (const std::invalid_argument& error) {
    throw InputError(file.path().string() + ": " + error.what());
  }
  return light;
}

Camera readCameraAttributes(const ExrReader& file) {
  const auto require = [&](const char* name) {
    const std::optional<glm::mat4> matrix = file.matrix(name);
    if (!matrix) {
      throw InputError(file.path().string() + ": no camera, the header attribute " + name + " (M44f) is missing");
    }
    requireFinite(glm::value_ptr(*matrix), 16, file.path().string() + ": header attribute " + name);
    return *matrix;
  };
  Camera camera;
  camera.view = require(kViewAttribute);
  camera.previousView = require(kPreviousViewAttribute);
  camera.projection = require(kProjectionAttribute);
  camera.jitter = file.vector(kJitterAttribute).value_or(glm::vec2(0.0F));
  requireFinite(glm::value_ptr(camera.jitter), 2, file.path().string() + ": header attribute " + kJitterAttribute);
  camera.cut = file.integer(kCutAttribute).value_or(0) != 0;
  return camera;
}

}  // namespace walr
