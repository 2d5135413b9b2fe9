#include "samples/bench/size_times.h"

#include <array>
#include <optional>
#include <stdexcept>

#include "framegraph/vulkan/error.h"
#include "samples/bench/response_scene.h"

namespace walr {
namespace {

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
  const std::array frames = {slabFrame(extent, 8).packed, slabFrame(extent, 9).packed};
  std::vector<TimedLane> lanes;
  std::vector<SizeTiming*> results;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    SizeTiming& result = sized.timings[i];
    result.variant = variants[i].name;
    if (i > 0 && lanes.empty()) {
      result.whyNot = variants.front().name + ", the baseline of time ratios, does not run at this size";
      continue;
    }
    if (auto denoiser = tryToMake(device, variants[i], extent, result.whyNot)) {
      lanes.push_back({std::move(*denoiser), &frames});
      results.push_back(&result);
    }
  }
  timeBeside(lanes, repetitions, frameDone);
  for (std::size_t i = 0; i < lanes.size(); ++i) results[i]->timing = lanes[i].times.timing(lanes.front().times);
  return sized;
}

}  // namespace walr
