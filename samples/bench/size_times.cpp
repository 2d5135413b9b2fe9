#include "samples/bench/size_times.h"

#include <array>
#include <optional>
#include <stdexcept>

#include "framegraph/vulkan/error.h"
#include "samples/bench/response_scene.h"

namespace walr {
namespace {

/// One variant on its way.
struct Lane {
  SizeTiming* result;
  GpuDenoiser denoiser;
  FrameTimes times;
};

std::optional<GpuDenoiser> tryToMake(const GpuDevice& device, const Variant& variant, fg::Extent extent,
                                     std::string& whyNot) {
  try {
    return GpuDenoiser(device, *makeVariant(variant), extent, projectLayout());
  } catch (const std::invalid_argument& error) {
    whyNot = error.what();
  } catch (const fg::vk::Error& error) {
    whyNot = error.what();
  }
  return std::nullopt;
}

}  // namespace

SizeTimes sizeTimes(const GpuDevice& device, std::span<const Variant> variants, fg::Extent extent,
                    std::size_t repetitions, const std::function<void()>& frameDone) {
  SizeTimes sized{extent, std::vector<SizeTiming>(variants.size())};
  std::vector<Lane> lanes;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    SizeTiming& result = sized.timings[i];
    result.variant = variants[i].name;
    if (i > 0 && lanes.empty()) {
      result.whyNot = variants.front().name + ", which times are ratios to, does not run at this size";
      continue;
    }
    if (auto denoiser = tryToMake(device, variants[i], extent, result.whyNot)) {
      lanes.push_back({&result, std::move(*denoiser), {}});
    }
  }
  const std::array frames = {slabFrame(extent, 8).packed, slabFrame(extent, 9).packed};
  for (std::size_t i = 0; i < kFramesPerSize * (1 + repetitions); ++i) {
    for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
      Lane& now = lanes[(i + lane) % lanes.size()];
      const DenoisedPicture picture = now.denoiser.run(frames[i % frames.size()]);
      if (i >= kFramesPerSize) now.times.add(picture);
    }
    frameDone();
  }
  for (Lane& lane : lanes) lane.result->timing = lane.times.timing(lanes.front().times);
  return sized;
}

}  // namespace walr
