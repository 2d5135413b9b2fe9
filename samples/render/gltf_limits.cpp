#include "samples/render/gltf_limits.h"

#include <algorithm>
#include <cstdint>
#include <string>

#include "samples/render/scene_error.h"
#include "samples/render/scene_limits.h"

namespace walr::render::gltf {
namespace {

// Counts the elements of accessors. A count beyond the file's bytes is capped: it is invalid, and the accessor's reader
// reports that with a better message. Zeros without a buffer view are counted apart.
class Uses {
 public:
  explicit Uses(const tinygltf::Model& model) : model_(model) {
    for (const tinygltf::Buffer& buffer : model.buffers) {
      bytes_ += buffer.data.size();
    }
  }

  void add(int accessor) {
    if (accessor < 0 || static_cast<std::size_t>(accessor) >= model_.accessors.size()) return;
    const tinygltf::Accessor& counted = model_.accessors[static_cast<std::size_t>(accessor)];
    if (counted.bufferView < 0) {
      zeros_ += std::min<std::uint64_t>(counted.count, kMostZeros.most + 1);
    } else {
      total_ += std::min<std::uint64_t>(counted.count, bytes_);
    }
  }

  // @throws SceneError if there are too many
  void check() const {
    if (total_ > kMostElements.most) {
      throw SceneError("its meshes and animations have " + std::to_string(total_) +
                       " vertices, indices and keys, counted once for each use; the limit is " +
                       std::to_string(kMostElements.most));
    }
    if (zeros_ > kMostZeros.most) {
      throw SceneError("its accessors without a buffer view have more than " + std::to_string(kMostZeros.most) +
                       " vertices, indices and keys, counted once for each use");
    }
  }

 private:
  const tinygltf::Model& model_;
  std::uint64_t bytes_ = 0;
  std::uint64_t total_ = 0;
  std::uint64_t zeros_ = 0;
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
  uses.check();
}

void checkPlacedTriangles(const Scene& scene) {
  std::uint64_t total = 0;
  for (const Node& node : scene.nodes) {
    for (const std::uint32_t mesh : node.meshes) {
      total += scene.meshes[mesh].triangles.size();
    }
  }
  if (total > kMostTriangles.most) {
    throw SceneError("its nodes have " + std::to_string(total) + " triangles; the limit is " +
                     std::to_string(kMostTriangles.most));
  }
}

}  // namespace walr::render::gltf
