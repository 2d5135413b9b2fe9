#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framegraph/graph.h"
#include "framegraph/vulkan/messages.h"
#include "passes/denoiser.h"
#include "samples/denoise/frame_output.h"
#include "samples/denoise/packed_frame.h"
#include "samples/sequence/layout.h"

namespace walr {

/// Runs a method on a Vulkan device of its own, frame after frame: textures go up, the passes run, the result comes
/// back. All of it is one frame graph, compiled once.
class GpuDenoiser {
 public:
  struct Options {
    std::string device;       ///< Number or part of a name; empty for the most capable one.
    bool validation = false;  ///< Run under the Khronos validation layer with synchronization validation.
  };

  /// @param method  declares its passes here; not needed afterwards
  /// @param layout  how the frames differ from the project's conventions
  /// @throws fg::vk::Error where there is no device, or none that will do
  /// @throws std::invalid_argument naming a setting of the method that is out of range
  GpuDenoiser(const Options& options, Denoiser& method, fg::Extent extent, const Layout& layout);
  ~GpuDenoiser();
  GpuDenoiser(const GpuDenoiser&) = delete;
  GpuDenoiser& operator=(const GpuDenoiser&) = delete;

  [[nodiscard]] const std::string& deviceName() const;
  /// Driver and its version.
  [[nodiscard]] const std::string& driver() const;
  /// Whether the device is a processor that plays a GPU.
  [[nodiscard]] bool isSoftware() const;

  /// Denoise the next frame. Its history is dropped first where the frame says so.
  /// @throws InputError naming a frame whose camera makes no sense; fg::vk::Error when the device fails
  DenoisedFrame denoise(PackedFrame packed);

  /// What the validation layer said since the last call.
  std::vector<fg::vk::Message> takeMessages();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace walr
