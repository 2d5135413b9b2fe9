#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <walr/walr_passes.h>
#include <walr/walr_plugin.h>

#include "host/vulkan_host.h"

/// A host that uses the dispatch list only as data. It creates pipelines and heaps and records barriers and dispatches
/// itself, in the order of the list. It calls walr only for the constants of each frame.
namespace list_host {

class Player {
 public:
  Player(Host& host, const WalrApi& api, WalrPasses passes);
  ~Player();
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  HostImage& image(const std::string& name) { return hostImages_.at(name); }
  void frame(const WalrPassFrame& frame);

 private:
  /// The images of a resource by frame parity: the two images of a history swap.
  struct Behind {
    VkImage images[2] = {};
    VkImageView views[2] = {};
    VkBuffer buffer = VK_NULL_HANDLE;
  };
  struct Pass {
    VkDescriptorSetLayout setLayout = VK_NULL_HANDLE;
    VkPipelineLayout layout = VK_NULL_HANDLE;
    VkPipeline pipeline = VK_NULL_HANDLE;
    VkDescriptorSet sets[2] = {};
  };

  void makeHeaps();
  void makeResource(std::uint32_t index);
  VkImage makeImage(const WalrResource& resource);
  VkImageView makeView(VkImage image, VkFormat format);
  VkBuffer makeBuffer(std::uint32_t index);
  VkDeviceMemory allocate(VkDeviceSize size, std::uint32_t typeBits, VkMemoryPropertyFlags properties);
  void makePass(std::uint32_t index);
  void makeSets(std::uint32_t index);
  void clearHistories();
  void barriers(VkCommandBuffer commands, const WalrBarrier* first, std::uint32_t count);

  Host* host_;
  const WalrApi* api_;
  WalrPasses passes_;
  const WalrPassList* list_ = nullptr;
  std::vector<VkDeviceMemory> heaps_;
  std::vector<VkDeviceMemory> memory_;
  std::vector<VkImage> images_;
  std::vector<VkImageView> views_;
  std::vector<VkBuffer> buffers_;
  std::vector<Behind> behind_;
  std::vector<Pass> pipelines_;
  std::map<std::string, HostImage> hostImages_;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkSampler sampler_ = VK_NULL_HANDLE;
  std::map<std::uint32_t, void*> constants_;  ///< Mapped, by resource.
  std::uint32_t parity_ = 0;
};

}  // namespace list_host
