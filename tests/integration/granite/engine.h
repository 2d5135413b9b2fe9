#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <walr/walr_plugin.h>

#include "host/vulkan_host.h"

/// Granite with a render graph of a G-buffer, walr's passes and a back buffer. Granite takes Vulkan's functions from
/// volk, so that nothing else of it is to be seen here.
namespace granite_host {

class Engine {
 public:
  /// @param host whose instance and device Granite takes over for as long as this lives
  explicit Engine(Host& host);
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// Make a graph for the passes, in place of the one before.
  void build(const WalrApi& api, WalrPasses passes, const WalrPassList& list, std::uint32_t width,
             std::uint32_t height);
  /// Drop the graph, once the GPU has finished.
  void drop();

  /// Where the graph has put a pass of walr's.
  [[nodiscard]] unsigned position(const std::string& pass) const;

  /// Run a frame, and do not wait for it.
  /// @param inputs texels by channel, in the order of lighting, depth, normal, motion, albedo
  void frame(const WalrPassFrame& frame, const std::vector<std::vector<float>>& inputs, bool reset);
  /// @param barrier whether to wait for what was drawn, as one must
  /// @returns the back buffer, four halves a pixel
  std::vector<std::uint16_t> read(bool barrier = true);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace granite_host
