#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "framegraph/declare/graph.h"
#include "framegraph/vulkan/shared_objects.h"
#include "framegraph/vulkan/timestamps.h"
#include "integration/denoise_graph.h"
#include "passes/methods/denoiser.h"
#include "samples/denoise/frame_output.h"
#include "samples/denoise/gpu_device.h"
#include "samples/denoise/packed_frame.h"
#include "samples/sequence/layout.h"

namespace walr {

/// The output of a method for one frame.
struct DenoisedPicture {
  std::vector<Image> lights;  ///< 3 components: denoised demodulated diffuse radiance of each light that was submitted.
  /// Times of the passes from GPU timestamps, in the order of execution; empty if the queue has no timestamps.
  std::vector<fg::vk::PassTime> passes;
  std::vector<ViewPicture> views;
  std::vector<CounterValue> counters;
  LightSlopes slopes;

  /// Time of all passes, without the copies to and from the device; nullopt without timestamps.
  [[nodiscard]] std::optional<double> milliseconds() const;
};

/// Noisy light of a frame, a texel each pixel or group of pixels.
using LightTexels = std::span<const Rgba16>;

/// Images that frames may have or not.
struct OptionalImages {
  bool objectIds = false;       ///< `Frame::objectId`.
  bool specularMotion = false;  ///< `Frame::specularMotion`; of specular light only.
};

/// Those that the frames of a layout have.
OptionalImages optionalImages(const RecognizedLayout& layout);

/// Runs a method on a Vulkan device, frame after frame: uploads the inputs, runs the passes, reads back the result, all
/// in one frame graph that is compiled once. Several denoisers may exist on one device; only one may run at a time.
///
/// Call `run` for each frame, or keep a few frames in flight:
///
///     if (denoiser.full()) use(*denoiser.finish());
///     denoiser.submit(std::move(frame));
///     ...
///     while (auto last = denoiser.finish()) use(*last);
class GpuDenoiser {
 public:
  /// @param device  must outlive this
  /// @param methods one for each light, which share the guides of the first. They declare their passes during this
  ///                call and are not needed afterwards
  /// @param layout  conventions of the frames; must outlive this
  /// @param wanted  views, counters and light direction to read back with every frame
  /// @param framesInFlight  largest number of frames on the device at once, at least 1
  /// @param given  what all frames have
  /// @param shared  what this denoiser shares with others on the device; see `fg::vk::SharedObjects` for the order of
  ///                their frames
  /// @throws fg::vk::Error if the device lacks something that the graph needs
  /// @throws std::invalid_argument naming a setting of the method that is out of range, or a view that does not exist,
  ///         or saying why lights cannot share guides
  GpuDenoiser(const GpuDevice& device, std::span<Denoiser* const> methods, fg::Extent extent, const Layout& layout,
              const InspectionWish& wanted = {}, std::uint32_t framesInFlight = 1, const OptionalImages& given = {},
              const fg::vk::Membership& shared = {});
  /// The same for one light.
  GpuDenoiser(const GpuDevice& device, Denoiser& method, fg::Extent extent, const Layout& layout,
              const InspectionWish& wanted = {}, std::uint32_t framesInFlight = 1, const OptionalImages& given = {},
              const fg::vk::Membership& shared = {});
  ~GpuDenoiser();
  GpuDenoiser(GpuDenoiser&&) noexcept;
  GpuDenoiser& operator=(GpuDenoiser&&) noexcept;

  /// Submit the next frame to the device. If the frame requests it, histories are reset first.
  /// @throws std::logic_error if `framesInFlight` frames are in flight already; InputError naming a frame whose camera
  ///         is not usable; fg::vk::Error when the device fails
  /// @param further the lights beside the frame's own; `finish` returns the first of them as the frame's direct light
  void submit(PackedFrame packed, std::span<const LightTexels> further = {});
  /// Whether `finish` must come before the next `submit`.
  [[nodiscard]] bool full() const;
  /// Wait for the oldest frame in flight only. Returns nullopt if there is none.
  /// @throws fg::vk::Error when the device fails
  std::optional<DenoisedFrame> finish();

  /// Submit the next frame with `lighting` in place of its own. The frame remains the caller's, so that only a picture
  /// comes back: call `finishPicture`, not `finish`.
  /// @throws as `submit`
  void submitLight(const PackedFrame& packed, const std::vector<Rgba16>& lighting);
  /// The same with the albedo and the roughness that belong to the light, too.
  void submitLight(const PackedFrame& packed, const PackedLight& light);
  /// Wait for the oldest frame in flight, which must exist.
  /// @throws fg::vk::Error when the device fails
  DenoisedPicture finishPicture();

  /// Denoise the next frame and wait for it. No other frame may be in flight.
  /// @throws as `submit`
  DenoisedPicture run(const PackedFrame& packed);
  /// The same; also returns the frame itself.
  DenoisedFrame denoise(PackedFrame packed);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace walr
