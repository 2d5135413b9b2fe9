#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "framegraph/graph.h"
#include "framegraph/vulkan/timestamps.h"
#include "integration/denoise_graph.h"
#include "passes/denoiser.h"
#include "samples/denoise/frame_output.h"
#include "samples/denoise/gpu_device.h"
#include "samples/denoise/packed_frame.h"
#include "samples/sequence/layout.h"

namespace walr {

/// What a method made of a frame.
struct DenoisedPicture {
  Image indirect;  ///< 3 components: denoised demodulated diffuse indirect radiance.
  /// Times by GPU timestamps, in the order of execution; empty where the queue has none.
  std::vector<fg::vk::PassTime> passes;
  std::vector<ViewPicture> views;
  std::vector<CounterValue> counters;

  /// Time of all passes; the copies to and from the device are not among them.
  [[nodiscard]] std::optional<double> milliseconds() const;
};

/// Runs a method on a Vulkan device, frame after frame: textures go up, the passes run, the result comes back. All of
/// it is one frame graph, compiled once. Several may live on one device, one running at a time.
class GpuDenoiser {
 public:
  /// @param device  must outlive this
  /// @param method  declares its passes here; not needed afterwards
  /// @param layout  how the frames differ from the project's conventions; must outlive this
  /// @param wanted  views of the method, and whether its counters, to read back with every frame
  /// @throws fg::vk::Error where the device will not do
  /// @throws std::invalid_argument naming a setting of the method that is out of range, or a view that there is not
  GpuDenoiser(const GpuDevice& device, Denoiser& method, fg::Extent extent, const Layout& layout,
              const InspectionWish& wanted = {});
  ~GpuDenoiser();
  GpuDenoiser(GpuDenoiser&&) noexcept;
  GpuDenoiser& operator=(GpuDenoiser&&) noexcept;

  /// Denoise the next frame. Its history is dropped first where the frame says so.
  /// @throws InputError naming a frame whose camera makes no sense; fg::vk::Error when the device fails
  DenoisedPicture run(const PackedFrame& packed);
  /// The same, with the frame kept beside its result.
  DenoisedFrame denoise(PackedFrame packed);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace walr
