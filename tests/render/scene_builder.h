#pragma once

#include <initializer_list>
#include <string>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "samples/render/scene.h"

namespace walr::render::test {

/// Builds small scenes in memory.
class SceneBuilder {
 public:
  SceneBuilder& sky(const glm::vec3& radiance) {
    scene_.skyRadiance = radiance;
    return *this;
  }

  std::uint32_t material(const glm::vec3& albedo, const glm::vec3& emission = glm::vec3(0.0F)) {
    Material material;
    material.baseColor = albedo;
    material.emission = emission;
    scene_.materials.push_back(material);
    return static_cast<std::uint32_t>(scene_.materials.size() - 1);
  }

  /// Add a parallelogram whose front faces `cross(u, v)`. @returns its node
  std::uint32_t quad(std::uint32_t material, const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v) {
    return addMesh(material, {corner, corner + u, corner + u + v, corner + v}, {{0, 1, 2}, {0, 2, 3}});
  }

  /// Add a closed axis-aligned box whose faces face inward. @returns its node
  std::uint32_t room(std::uint32_t material, const glm::vec3& low, const glm::vec3& high) {
    std::vector<glm::vec3> corners;
    for (int i = 0; i < 8; ++i) {
      corners.emplace_back((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z);
    }
    return addMesh(material, corners,
                   {{0, 1, 3},
                    {0, 3, 2},
                    {4, 6, 7},
                    {4, 7, 5},
                    {0, 4, 5},
                    {0, 5, 1},
                    {2, 3, 7},
                    {2, 7, 6},
                    {0, 2, 6},
                    {0, 6, 4},
                    {1, 5, 7},
                    {1, 7, 3}});
  }

  std::uint32_t light(const PunctualLight& light, const Transform& transform) {
    scene_.lights.push_back(light);
    const std::uint32_t node = addNode(transform);
    scene_.nodes[node].light = static_cast<std::uint32_t>(scene_.lights.size() - 1);
    return node;
  }

  /// Add a camera at `position` that looks at `target`, +Y up. @returns its node
  std::uint32_t camera(const glm::vec3& position, const glm::vec3& target) {
    scene_.cameras.emplace_back();
    Transform transform;
    transform.translation = position;
    transform.rotation = glm::quatLookAtRH(glm::normalize(target - position), glm::vec3(0.0F, 1.0F, 0.0F));
    const std::uint32_t node = addNode(transform);
    scene_.nodes[node].camera = static_cast<std::uint32_t>(scene_.cameras.size() - 1);
    return node;
  }

  /// Animate a node linearly from one translation to another over one second.
  SceneBuilder& move(std::uint32_t node, const glm::vec3& from, const glm::vec3& to) {
    AnimationChannel channel;
    channel.node = node;
    channel.times = {0.0F, 1.0F};
    channel.values = {glm::vec4(from, 0.0F), glm::vec4(to, 0.0F)};
    scene_.animation.push_back(channel);
    return *this;
  }

  /// Animate a node linearly from one rotation to another over one second.
  SceneBuilder& turn(std::uint32_t node, const glm::quat& from, const glm::quat& to) {
    AnimationChannel channel;
    channel.node = node;
    channel.path = AnimationChannel::Path::Rotation;
    channel.times = {0.0F, 1.0F};
    for (const glm::quat& q : {from, to}) {
      channel.values.emplace_back(q.x, q.y, q.z, q.w);
    }
    scene_.animation.push_back(channel);
    return *this;
  }

  [[nodiscard]] Scene& scene() { return scene_; }

 private:
  std::uint32_t addNode(const Transform& transform) {
    Node node;
    node.name = "node " + std::to_string(scene_.nodes.size());
    node.transform = transform;
    scene_.nodes.push_back(node);
    return static_cast<std::uint32_t>(scene_.nodes.size() - 1);
  }

  std::uint32_t addMesh(std::uint32_t material, const std::vector<glm::vec3>& positions,
                        const std::vector<glm::uvec3>& triangles) {
    Mesh mesh;
    mesh.name = "mesh " + std::to_string(scene_.meshes.size());
    mesh.positions = positions;
    mesh.triangles = triangles;
    mesh.material = material;
    scene_.meshes.push_back(mesh);
    const std::uint32_t node = addNode({});
    scene_.nodes[node].meshes.push_back(static_cast<std::uint32_t>(scene_.meshes.size() - 1));
    return node;
  }

  Scene scene_;
};

}  // namespace walr::render::test
