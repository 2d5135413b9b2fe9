#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "framegraph/declare/graph.h"
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
  std::vector<std::uint32_t> lint;  ///< Words of `addLintInputs`, where `InspectionWish::lint` asks for them.

  /// Time of all passes; the copies to and from the device are not among them.
  [[nodiscard]] std::optional<double> milliseconds() const;
};

/// Runs a method on a Vulkan device, frame after frame: textures go up, the passes run, the result comes back. All of
/// it is one frame graph, compiled once. Several may live on one device, one running at a time.
///
/// Either frame by frame with `run`, or with a few frames on the device at once:
///
///     if (denoiser.full()) use(*denoiser.finish());
///     denoiser.submit(std::move(frame));
///     ...
///     while (auto last = denoiser.finish()) use(*last);
class GpuDenoiser {
 public:
  /// @param device  must outlive this
  /// @param method  declares its passes here; not needed afterwards
  /// @param layout  how the frames differ from the project's conventions; must outlive this
  /// @param wanted  views of the method, and whether its counters, to read back with every frame
  /// @param framesInFlight  frames that may be on the device at once, at least 1
  /// @param objectIds  whether all frames have object numbers
  /// @throws fg::vk::Error where the device will not do
  /// @throws std::invalid_argument naming a setting of the method that is out of range, or a view that there is not
  GpuDenoiser(const GpuDevice& device, Denoiser& method, fg::Extent extent, const Layout& layout,
              const InspectionWish& wanted = {}, std::uint32_t framesInFlight = 1, bool objectIds = false);
  ~GpuDenoiser();
  GpuDenoiser(GpuDenoiser&&) noexcept;
  GpuDenoiser& operator=(GpuDenoiser&&) noexcept;

  /// Send the next frame to the device. Its history is dropped first where the frame says so.
  /// @throws std::logic_error when as many frames as may be are in flight; InputError naming a frame whose camera makes
  ///         no sense; fg::vk::Error when the device fails
  void submit(PackedFrame packed);
  /// Whether `finish` must come before the next `submit`.
  [[nodiscard]] bool full() const;
  /// Wait for the oldest frame in flight, and for none after it. Nothing where there is none.
  /// @throws fg::vk::Error when the device fails
  std::optional<DenoisedFrame> finish();

  /// Denoise the next frame and wait for it, with no other in flight.
  /// @throws as `submit`
  DenoisedPicture run(const PackedFrame& packed);
  /// The same, with the frame kept beside its result.
  DenoisedFrame denoise(PackedFrame packed);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace walr
