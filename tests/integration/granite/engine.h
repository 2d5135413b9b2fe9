#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <walr/walr_plugin.h>

#include "host/vulkan_host.h"

/// Granite with a render graph of a G-buffer, walr's passes and a back buffer. Granite gets Vulkan's functions from
/// volk, so this header must not include any of its headers.
namespace granite_host {

class Engine {
 public:
  /// @param host Granite uses its instance and device; must outlive this object
  explicit Engine(Host& host);
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// Create a graph for the passes and replace the one before. The back buffer shows the result, and below it the
  /// history lengths, if the passes write them.
  void build(const WalrApi& api, WalrPasses passes, const WalrPassList& list, std::uint32_t width,
             std::uint32_t height);
  /// Wait for the GPU and destroy the graph.
  void drop();

  /// Position of one of walr's passes in the baked graph.
  [[nodiscard]] unsigned position(const std::string& pass) const;

  /// Run a frame without waiting for it.
  /// @param inputs texels of the images that the passes read, by name
  void frame(const WalrPassFrame& frame, const std::map<std::string, std::vector<float>>& inputs, bool reset);
  /// @param barrier whether to record the required barrier after drawing
  /// @returns the back buffer as 16-bit words
  std::vector<std::uint16_t> read(bool barrier = true);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace granite_host
