#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <walr/walr_passes.h>
#include <walr/walr_plugin.h>

#include "host/vulkan_host.h"

/// A host that uses the dispatch list only as data. It creates pipelines and heaps and records barriers and dispatches
/// itself, in the order of the list. It calls walr only for the constants of each frame. The states of images at the
/// border of a frame come from WalrResource::entry and exit alone.
namespace list_host {

class Player {
 public:
  Player(Host& host, const WalrApi& api, WalrPasses passes);
  ~Player();
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  HostImage& image(const std::string& name) { return hostImages_.at(name); }
  void frame(const WalrPassFrame& frame) { frames({&frame, 1}); }
  /// Record at most two frames into one command buffer, so that validation sees how they are ordered.
  void frames(std::span<const WalrPassFrame> frames);
  /// The next frame has no history.
  void resetHistory();
  /// The next frame continues from the last frame of a player of passes of another size; see walr_continue_passes.
  void goOnFrom(Player& last);
  /// Change the host's copy of a state of all resources of a kind.
  void falsify(WalrResourceKind kind, WalrImageState WalrResource::*border, void (*change)(WalrImageState&));

 private:
  /// What is behind a resource, by frame parity: the two images of a history swap, and uploads have two buffers.
  struct Behind {
    HostImage* images[2] = {};
    VkImageView views[2] = {};
    VkBuffer buffers[2] = {};
    void* mapped[2] = {};
    std::uint32_t age = 0;           ///< Of a previous history: number of frames, 0 if it holds none.
    HostImage* inherited = nullptr;  ///< The image of other passes that is its previous history in the next frame.
  };
  struct Pass {
    VkDescriptorSetLayout setLayout = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkPipeline pipeline = VK_NULL_HANDLE;
    VkDescriptorSet sets[2] = {};
  };

  void makeHeaps();
  void makeResource(std::uint32_t index);
  HostImage* makeImage(const WalrResource& resource);
  VkImageView makeView(VkImage image, VkFormat format);
  VkBuffer makeBuffer(const WalrResource& resource, void** mapped);
  VkDeviceMemory allocate(VkDeviceSize size, std::uint32_t typeBits, VkMemoryPropertyFlags properties);
  void makePass(std::uint32_t index);
  void writeSets(std::uint32_t index);
  HostImage* behind(std::uint32_t index);
  void beginFrame(const WalrPassFrame& frame);
  void enter(VkCommandBuffer commands);
  void record(VkCommandBuffer commands, std::uint32_t index);
  void leave();
  void barriers(VkCommandBuffer commands, const WalrBarrier* first, std::uint32_t count);

  Host* host_;
  const WalrApi* api_;
  WalrPasses passes_;
  const WalrPassList* list_ = nullptr;
  std::vector<WalrResource> resources_;  ///< A copy of the list's.
  std::vector<VkDeviceMemory> heaps_;
  std::vector<VkDeviceMemory> memory_;
  std::deque<HostImage> images_;  ///< Of the passes alone.
  std::vector<VkImageView> views_;
  std::vector<VkBuffer> buffers_;
  std::vector<Behind> behind_;
  std::vector<Pass> pipelines_;
  std::map<std::string, HostImage> hostImages_;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkSampler sampler_ = VK_NULL_HANDLE;
  std::uint32_t parity_ = 0;
};

}  // namespace list_host
