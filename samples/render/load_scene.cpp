#include "samples/render/load_scene.h"

#include <algorithm>
#include <optional>
#include <sstream>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "samples/image/exr_names.h"
#include "samples/render/animation.h"
#include "samples/render/default_view.h"
#include "samples/render/gltf_compression.h"
#include "samples/render/gltf_convert.h"
#include "samples/render/gltf_file.h"
#include "samples/render/gltf_json.h"
#include "samples/render/gltf_limits.h"
#include "samples/render/load_sky.h"
#include "samples/render/scene_error.h"
#include "samples/render/surface.h"
#include "samples/render/view.h"

namespace walr::render {
namespace {

void warnOfIgnoredExtensions(const tinygltf::Model& model, Scene& scene) {
  for (const std::string& extension : model.extensionsUsed) {
    if (!gltf::isSupported(extension)) {
      scene.warnings.push_back("the extension " + extension + " is ignored");
    }
  }
}

// Under a constant sky, a white object could not be told from the sky.
const SkyMap kDefaultSky = {.width = 1, .height = 2, .radiance = {glm::vec3(1.0F), glm::vec3(0.25F)}};

// Most files that people have hold neither camera nor light.
void completeScene(Scene& scene) {
  bool triangles = false;
  bool emission = false;
  bool light = scene.skyMap || scene.skyRadiance != glm::vec3(0.0F);
  for (const Node& node : scene.nodes) {
    light = light || node.light.has_value();
    for (const std::uint32_t mesh : node.meshes) {
      triangles = true;
      emission = emission || scene.materials[scene.meshes[mesh].material].emits();
    }
  }
  if (!triangles) {
    throw SceneError("its default scene has no triangles; points and lines are not supported");
  }
  const bool camera = !cameraNodes(scene).empty();
  if (!light && !(emission && camera)) {  // Without a camera, what glows is rather a part of an object than a lamp.
    scene.skyMap = kDefaultSky;
    scene.warnings.push_back(std::string("the scene has no light") + (emission ? " but what glows" : "") +
                             ": it is lit by a white sky that is darker below");
  }
  if (!camera) {
    addFramingCamera(scene);
    scene.warnings.emplace_back("the scene has no camera: one in front of it frames all of it");
  }
}

// Rays start beside surfaces, farther off the larger coordinates are. A pixel of a picture of all of the scene is about
// a thousandth of it.
void warnOfDistance(Scene& scene) {
  constexpr float kVisible = 1e-3F;
  const Box box = boundingBox(scene, worldTransforms(scene, 0.0));
  const glm::vec3 farthest = glm::max(glm::abs(box.low), glm::abs(box.high));
  const float offset = kRelativeRayOffset * std::max({farthest.x, farthest.y, farthest.z});
  if (offset > kVisible * glm::distance(box.low, box.high)) {
    std::ostringstream text;
    text << "the scene is far from the origin for its size: shadows and reflections may be " << offset
         << " units off; move it there";
    scene.warnings.push_back(text.str());
  }
}

}  // namespace

Scene loadScene(const std::filesystem::path& file, const std::filesystem::path& sky, Fingerprint* contents) {
  std::optional<SkyMap> skyMap;
  if (!sky.empty()) {
    skyMap = loadSky(sky);
    if (contents != nullptr) contents->addFile(sky);
  }
  try {
    tinygltf::Model model = gltf::readModel(file, contents);
    Scene scene;
    scene.skyMap = std::move(skyMap);
    warnOfIgnoredExtensions(model, scene);
#ifdef WALR_MESHOPT
    gltf::decodeMeshopt(model);
#endif
#ifdef WALR_DRACO
    gltf::decodeDraco(model);
#endif
    gltf::checkUses(model);
    gltf::convertMaterials(model, gltf::convertTextures(model, scene), scene);
    gltf::convertNodes(model, gltf::convertMeshes(model, scene), scene);
    gltf::checkPlacedTriangles(scene);
    completeScene(scene);
    warnOfDistance(scene);
    // They quote texts of the file, which must not command the terminal.
    for (std::string& warning : scene.warnings) warning = printable(warning);
    return scene;
  } catch (const SceneError& error) {
    throw SceneError(file.string() + ": " + printable(error.what()));
  }
}

}  // namespace walr::render
