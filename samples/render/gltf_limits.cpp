#include "samples/render/gltf_limits.h"

#include <algorithm>
#include <cstdint>
#include <string>

#include "samples/render/scene_error.h"

namespace walr::render::gltf {
namespace {

// Counts the elements of accessors. A count beyond the file's bytes is capped: it is invalid, and the accessor's reader
// reports that with a better message.
class Uses {
 public:
  explicit Uses(const tinygltf::Model& model) : model_(model) {
    for (const tinygltf::Buffer& buffer : model.buffers) {
      bytes_ += buffer.data.size();
    }
  }

  void add(int accessor) {
    if (accessor >= 0 && static_cast<std::size_t>(accessor) < model_.accessors.size()) {
      total_ += std::min<std::uint64_t>(model_.accessors[static_cast<std::size_t>(accessor)].count, bytes_);
    }
  }

  [[nodiscard]] std::uint64_t total() const { return total_; }

 private:
  const tinygltf::Model& model_;
  std::uint64_t bytes_ = 0;
  std::uint64_t total_ = 0;
};

}  // namespace

void checkUses(const tinygltf::Model& model) {
  Uses uses(model);
  for (const tinygltf::Mesh& mesh : model.meshes) {
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      const auto position = primitive.attributes.find("POSITION");
      uses.add(position == primitive.attributes.end() ? -1 : position->second);
      uses.add(primitive.indices);
    }
  }
  for (const tinygltf::Animation& animation : model.animations) {
    for (const tinygltf::AnimationChannel& channel : animation.channels) {
      if (channel.sampler >= 0 && static_cast<std::size_t>(channel.sampler) < animation.samplers.size()) {
        uses.add(animation.samplers[static_cast<std::size_t>(channel.sampler)].input);
      }
    }
  }
  constexpr std::uint64_t kMost = std::uint64_t{1} << 27U;
  if (uses.total() > kMost) {
    throw SceneError("its meshes and animations have " + std::to_string(uses.total()) +
                     " vertices, indices and keys, counted once for each use; the limit is " + std::to_string(kMost));
  }
}

void checkPlacedTriangles(const Scene& scene) {
  std::uint64_t total = 0;
  for (const Node& node : scene.nodes) {
    for (const std::uint32_t mesh : node.meshes) {
      total += scene.meshes[mesh].triangles.size();
    }
  }
  constexpr std::uint64_t kMost = std::uint64_t{1} << 26U;
  if (total > kMost) {
    throw SceneError("its nodes have " + std::to_string(total) + " triangles; the limit is " + std::to_string(kMost));
  }
}

}  // namespace walr::render::gltf
