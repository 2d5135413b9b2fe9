#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <walr/walr_plugin.h>

#include "host/vulkan_host.h"

/// A host that builds a method out of single stages, which it connects by the names of their ports. Only images connect
/// stages. It keeps all images in one layout and records a full barrier between passes.
namespace stage_host {

class Chain {
 public:
  /// @param api what the plug-in registered
  Chain(Host& host, const WalrApi& api) : host_(&host), api_(&api) {}
  ~Chain();
  Chain(const Chain&) = delete;
  Chain& operator=(const Chain&) = delete;

  /// Append a stage. Its inputs are outputs of earlier stages or the host's images. The last stage writes the result.
  /// @param info     `method` is the stage's name
  /// @param settings of the stage
  /// @param renamed  inputs that are connected to outputs of other names
  void add(WalrDenoiserInfo info, const std::vector<WalrSettingValue>& settings,
           const std::map<std::string, std::string>& renamed = {});
  /// An image of the host by name; null if no stage uses it.
  HostImage* image(const std::string& name) {
    const auto found = images_.find(name);
    return found == images_.end() ? nullptr : found->second.data();
  }
  /// Run all stages.
  void frame(const WalrPassFrame& frame);

 private:
  struct Stage {
    WalrPasses passes = nullptr;
    const WalrPassList* list = nullptr;
    std::vector<std::string> images;              ///< By resource: name of its image; empty if it has none.
    std::vector<bool> swapped;                    ///< By resource: whether it is the previous frame's image.
    std::map<std::uint32_t, HostBuffer> buffers;  ///< By resource: buffers within the stage.
  };
  /// The image of an output, and whether it is the previous frame's.
  struct Output {
    std::string image;
    bool swapped = false;
    VkFormat format = VK_FORMAT_UNDEFINED;
  };

  void makeImages(const std::string& name, const WalrResource& resource, std::size_t count);
  HostImage& behind(const Stage& stage, std::uint32_t resource);
  void record(const Stage& stage, std::uint32_t pass, VkCommandBuffer commands);

  Host* host_;
  const WalrApi* api_;
  std::vector<Stage> stages_;
  std::map<std::string, std::vector<HostImage>> images_;  ///< Histories have two, which swap.
  std::map<std::string, Output> outputs_;                 ///< By port.
  std::uint32_t frames_ = 0;
};

}  // namespace stage_host
