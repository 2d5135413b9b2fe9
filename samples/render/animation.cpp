#include "samples/render/animation.h"

#include <algorithm>

#include <glm/gtc/matrix_transform.hpp>

namespace walr::render {
namespace {

glm::quat asQuaternion(const glm::vec4& value) {
  return {value.w, value.x, value.y, value.z};
}

void applyChannel(const AnimationChannel& channel, double seconds, Transform& transform) {
  const auto time = static_cast<float>(seconds);
  const auto after = std::upper_bound(channel.times.begin(), channel.times.end(), time);
  const auto next = static_cast<std::size_t>(after - channel.times.begin());
  const std::size_t last = channel.times.size() - 1;
  const std::size_t a = next == 0 ? 0 : next - 1;
  const std::size_t b = std::min(next, last);
  const bool hold = a == b || next == 0 || channel.interpolation == AnimationChannel::Interpolation::Step ||
                    channel.values[a] == channel.values[b];
  const float fraction = hold ? 0.0F : (time - channel.times[a]) / (channel.times[b] - channel.times[a]);
  glm::vec4 value = channel.values[a];
  // At a key, and between equal keys, return the key's exact value: interpolation would make still objects move by its
  // rounding error.
  if (fraction > 0.0F && channel.path == AnimationChannel::Path::Rotation) {
    const glm::quat blend = glm::slerp(asQuaternion(value), asQuaternion(channel.values[b]), fraction);
    value = glm::vec4(blend.x, blend.y, blend.z, blend.w);
  } else if (fraction > 0.0F) {
    value = glm::mix(value, channel.values[b], fraction);
  }
  switch (channel.path) {
    case AnimationChannel::Path::Translation:
      transform.translation = glm::vec3(value);
      break;
    case AnimationChannel::Path::Rotation:
      transform.rotation = glm::normalize(asQuaternion(value));
      break;
    case AnimationChannel::Path::Scale:
      transform.scale = glm::vec3(value);
      break;
  }
}

glm::mat4 localMatrix(const Transform& transform) {
  return glm::translate(glm::mat4(1.0F), transform.translation) * glm::mat4_cast(transform.rotation) *
         glm::scale(glm::mat4(1.0F), transform.scale);
}

}  // namespace

std::vector<glm::mat4> worldTransforms(const Scene& scene, double seconds) {
  std::vector<Transform> transforms;
  transforms.reserve(scene.nodes.size());
  for (const Node& node : scene.nodes) {
    transforms.push_back(node.transform);
  }
  for (const AnimationChannel& channel : scene.animation) {
    applyChannel(channel, seconds, transforms[channel.node]);
  }
  std::vector<glm::mat4> world;
  world.reserve(scene.nodes.size());
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    const glm::mat4 local = node.matrix ? *node.matrix : localMatrix(transforms[i]);
    world.push_back(node.parent ? world[*node.parent] * local : local);
  }
  return world;
}

std::vector<bool> animatedNodes(const Scene& scene) {
  std::vector<bool> animated(scene.nodes.size(), false);
  for (const AnimationChannel& channel : scene.animation) {
    animated[channel.node] = true;
  }
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const std::optional<std::uint32_t> parent = scene.nodes[i].parent;
    animated[i] = animated[i] || (parent && animated[*parent]);
  }
  return animated;
}

}  // namespace walr::render
