#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "framegraph/vulkan/resources.h"

namespace fg::vk {

/// Image views of the textures that passes use. Views of imports are cached under the host's identity of the image, so
/// that a host which alternates between a few images causes no new views after the first round.
class Views {
 public:
  Views(const DeviceContext& device, const GraphDesc& graph, const Resources& resources)
      : device_(&device), graph_(&graph), resources_(&resources) {}

  /// Request a view before the first frame. Returns its index, which is the same for the same texture and range.
  std::uint32_t request(std::uint32_t resource, const SubresourceRange& range);
  [[nodiscard]] VkImageView get(std::uint32_t view, FrameIndex frame) const {
    return requests_[view].handles[frame.parity];
  }
  /// Point all views of an import at another image.
  void import(std::uint32_t resource, VkImage image, std::uint64_t identity);
  /// Point all views of a texture at another image, in frames of one parity.
  void replace(std::uint32_t resource, std::uint32_t parity, VkImage image);
  /// Undo `replace`.
  void restore(std::uint32_t resource, std::uint32_t parity);
  /// Destroy the views of the host's image with this identity.
  void forget(std::uint64_t identity);

 private:
  struct Request {
    std::uint32_t resource = kNone;
    SubresourceRange range;
    VkImageView handles[kParities] = {};
    VkImageView replaced = VK_NULL_HANDLE;  ///< The view that `replace` has replaced.
  };

  const DeviceContext* device_;
  const GraphDesc* graph_;
  const Resources* resources_;
  std::vector<Request> requests_;
  std::vector<Owned<VkImageView>> owned_;
  std::map<std::pair<std::uint64_t, std::uint32_t>, Owned<VkImageView>> imported_;  ///< Keyed by identity and request.
};

}  // namespace fg::vk
