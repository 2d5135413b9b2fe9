#include "samples/sequence/channel_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <string_view>

#include <nlohmann/json.hpp>

#include "passes/settings/text.h"
#include "samples/errors.h"

namespace walr {
namespace {

using Json = nlohmann::json;

/// A member that has one of two values; without it, the first one.
bool isSecond(const Json& document, const char* name, const std::array<std::string_view, 2>& values) {
  const auto member = document.find(name);
  if (member == document.end()) return false;
  if (!member->is_string() || std::ranges::find(values, member->get<std::string>()) == values.end()) {
    throw InputError(std::string("\"") + name + "\" must be \"" + std::string(values[0]) + "\" or \"" +
                     std::string(values[1]) + "\"");
  }
  return member->get<std::string>() == values[1];
}

glm::vec2 readScale(const Json& document) {
  const auto scale = document.find("motionScale");
  if (scale == document.end()) return glm::vec2(1.0F);
  const auto number = [&](std::size_t i) { return (*scale)[i].is_number() ? (*scale)[i].get<float>() : NAN; };
  if (!scale->is_array() || scale->size() != 2 || !std::isfinite(number(0)) || !std::isfinite(number(1))) {
    throw InputError("\"motionScale\" must be an array of 2 numbers");
  }
  return {number(0), number(1)};
}

void requireKnown(const Json& object, std::initializer_list<std::string_view> names, const std::string& where) {
  for (const auto& [name, value] : object.items()) {
    if (std::ranges::find(names, name) == names.end()) {
      throw InputError(where + " has the unknown member \"" + name + "\"; known are " + join(names));
    }
  }
}

/// The plane with the channels that the map names, if it names some. Motion may lack its third channel.
Plane readPlane(const Json& channels, Plane plane, ChannelMap& map) {
  const auto names = channels.find(std::string(plane.name));
  const std::size_t most = plane.components.size();
  const std::size_t fewest = plane.role == Role::Motion ? 2 : most;
  if (names != channels.end()) {
    const bool texts = names->is_array() && std::ranges::all_of(*names, [](const Json& n) { return n.is_string(); });
    if (!texts || names->size() < fewest || names->size() > most) {
      throw InputError("\"" + std::string(plane.name) + "\" must be an array of " +
                       (fewest < most ? std::to_string(fewest) + " or " : "") + std::to_string(most) +
                       " names of channels");
    }
    plane.components = plane.components.substr(0, names->size());
    for (std::size_t c = 0; c < names->size(); ++c) {
      map.channels[std::string(plane.name) + "." + plane.components[c]] = (*names)[c].get<std::string>();
    }
  }
  return plane;
}

void read(const Json& document, ChannelMap& map) {
  if (!document.is_object() || !document.contains("channels") || !document["channels"].is_object()) {
    throw InputError("it lacks the object \"channels\"");
  }
  requireKnown(document, {"channels", "normals", "depth", "light", "motionScale", "cameras"}, "it");
  const Json& channels = document["channels"];
  requireKnown(channels,
               {"Indirect", "Direct", "Albedo", "Normal", "Depth", "Motion", "Emission", "ObjectId", "Specular",
                "SpecularAlbedo", "SpecularDistance", "Roughness", "SpecularMotion"},
               "\"channels\"");
  map.layout = projectLayout();
  map.layout.name = "channel map";
  for (const Plane& plane : map.layout.planes) map.planes.push_back(readPlane(channels, plane, map));
  map.layout.planes = map.planes;
  map.layout.objectId = readPlane(channels, map.layout.objectId, map);
  for (const Plane& plane : map.layout.specular) {
    if (channels.contains(plane.name)) map.specular.push_back(readPlane(channels, plane, map));
  }
  if (!map.specular.empty() && !(channels.contains("Specular") && channels.contains("SpecularAlbedo"))) {
    throw InputError("\"channels\" must have both \"Specular\" and \"SpecularAlbedo\", or nothing of specular light");
  }
  map.layout.specular = map.specular;
  if (!map.channels.contains("Motion.Z")) {
    map.layout.conventions.motionDepth = InputConventions::MotionDepth::StaticScene;
  }
  if (isSecond(document, "normals", {"view", "world"})) {
    map.layout.conventions.normal = InputConventions::Space::World;
  }
  if (!isSecond(document, "cameras", {"cameras.json", "header"})) map.layout.cameras = CameraSource::JsonFile;
  map.layout.motionScale = readScale(document);
  map.depthIsDistance = isSecond(document, "depth", {"along the axis", "distance"});
  map.lightTimesAlbedo = isSecond(document, "light", {"without albedo", "times albedo"});
  if (!map.specular.empty()) {
    map.added = {{&Frame::nonDiffuse, "Specular", map.lightTimesAlbedo ? std::string_view() : "SpecularAlbedo", false}};
  }
  map.layout.added = map.added;
}

/// The depth along the axis of points at a distance from the camera.
void projectDistance(Image& depth, const Camera& camera) {
  const glm::mat4& projection = camera.projection;
  const glm::vec2 size(depth.width(), depth.height());
  for (int y = 0; y < depth.height(); ++y) {
    for (int x = 0; x < depth.width(); ++x) {
      const glm::vec2 position = (glm::vec2(x, y) + 0.5F + camera.jitter) / size;
      const glm::vec2 ndc(2.0F * position.x - 1.0F, 1.0F - 2.0F * position.y);
      const glm::vec2 slope((ndc.x + projection[2][0]) / projection[0][0],
                            (ndc.y + projection[2][1]) / projection[1][1]);
      float& value = depth.at(x, y, 0);
      if (value < kSkyDepth) value /= std::sqrt(1.0F + slope.x * slope.x + slope.y * slope.y);
    }
  }
}

}  // namespace

void divideByAlbedo(Image& light, const Image& albedo) {
  for (std::size_t i = 0; i < light.values().size(); ++i) {
    const float reflected = albedo.values()[i];
    light.values()[i] = reflected <= 0.0F ? 0.0F : light.values()[i] / reflected;  // NaN if the albedo is.
  }
}

void convertByMap(const ChannelMap& map, Frame& frame) {
  if (map.depthIsDistance) projectDistance(frame.depth, frame.camera);
  if (!map.lightTimesAlbedo) return;
  for (Image* const light : {&frame.indirect, &frame.direct}) divideByAlbedo(*light, frame.albedo);
  divideByAlbedo(frame.specular, frame.specularAlbedo);
}

void readChannelMap(const std::filesystem::path& path, ChannelMap& map) {
  requireRegularFile(path);
  std::ifstream stream(path);
  if (!stream) throw InputError("cannot read the map of channels " + path.string());
  try {
    read(Json::parse(stream), map);
  } catch (const Json::exception& error) {
    throw InputError(path.string() + " is not valid JSON: " + error.what());
  } catch (const InputError& error) {
    throw InputError("map of channels " + path.string() + ": " + error.what());
  }
}

}  // namespace walr
