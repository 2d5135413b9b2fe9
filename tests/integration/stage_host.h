#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <walr/walr_plugin.h>

#include "host/vulkan_host.h"

/// A host that builds a method out of single stages, which it connects by the names of their ports. It keeps every
/// image in one layout and waits for everything between two passes.
namespace stage_host {

class Chain {
 public:
  /// @param api what the plug-in registered
  Chain(Host& host, const WalrApi& api) : host_(&host), api_(&api) {}
  ~Chain();
  Chain(const Chain&) = delete;
  Chain& operator=(const Chain&) = delete;

  /// Append a stage. Its inputs are outputs of those before it, or the host's images. The result is the last one's.
  /// @param info     with the stage's name for its method
  /// @param settings of the stage
  /// @param renamed  inputs that take outputs of other names
  void add(WalrDenoiserInfo info, const std::vector<WalrSettingValue>& settings,
           const std::map<std::string, std::string>& renamed = {});
  /// An image of the host's, by name; null where no stage takes it.
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
    std::vector<std::string> images;  ///< By resource: name of what is behind it; empty where nothing is.
    std::vector<bool> swapped;        ///< By resource: it is the image of the frame before.
  };
  /// The image behind an output, and whether it is that of the frame before.
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
  std::map<std::string, std::vector<HostImage>> images_;  ///< Histories have two, which take turns.
  std::map<std::string, Output> outputs_;                 ///< By port.
  std::uint32_t frames_ = 0;
};

}  // namespace stage_host
