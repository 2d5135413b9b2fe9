#include <array>
#include <cmath>
#include <numbers>

#include <glm/gtc/type_ptr.hpp>

#include "samples/render/gltf_convert.h"
#include "samples/render/scene_error.h"

namespace walr::render::gltf {
namespace {

constexpr const char* kPunctualLights = "KHR_lights_punctual";

using OptionalIndices = std::vector<std::optional<std::uint32_t>>;

template <std::size_t N>
std::optional<std::array<float, N>> readNumbers(const std::vector<double>& numbers, const std::string& what) {
  if (numbers.empty()) {
    return std::nullopt;
  }
  if (numbers.size() != N) {
    throw SceneError(what + ": must have " + std::to_string(N) + " numbers");
  }
  std::array<float, N> values{};
  for (std::size_t i = 0; i < N; ++i) {
    values[i] = static_cast<float>(numbers[i]);
    if (!std::isfinite(values[i])) {
      throw SceneError(what + ": is not finite");
    }
  }
  return values;
}

Transform readTransform(const tinygltf::Node& source, const std::string& name) {
  Transform transform;
  if (const auto t = readNumbers<3>(source.translation, name + " translation")) {
    transform.translation = glm::make_vec3(t->data());
  }
  if (const auto r = readNumbers<4>(source.rotation, name + " rotation")) {
    const glm::quat rotation((*r)[3], (*r)[0], (*r)[1], (*r)[2]);
    if (!(glm::length(rotation) > 0.0F)) {
      throw SceneError(name + " rotation: is not a unit quaternion");
    }
    transform.rotation = glm::normalize(rotation);
  }
  if (const auto s = readNumbers<3>(source.scale, name + " scale")) {
    transform.scale = glm::make_vec3(s->data());
  }
  return transform;
}

// Of a projection without a far plane that is beyond the farthest one otherwise.
constexpr float kFarOfNear = 1000.0F;
constexpr float kLargestNear = 1e30F;

void convertCameras(const tinygltf::Model& model, Scene& scene) {
  for (std::size_t i = 0; i < model.cameras.size(); ++i) {
    const tinygltf::Camera& source = model.cameras[i];
    const std::string name = partName("camera", i, source.name);
    Camera camera;
    camera.name = source.name;
    if (source.type == "perspective") {
      camera.yfov = static_cast<float>(source.perspective.yfov);
      camera.znear = static_cast<float>(source.perspective.znear);
      const bool infinite = !(source.perspective.zfar > 0.0);
      if (!infinite) camera.zfar = static_cast<float>(source.perspective.zfar);
      if (infinite && camera.znear >= camera.zfar) camera.zfar = kFarOfNear * camera.znear;
      if (!(camera.yfov > 0.0F && camera.yfov < std::numbers::pi_v<float>)) {
        throw SceneError(name + ": its vertical field of view must lie between 0 and pi");
      }
      if (!(camera.znear > 0.0F && camera.znear < kLargestNear && camera.zfar > camera.znear)) {
        throw SceneError(name + (infinite ? ": must have 0 < znear < 1e30" : ": must have 0 < znear < zfar"));
      }
    } else {
      scene.warnings.push_back(name + ": only perspective cameras are supported; replaced by one with yfov 0.8");
    }
    scene.cameras.push_back(camera);
  }
}

void convertLights(const tinygltf::Model& model, Scene& scene) {
  for (std::size_t i = 0; i < model.lights.size(); ++i) {
    const tinygltf::Light& source = model.lights[i];
    const std::string name = partName("light", i, source.name);
    PunctualLight light;
    if (source.type == "directional") {
      light.kind = PunctualLight::Kind::Directional;
    } else if (source.type == "point") {
      light.kind = PunctualLight::Kind::Point;
    } else if (source.type == "spot") {
      light.kind = PunctualLight::Kind::Spot;
      if (!(source.spot.innerConeAngle >= 0.0 && source.spot.innerConeAngle <= source.spot.outerConeAngle &&
            source.spot.outerConeAngle <= std::numbers::pi / 2.0 + 1e-6)) {
        throw SceneError(name + ": must have 0 <= innerConeAngle <= outerConeAngle <= pi / 2");
      }
      light.cosInnerCone = static_cast<float>(std::cos(source.spot.innerConeAngle));
      light.cosOuterCone = static_cast<float>(std::cos(source.spot.outerConeAngle));
    } else {
      throw SceneError(name + ": unknown type '" + source.type + "'");
    }
    constexpr double kLargest = 1e9;
    if (!(source.intensity >= 0.0 && source.intensity <= kLargest)) {
      throw SceneError(name + ": its intensity must lie in 0..1e9");
    }
    const std::vector<double> white{1.0, 1.0, 1.0};
    light.intensity = readColor(source.color.empty() ? white : source.color, name + " color", scene) *
                      static_cast<float>(source.intensity);
    if (source.range > 0.0) {
      scene.warnings.push_back(name + ": its range is ignored; light falls off with the squared distance only");
    }
    scene.lights.push_back(light);
  }
}

std::optional<std::uint32_t> optionalIndex(int index, std::size_t size, const std::string& what) {
  if (index < 0) {
    return std::nullopt;
  }
  if (static_cast<std::size_t>(index) >= size) {
    throw SceneError(what + ": there is no index " + std::to_string(index));
  }
  return static_cast<std::uint32_t>(index);
}

Node convertNode(const tinygltf::Node& source, const std::string& name,
                 const std::vector<std::vector<std::uint32_t>>& meshes, Scene& scene) {
  Node node;
  node.name = source.name;
  node.transform = readTransform(source, name);
  if (const auto matrix = readNumbers<16>(source.matrix, name + " matrix")) {
    node.matrix = glm::make_mat4(matrix->data());
  }
  if (const std::optional<std::uint32_t> mesh = optionalIndex(source.mesh, meshes.size(), name + " mesh")) {
    node.meshes = meshes[*mesh];
  }
  node.camera = optionalIndex(source.camera, scene.cameras.size(), name + " camera");
  if (const auto extension = source.extensions.find(kPunctualLights); extension != source.extensions.end()) {
    const int light = extension->second.Has("light") ? extension->second.Get("light").GetNumberAsInt() : -1;
    node.light = optionalIndex(light, scene.lights.size(), name + " light");
  }
  if (source.skin >= 0) {
    scene.warnings.push_back(
        name +
        ": skinning is not supported; joints are ignored, and the mesh is shown as it was modelled, where its node is");
  }
  return node;
}

void convertSky(const tinygltf::Scene& source, Scene& scene) {
  if (!source.extras.IsObject() || !source.extras.Has("sky_radiance")) {
    return;
  }
  const tinygltf::Value& sky = source.extras.Get("sky_radiance");
  std::vector<double> radiance;
  for (std::size_t i = 0; sky.IsArray() && i < sky.ArrayLen(); ++i) {
    radiance.push_back(sky.Get(static_cast<int>(i)).GetNumberAsDouble());
  }
  scene.skyRadiance = readColor(radiance, "scene extras sky_radiance", scene);
}

}  // namespace

void convertNodes(const tinygltf::Model& model, const std::vector<std::vector<std::uint32_t>>& meshes, Scene& scene) {
  convertCameras(model, scene);
  convertLights(model, scene);
  const std::size_t index = model.defaultScene < 0 ? 0 : static_cast<std::size_t>(model.defaultScene);
  if (model.scenes.empty()) {
    throw SceneError("the file has no scenes, only parts for other files; add one that lists the nodes to render");
  }
  if (index >= model.scenes.size()) {
    throw SceneError("the file has no scene " + std::to_string(index));
  }
  convertSky(model.scenes[index], scene);

  // Breadth first, so that parents come before their children.
  struct Pending {
    int source;
    std::optional<std::uint32_t> parent;
  };
  std::vector<Pending> pending;
  for (const int root : model.scenes[index].nodes) {
    pending.push_back({root, std::nullopt});
  }
  OptionalIndices converted(model.nodes.size());
  for (std::size_t next = 0; next < pending.size(); ++next) {
    const Pending current = pending[next];
    if (current.source < 0 || static_cast<std::size_t>(current.source) >= model.nodes.size()) {
      throw SceneError("the file has no node " + std::to_string(current.source));
    }
    const auto at = static_cast<std::size_t>(current.source);
    const tinygltf::Node& source = model.nodes[at];
    const std::string name = partName("node", at, source.name);
    if (converted[at]) {
      throw SceneError(name + ": appears in the hierarchy twice");
    }
    converted[at] = static_cast<std::uint32_t>(scene.nodes.size());
    Node node = convertNode(source, name, meshes, scene);
    node.parent = current.parent;
    scene.nodes.push_back(std::move(node));
    for (const int child : source.children) {
      pending.push_back({child, converted[at]});
    }
  }
  convertAnimation(model, converted, scene);
}

}  // namespace walr::render::gltf
