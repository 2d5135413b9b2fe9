#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <walr/walr_passes.h>
#include <walr/walr_plugin.h>

#include "host/vulkan_host.h"

/// A small frame graph that works like Granite's. The graph owns all resources and identifies them by name; nothing is
/// imported. Storage images stay in GENERAL and never alias. A history is null in the first frame. Passes are recorded
/// in another order than they run in, as if by several threads, each into its own command buffer. It uses only the
/// plug-in's headers.
namespace tiny_host {

class Graph {
 public:
  /// Add each of a plug-in's passes.
  /// @param api what the plug-in registered
  Graph(Host& host, const WalrApi& api, WalrPasses passes);
  ~Graph();
  Graph(const Graph&) = delete;
  Graph& operator=(const Graph&) = delete;

  /// The graph's image with a name.
  HostImage& image(const std::string& name) { return images_.at(name).slots[0]; }
  /// Drop the history: previous histories are null in the next frame.
  void resetHistory() { hasHistory_ = false; }
  /// Leave out barriers before reads that need no layout transition. This is an error that validation must report.
  void leaveOutReadBarriers() { readBarriers_ = false; }
  /// Continue from the histories of another graph, of the same method at another size.
  void goOnFrom(Graph& before) {
    before_ = &before;
    hasHistory_ = false;
  }
  /// Run all passes.
  void frame(const WalrPassFrame& frame);
  /// Bytes that the driver requires for all images and buffers of the graph.
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
  /// The same according to the plug-in's list.
  [[nodiscard]] std::uint64_t listedBytes() const { return listedBytes_; }

 private:
  /// A named image; histories have two, which swap.
  struct Named {
    std::vector<HostImage> slots;
  };
  struct NamedBuffer {
    HostBuffer own{};
    VkPipelineStageFlags2 stage = VK_PIPELINE_STAGE_2_NONE;
    VkAccessFlags2 access = VK_ACCESS_2_NONE;
  };

  void makeResource(const WalrResource& resource);
  /// The image of a resource in this frame; null for a history that does not exist.
  HostImage* behind(std::uint32_t resource);
  /// The history image that the last frame wrote; null if there was none.
  [[nodiscard]] HostImage* lastOf(const std::string& history);
  void transition(VkCommandBuffer commands, const WalrBinding& binding);
  std::vector<VkCommandBuffer> beginPasses();
  void recordPass(std::uint32_t pass, VkCommandBuffer commands);

  Host* host_;
  const WalrApi* api_;
  WalrPasses passes_;
  const WalrPassList* list_ = nullptr;
  std::map<std::string, Named> images_;
  std::map<std::string, NamedBuffer> buffers_;
  std::uint64_t bytes_ = 0;
  std::uint64_t listedBytes_ = 0;
  Graph* before_ = nullptr;  ///< Until the first frame has run.
  std::uint32_t parity_ = 0;
  bool hasHistory_ = false;
  bool readBarriers_ = true;
};

}  // namespace tiny_host
