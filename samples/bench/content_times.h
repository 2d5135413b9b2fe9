#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "samples/bench/timing.h"
#include "samples/bench/variant.h"
#include "samples/denoise/gpu_device.h"
#include "samples/denoise/packed_frame.h"

namespace walr {

/// A kind of image content that may make a method faster or slower.
struct Content {
  std::string_view name;
  std::string_view description;
  /// Makes a frame of a size; `frame` is its number.
  PackedFrame (*frame)(fg::Extent extent, int frame);
};

/// All contents. Times are relative to those of the first one.
std::span<const Content> contents();

/// Times of one variant by content.
struct ContentTimes {
  std::string variant;
  std::vector<Timing> timings;  ///< In the order of `contents`; ratios are to the first content in the same repetition.
};

/// Image size at which `walr bench` compares contents.
inline constexpr fg::Extent kContentExtent{640, 360};

/// Time each variant on all contents in alternation, after one repetition that warms up.
/// @param frameDone  called after each frame of all contents
/// @throws fg::vk::Error when the device fails
std::vector<ContentTimes> contentTimes(const GpuDevice& device, std::span<const Variant> variants, fg::Extent extent,
                                       std::size_t repetitions, const std::function<void()>& frameDone);

}  // namespace walr
