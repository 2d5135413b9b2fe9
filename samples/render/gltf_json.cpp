#include "samples/render/gltf_json.h"

#include <algorithm>
#include <array>
#include <span>

#include <nlohmann/json.hpp>

#include "samples/render/gltf_compression.h"
#include "samples/render/scene_error.h"
#include "samples/render/scene_limits.h"

namespace walr::render::gltf {
namespace {

using Json = nlohmann::json;

// The parser demands a buffer view of indices. Those without one get the view of this name.
constexpr const char* kAbsentView = "walr: no buffer view";

// Extensions that are only supported if a library was found when the program was built.
struct OptionalExtension {
  const char* name;
  bool built;
  const char* library;
};
#ifdef WALR_DRACO
constexpr bool kDraco = true;
#else
constexpr bool kDraco = false;
#endif
#ifdef WALR_MESHOPT
constexpr bool kMeshopt = true;
#else
constexpr bool kMeshopt = false;
#endif
constexpr std::array kOptional = {OptionalExtension{kDracoExtension, kDraco, "draco"},
                                  OptionalExtension{kMeshoptExtension, kMeshopt, "meshoptimizer"}};

void checkText(std::string_view json) {
  int depth = 0;
  std::int64_t values = 0;
  bool inString = false;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (inString) {
      i += c == '\\' ? 1 : 0;
      inString = c != '"';
    } else if (c == '"') {
      inString = true;
    } else if (c == '{' || c == '[') {
      ++values;
      if (++depth > kDeepestJson.most) {
        throw SceneError("its JSON is nested more than " + std::to_string(kDeepestJson.most) + " levels deep");
      }
    } else if (c == '}' || c == ']') {
      --depth;
    } else if (c == ',') {
      ++values;
    }
  }
  if (values > kMostJsonValues.most) {
    throw SceneError("its JSON has " + std::to_string(values) + " values; the limit is " +
                     std::to_string(kMostJsonValues.most));
  }
}

// A member of an object, or null. Wrong types are the parser's to report.
const Json& member(const Json& object, const char* name) {
  static const Json none;
  const auto found = object.is_object() ? object.find(name) : object.end();
  return found == object.end() ? none : *found;
}

// The elements of an array of the root; none if it is missing.
std::span<Json> elements(Json& root, const char* name) {
  return member(root, name).is_array() ? std::span(root[name].get_ref<Json::array_t&>()) : std::span<Json>();
}

void checkVersion(const Json& asset) {
  const auto refuse = [](const std::string& key, const std::string& value) {
    throw SceneError("its asset." + key + " is '" + value + "', but only glTF 2.0 is supported; export it as glTF 2.0");
  };
  // A later minor version may be read as 2.0, unless `minVersion` says otherwise (specification, 3.2).
  const Json& version = member(asset, "version");
  if (version.is_number()) throw SceneError("its asset.version is the number " + version.dump() + ", not a text");
  if (version.is_string() && !version.get<std::string>().starts_with("2.")) refuse("version", version);
  const Json& least = member(asset, "minVersion");
  if (least.is_string() && least != "2.0") refuse("minVersion", least);
}

void checkRequiredExtensions(const Json& required) {
  for (const Json& item : required) {
    if (!item.is_string() || isSupported(item)) continue;
    const auto* const optional = std::ranges::find(kOptional, item.get<std::string>(), &OptionalExtension::name);
    throw SceneError("it requires the extension " + item.get<std::string>() + ", which is not supported" +
                     (optional == kOptional.end()
                          ? ""
                          : std::string(", because this program was built without the library ") + optional->library) +
                     "; export the scene without it");
  }
}

// The parser takes an array that holds anything but numbers for absent. Members that are null are absent in fact.
void checkNumbers(const Json& value, const std::string& path) {
  if (value.is_object()) {
    for (const auto& [name, item] : value.items()) {
      if (name == "extras" || name == "extensions") continue;
      checkNumbers(item, path + "." + name);
    }
  }
  if (!value.is_array()) return;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const std::string element = path + "[" + std::to_string(i) + "]";
    if (value[i].is_null() || value[i].is_string()) {
      throw SceneError(element + " is " + value[i].dump() + ", not a number; exporters write null for NaN");
    }
    checkNumbers(value[i], element);
  }
}

// The parser knows few media types, and demands a buffer of exactly the length that it states.
bool plainDataUri(Json& owner, const std::string& buffer) {
  const Json& uri = member(owner, "uri");
  const std::string_view text = uri.is_string() ? std::string_view(uri.get_ref<const std::string&>()) : "";
  if (!text.starts_with("data:")) return false;
  constexpr std::string_view kEnd = ";base64";
  constexpr std::array<std::string_view, 4> kPlain = {"data:application/octet-stream;base64,",
                                                      "data:application/gltf-buffer;base64,", "data:image/png;base64,",
                                                      "data:image/jpeg;base64,"};
  const std::size_t comma = std::min(text.find(','), text.size());
  if (!text.substr(0, comma).ends_with(kEnd)) {
    if (buffer.empty()) return false;
    throw SceneError(buffer + ": its data URI is not in base64");
  }
  const std::string_view data = text.substr(std::min(comma + 1, text.size()));
  const std::size_t bytes = (data.find_last_not_of('=') + 1) * 3 / 4;
  const Json& stated = member(owner, "byteLength");
  const bool other = !buffer.empty() && stated.is_number_unsigned() && stated != bytes;
  if (other && bytes < stated.get<std::size_t>()) {
    throw SceneError(buffer + ": its data URI holds " + std::to_string(bytes) + " bytes, byteLength states " +
                     stated.dump());
  }
  if (!other && std::ranges::any_of(kPlain, [&](std::string_view head) { return text.starts_with(head); }))
    return false;
  owner["uri"] = std::string(kPlain[0]) + std::string(data);
  if (other) owner["byteLength"] = bytes;
  return true;
}

// A URI is decoded like a form, with a space for each "+", but in it a plus is a plus (RFC 3986).
bool keepPlus(Json& owner) {
  const Json& uri = member(owner, "uri");
  if (!uri.is_string()) return false;
  auto text = uri.get<std::string>();
  if (text.starts_with("data:") || text.find('+') == std::string::npos) return false;
  for (std::size_t at = text.find('+'); at != std::string::npos; at = text.find('+', at)) text.replace(at, 1, "%2B");
  owner["uri"] = text;
  return true;
}

// The parser demands a node of every channel, which those of KHR_animation_pointer lack, for instance.
bool markChannelsWithoutNode(Json& animation) {
  bool changed = false;
  if (!member(animation, "channels").is_array()) return false;
  for (Json& channel : animation["channels"]) {
    if (!member(channel, "target").is_object() || channel["target"].contains("node")) continue;
    channel["target"]["node"] = kNoNode;
    changed = true;
  }
  return changed;
}

// A material that says nothing of its colour or light is white like a primitive without a material. The specification's
// default is a metal, which would be black without specular light.
bool whiten(Json& material) {
  constexpr std::array kTelling = {"pbrMetallicRoughness", "emissiveFactor", "extensions"};
  if (!material.is_object() || std::ranges::any_of(kTelling, [&](const char* key) { return material.contains(key); })) {
    return false;
  }
  material["pbrMetallicRoughness"]["metallicFactor"] = 0.0;
  return true;
}

}  // namespace

bool isSupported(const std::string& extension) {
  constexpr std::array kAlways = {"KHR_lights_punctual", "KHR_materials_emissive_strength",
                                  kSpecularGlossinessExtension, "KHR_mesh_quantization", "KHR_texture_transform"};
  return std::ranges::find(kAlways, extension) != kAlways.end() ||
         std::ranges::any_of(kOptional, [&](const OptionalExtension& o) { return o.built && o.name == extension; });
}

std::optional<std::string> prepareJson(std::string_view text, bool hasChunk, std::deque<std::size_t>& fileLengths) {
  checkText(text);
  Json json = Json::parse(text, nullptr, false);
  checkVersion(member(json, "asset"));
  checkRequiredExtensions(member(json, "extensionsRequired"));
  // Views that are only stored compressed lie in buffers without a file.
  const bool onlyCompressed = std::ranges::count(elements(json, "extensionsRequired"), kMeshoptExtension) > 0;
  for (const char* const part : {"nodes", "materials"}) checkNumbers(member(json, part), part);
  // Not rendered. The parser demands members of them that the specification does not.
  bool changed = json.is_object() && json.erase("skins") > 0;
  for (Json& image : elements(json, "images")) changed = plainDataUri(image, "") || keepPlus(image) || changed;
  for (Json& animation : elements(json, "animations")) changed = markChannelsWithoutNode(animation) || changed;
  for (Json& material : elements(json, "materials")) changed = whiten(material) || changed;
  const std::span<Json> buffers = elements(json, "buffers");
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    Json& buffer = buffers[i];
    changed = plainDataUri(buffer, "buffer " + std::to_string(i)) || keepPlus(buffer) || changed;
    const Json& uri = member(buffer, "uri");
    if (uri.is_string() && !uri.get_ref<const std::string&>().starts_with("data:")) {
      const Json& length = member(buffer, "byteLength");
      fileLengths.push_back(length.is_number_unsigned() ? length.get<std::size_t>() : 0);
    }
    if (!buffer.is_object() || buffer.contains("uri") || (hasChunk && i == 0)) continue;
    if (onlyCompressed) {
      buffer["uri"] = "data:application/octet-stream;base64,AA==";
      buffer["byteLength"] = 1;
      changed = true;
    } else {
      throw SceneError("buffer " + std::to_string(i) +
                       ": has no uri, which only the first one of a GLB file with a binary chunk may lack");
    }
  }
  const std::size_t views = elements(json, "bufferViews").size();
  for (Json& accessor : elements(json, "accessors")) {
    if (!accessor.is_object() || accessor.contains("bufferView")) continue;
    accessor["bufferView"] = views;
    if (!json["bufferViews"].is_array()) json["bufferViews"] = Json::array();
    json["bufferViews"][views] = {{"buffer", 0}, {"byteLength", 1}, {"name", kAbsentView}};
    changed = true;
  }
  return changed ? std::optional(json.dump()) : std::nullopt;
}

void restoreAbsentViews(tinygltf::Model& model) {
  if (model.bufferViews.empty() || model.bufferViews.back().name != kAbsentView) return;
  model.bufferViews.pop_back();
  for (tinygltf::Accessor& accessor : model.accessors) {
    if (accessor.bufferView == static_cast<int>(model.bufferViews.size())) accessor.bufferView = -1;
  }
}

}  // namespace walr::render::gltf
