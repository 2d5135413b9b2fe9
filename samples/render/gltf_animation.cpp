#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include <glm/geometric.hpp>

#include "samples/render/gltf_accessor.h"
#include "samples/render/gltf_convert.h"
#include "samples/render/gltf_json.h"
#include "samples/render/scene_error.h"

namespace walr::render::gltf {
namespace {

const std::map<std::string, AnimationChannel::Path> kPaths = {
    {"translation", AnimationChannel::Path::Translation},
    {"rotation", AnimationChannel::Path::Rotation},
    {"scale", AnimationChannel::Path::Scale},
};

std::vector<glm::vec4> readKeys(const tinygltf::Model& model, int accessor, AnimationChannel::Path path,
                                const std::string& name) {
  if (path == AnimationChannel::Path::Rotation) {
    std::vector<glm::vec4> keys = readVec4s(model, accessor, name + " output");
    for (glm::vec4& key : keys) {
      if (!(glm::length(key) > 0.0F)) {
        throw SceneError(name + ": a rotation is not a unit quaternion");
      }
      key = glm::normalize(key);
    }
    return keys;
  }
  std::vector<glm::vec4> keys;
  for (const glm::vec3& key : readVec3s(model, accessor, name + " output")) {
    keys.emplace_back(key, 0.0F);
  }
  return keys;
}

AnimationChannel readChannel(const tinygltf::Model& model, const tinygltf::AnimationSampler& sampler,
                             AnimationChannel::Path path, const std::string& name) {
  AnimationChannel channel;
  channel.path = path;
  channel.interpolation =
      sampler.interpolation == "STEP" ? AnimationChannel::Interpolation::Step : AnimationChannel::Interpolation::Linear;
  channel.times = readScalars(model, sampler.input, name + " input");
  for (std::size_t i = 1; i < channel.times.size(); ++i) {
    if (channel.times[i] < channel.times[i - 1]) {  // Two keys at one time are a jump.
      throw SceneError(name + " input: times must not fall");
    }
  }
  if (const std::size_t values = elementCount(model, sampler.output, name + " output");
      values != channel.times.size()) {
    throw SceneError(name + ": has " + std::to_string(values) + " values for " + std::to_string(channel.times.size()) +
                     " times");
  }
  channel.values = readKeys(model, sampler.output, path, name);
  return channel;
}

// The channels of one animation that can be rendered.
std::vector<AnimationChannel> readChannels(const tinygltf::Model& model, std::size_t index,
                                           const std::vector<std::optional<std::uint32_t>>& nodes, Scene& scene) {
  const tinygltf::Animation& animation = model.animations[index];
  std::vector<AnimationChannel> channels;
  for (std::size_t c = 0; c < animation.channels.size(); ++c) {
    const tinygltf::AnimationChannel& source = animation.channels[c];
    const std::string name = partName("animation", index, animation.name) + " channel " + std::to_string(c);
    const auto path = kPaths.find(source.target_path);
    if (path == kPaths.end()) {
      scene.warnings.push_back(name + ": animation of '" + source.target_path + "' is ignored");
      continue;
    }
    if (source.target_node == kNoNode) {
      scene.warnings.push_back(name + ": animation of '" + source.target_path + "' of no node is ignored");
      continue;
    }
    if (source.target_node < 0 || static_cast<std::size_t>(source.target_node) >= nodes.size()) {
      throw SceneError(name + ": there is no node " + std::to_string(source.target_node));
    }
    if (source.sampler < 0 || static_cast<std::size_t>(source.sampler) >= animation.samplers.size()) {
      throw SceneError(name + ": there is no sampler " + std::to_string(source.sampler));
    }
    const tinygltf::AnimationSampler& sampler = animation.samplers[static_cast<std::size_t>(source.sampler)];
    if (sampler.interpolation != "LINEAR" && sampler.interpolation != "STEP") {
      scene.warnings.push_back(name + ": interpolation " + sampler.interpolation + " is not supported; ignored");
      continue;
    }
    const std::optional<std::uint32_t> node = nodes[static_cast<std::size_t>(source.target_node)];
    if (!node) {
      continue;
    }
    if (scene.nodes[*node].matrix) {
      scene.warnings.push_back(name + ": node " + std::to_string(source.target_node) +
                               " has a matrix, which hides its animation; ignored");
      continue;
    }
    channels.push_back(readChannel(model, sampler, path->second, name));
    channels.back().node = *node;
  }
  return channels;
}

}  // namespace

void convertAnimation(const tinygltf::Model& model, const std::vector<std::optional<std::uint32_t>>& nodes,
                      Scene& scene) {
  // Animations of different things belong together, as of a camera and of an object. One of the same things is another
  // clip, such as "run" beside "walk", which can only be shown instead of the first.
  std::set<std::pair<std::uint32_t, AnimationChannel::Path>> animated;
  constexpr std::size_t kMostNamed = 5;
  std::string named;
  std::size_t otherClips = 0;
  for (std::size_t a = 0; a < model.animations.size(); ++a) {
    std::vector<AnimationChannel> channels = readChannels(model, a, nodes, scene);
    const auto target = [](const AnimationChannel& channel) { return std::pair(channel.node, channel.path); };
    if (std::ranges::any_of(channels, [&](const auto& channel) { return animated.contains(target(channel)); })) {
      if (++otherClips > kMostNamed) continue;
      named += (named.empty() ? "" : ", ") + partName("animation", a, model.animations[a].name);
      continue;
    }
    for (AnimationChannel& channel : channels) {
      animated.insert(target(channel));
      scene.animation.push_back(std::move(channel));
    }
  }
  if (otherClips > 0) {
    if (otherClips > kMostNamed) named += " and " + std::to_string(otherClips - kMostNamed) + " more";
    scene.warnings.push_back(named + ": left out, because an earlier animation moves the same nodes");
  }
}

}  // namespace walr::render::gltf
