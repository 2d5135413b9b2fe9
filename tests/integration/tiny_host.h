#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <walr/walr_passes.h>
#include <walr/walr_plugin.h>

#include "host/vulkan_host.h"

/// A frame graph in the manner of Granite's: resources go by name and all belong to the graph, nothing is imported;
/// images with storage use stay in GENERAL, also where they are sampled, and never share memory; a history is null
/// until a frame lies behind it; passes are recorded in another order than they run in, as by threads, each into a
/// command buffer of its own. It knows walr by the plug-in's headers alone.
namespace tiny_host {

class Graph {
 public:
  /// Take a plug-in's passes over, one by one.
  /// @param api what the plug-in registered
  Graph(Host& host, const WalrApi& api, WalrPasses passes);
  ~Graph();
  Graph(const Graph&) = delete;
  Graph& operator=(const Graph&) = delete;

  /// The graph's image of a name.
  HostImage& image(const std::string& name) { return images_.at(name).slots[0]; }
  /// Forget what lies behind: histories are null in the next frame.
  void resetHistory() { hasHistory_ = false; }
  /// Leave out every barrier before a read that needs no other layout: what a host must not do, and validation must
  /// see.
  void leaveOutReadBarriers() { readBarriers_ = false; }
  /// Go on from what another graph of the same method at another size left.
  void goOnFrom(Graph& before) {
    before_ = &before;
    hasHistory_ = false;
  }
  /// Run all passes.
  void frame(const WalrPassFrame& frame);
  /// Bytes that the driver asks for all images and buffers of the graph.
  [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
  /// The same as the plug-in's list has it.
  [[nodiscard]] std::uint64_t listedBytes() const { return listedBytes_; }

 private:
  /// A named image; histories have two that take turns.
  struct Named {
    std::vector<HostImage> slots;
  };
  struct NamedBuffer {
    HostBuffer own{};
    VkPipelineStageFlags2 stage = VK_PIPELINE_STAGE_2_NONE;
    VkAccessFlags2 access = VK_ACCESS_2_NONE;
  };

  void makeResource(const WalrResource& resource);
  /// The image behind a resource in this frame; null for a history that there is none of.
  HostImage* behind(std::uint32_t resource);
  /// What the last frame wrote into a history; null where there was none.
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
  Graph* before_ = nullptr;  ///< Until a frame lies behind.
  std::uint32_t parity_ = 0;
  bool hasHistory_ = false;
  bool readBarriers_ = true;
};

}  // namespace tiny_host
