#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "framegraph/vulkan/shared_objects.h"
#include "passes/methods/denoiser.h"
#include "samples/denoise/frame_output.h"
#include "samples/denoise/gpu_denoiser.h"
#include "samples/denoise/packed_frame.h"

namespace walr {

/// A light with the method that denoises it.
struct LightMethod {
  Light light = Light::Indirect;
  std::unique_ptr<Denoiser> method;
};

/// A frame on its way to `LightDenoisers`.
struct PackedLights {
  PackedFrame packed;
  std::vector<Rgba16> direct;           ///< Direct light, if it is denoised beside the indirect light.
  std::optional<PackedLight> specular;  ///< Specular light, if it is denoised beside the others.
};

/// Denoises lights of frames. Indirect and direct light share the guides, which one `GpuDenoiser` prepares once. A
/// method without guides has a `GpuDenoiser` for each light, and so has specular light, whose lobe is another one; they
/// share pipelines and the memory of transients. The pictures are the same. The order of calls is that of
/// `GpuDenoiser`.
class LightDenoisers {
 public:
  /// For errors and for the other parameters see `GpuDenoiser`.
  /// @param lights  the lights to denoise, in the order of `Light`: one, or the indirect and the direct light, or all.
  ///                The views and counters are those of the first. Where specular light comes alone, `layout` says so
  LightDenoisers(const GpuDevice& device, std::span<const LightMethod> lights, fg::Extent extent, const Layout& layout,
                 const InspectionWish& wanted, std::uint32_t framesInFlight, const OptionalImages& given);

  /// Convert a frame, which must have the lights. Any thread may call it.
  [[nodiscard]] PackedLights pack(Frame frame) const;
  /// Submit the next frame.
  void submit(PackedLights frame);
  [[nodiscard]] bool full() const { return first_.full(); }
  /// Wait for the oldest frame in flight only. Returns nullopt if there is none.
  std::optional<DenoisedFrame> finish();

 private:
  fg::vk::Membership member();

  std::shared_ptr<fg::vk::SharedObjects> shared_;
  Light light_;    // The first.
  bool together_;  // `first_` denoises the direct light, too.
  GpuDenoiser first_;
  std::optional<GpuDenoiser> direct_;  // Where direct light comes second and is denoised by itself.
  std::unique_ptr<Layout> specularLayout_;
  std::optional<GpuDenoiser> specular_;  // Where specular light comes third.
};

}  // namespace walr
