#include "samples/render/lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "samples/render/exact/path.h"
#include "samples/render/scene_error.h"
#include "samples/render/surface.h"

namespace walr::render {
namespace {

std::array<glm::vec3, 3> worldCorners(const Scene& scene, const Instance& instance, std::uint32_t triangle) {
  const Mesh& mesh = scene.meshes[instance.mesh];
  std::array<glm::vec3, 3> corners{};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::uint32_t vertex = mesh.triangles[triangle][static_cast<glm::length_t>(i)];
    corners[i] = exact::transformPoint(instance.worldFromObject, mesh.positions[vertex]);
  }
  return corners;
}

// A vector along the front normal whose length is twice the triangle's area.
glm::vec3 areaVector(const Instance& instance, const std::array<glm::vec3, 3>& corners) {
  return glm::cross(corners[1] - corners[0], corners[2] - corners[0]) * (instance.mirrored ? -1.0F : 1.0F);
}

float brightness(const glm::vec3& color) {
  return (color.x + color.y + color.z) / 3.0F;
}

}  // namespace

Lights::Lights(const Scene& scene, const std::vector<Instance>& instances, const std::vector<glm::mat4>& worldFromNode)
    : firstEmitter_(instances.size()) {
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
    if (scene.nodes[n].light) {
      const glm::vec3 axis(-worldFromNode[n][2]);
      const float length = glm::length(axis);
      punctual_.push_back({scene.lights[*scene.nodes[n].light], glm::vec3(worldFromNode[n][3]),
                           length > 0.0F ? axis / length : glm::vec3(0.0F, 0.0F, -1.0F)});
    }
  }

  // Every triangle of an emissive mesh gets an entry, even one without area, so that entries can be indexed by
  // triangle.
  constexpr std::size_t kMostEmitters = std::size_t{1} << 24U;
  double total = 0.0;
  for (std::uint32_t i = 0; i < instances.size(); ++i) {
    const Mesh& mesh = scene.meshes[instances[i].mesh];
    const Material& material = scene.materials[mesh.material];
    if (!material.emits()) {
      continue;
    }
    if (emitters_.size() + mesh.triangles.size() > kMostEmitters) {
      throw SceneError("the scene has more than 2^24 emissive triangles; make fewer materials emissive");
    }
    firstEmitter_[i] = static_cast<std::uint32_t>(emitters_.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const std::array<glm::vec3, 3> corners = worldCorners(scene, instances[i], t);
      const float area = 0.5F * glm::length(areaVector(instances[i], corners));
      total += static_cast<double>(area) * brightness(material.emission) * (material.doubleSided ? 2.0 : 1.0);
      emitters_.push_back({i, t, corners, area, total, 0.0F});
    }
  }
  if (!(total > 0.0)) {
    emitters_.clear();
    std::fill(firstEmitter_.begin(), firstEmitter_.end(), std::nullopt);
    return;
  }
  double before = 0.0;
  for (Emitter& emitter : emitters_) {
    emitter.cumulative /= total;
    emitter.probability = static_cast<float>(emitter.cumulative - before);
    before = emitter.cumulative;
  }
}

EmitterSample Lights::sampleEmitters(const Scene& scene, const std::vector<Instance>& instances, float choice,
                                     const glm::vec2& point) const {
  const auto chosen = std::upper_bound(emitters_.begin(), emitters_.end(), static_cast<double>(choice),
                                       [](double value, const Emitter& emitter) { return value < emitter.cumulative; });
  const Emitter& emitter = chosen == emitters_.end() ? emitters_.back() : *chosen;
  const Instance& instance = instances[emitter.instance];
  const Mesh& mesh = scene.meshes[instance.mesh];
  const Material& material = scene.materials[mesh.material];

  // Uniform sampling of a triangle (Pharr et al. 2016, 13.6.5).
  const float root = std::sqrt(point.x);
  const glm::vec2 barycentric(root * (1.0F - point.y), root * point.y);
  const std::array<glm::vec3, 3>& corners = emitter.corners;
  const glm::vec3 twiceArea = areaVector(instance, corners);
  const float length = glm::length(twiceArea);

  EmitterSample sample;
  sample.position = exact::interpolate(corners[0], corners[1], corners[2], barycentric);
  sample.normal = length > 0.0F ? twiceArea / length : glm::vec3(0.0F);
  sample.doubleSided = material.doubleSided;
  if (!isHole(scene, mesh, emitter.triangle, barycentric)) {
    sample.radiance = emittedRadiance(scene, mesh, emitter.triangle, barycentric);
  }
  sample.density = emitter.area > 0.0F ? emitter.probability / emitter.area : 0.0F;
  return sample;
}

float Lights::emitterDensity(std::uint32_t instance, std::uint32_t triangle) const {
  if (!firstEmitter_[instance]) {
    return 0.0F;
  }
  const Emitter& emitter = emitters_[*firstEmitter_[instance] + triangle];
  return emitter.area > 0.0F ? emitter.probability / emitter.area : 0.0F;
}

Illumination illuminate(const PlacedLight& placed, const glm::vec3& point) {
  const PunctualLight& light = placed.light;
  if (light.kind == PunctualLight::Kind::Directional) {
    return {-placed.axis, std::numeric_limits<float>::infinity(), light.intensity};
  }
  const glm::vec3 offset = placed.position - point;
  const float distance = glm::length(offset);
  if (!(distance > 0.0F)) {
    return {placed.axis, 0.0F, glm::vec3(0.0F)};
  }
  Illumination result{offset / distance, distance, light.intensity / (distance * distance)};
  if (light.kind == PunctualLight::Kind::Spot) {
    // KHR_lights_punctual, "Inner and Outer Cone Angles".
    const float cosine = glm::dot(-result.towardsLight, placed.axis);
    const float fade = glm::clamp(
        (cosine - light.cosOuterCone) / glm::max(0.001F, light.cosInnerCone - light.cosOuterCone), 0.0F, 1.0F);
    result.irradiance *= fade * fade;
  }
  return result;
}

}  // namespace walr::render
