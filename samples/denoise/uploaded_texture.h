#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "framegraph/declare/graph.h"
#include "framegraph/vulkan/executor.h"
#include "framegraph/vulkan/staged_image.h"

namespace walr {

/// An input texture of a graph, with its image and the staging buffers of its uploads.
class UploadedTexture {
 public:
  UploadedTexture(const fg::vk::DeviceContext& device, const fg::Graph& graph, fg::vk::Executor& executor,
                  fg::Texture texture, std::uint32_t slots)
      : image_(device, graph.textureDesc(texture), executor.usage(texture), fg::vk::StagedImage::Direction::Upload,
               slots, graph.desc().resources[texture.resource].name) {
    executor.bind(texture, image_.external());
  }

  /// Record the upload of a frame's texels, which have the texture's format.
  template <typename Texels>
  void upload(const fg::vk::Frame& frame, const Texels& texels) const {
    const auto bytes = std::as_bytes(std::span(texels));
    std::ranges::copy(bytes, image_.staging(frame.slot).begin());
    image_.recordUpload(frame.commandBuffer, frame.slot);
  }

 private:
  fg::vk::StagedImage image_;
};

}  // namespace walr
