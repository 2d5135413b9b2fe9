#include "samples/bench/content_times.h"

#include <array>

#include "samples/bench/response_scene.h"

namespace walr {
namespace {

constexpr float kFenceDepth = 0.5F;
constexpr int kFencePeriod = 8;

void clear(Image& image, std::size_t pixel, float value = 0.0F) {
  for (float& component : image.pixel(pixel)) component = value;
}

/// A frame whose upper rows show sky.
PackedFrame underSky(fg::Extent extent, int number, double share) {
  Frame frame = slabFrame(extent, number).packed.frame;
  const auto rows = static_cast<std::size_t>(share * extent.height);
  for (std::size_t i = 0; i < rows * extent.width; ++i) {
    for (Image* image : {&frame.indirect, &frame.albedo, &frame.normal, &frame.motion}) clear(*image, i);
    clear(frame.depth, i, kBackgroundDepth);
  }
  return packFrame(std::move(frame));
}

PackedFrame behindFence(fg::Extent extent, int number) {
  Frame frame = slabFrame(extent, number).packed.frame;
  for (int y = 0; y < frame.depth.height(); ++y) {
    for (int x = 0; x < frame.depth.width(); ++x) {
      if (x % kFencePeriod == 0 || y % kFencePeriod == 0) frame.depth.at(x, y, 0) *= kFenceDepth;
    }
  }
  return packFrame(std::move(frame));
}

PackedFrame dark(fg::Extent extent, int number) {
  Frame frame = slabFrame(extent, number).packed.frame;
  for (std::size_t i = 0; i < frame.indirect.pixelCount(); ++i) clear(frame.indirect, i);
  return packFrame(std::move(frame));
}

/// A frame at one of two distances. Consecutive frames differ by a factor of 3 in depth, so that no history is
/// accepted.
PackedFrame afterCut(fg::Extent extent, int number) {
  Frame frame = slabFrame(extent, number).packed.frame;
  const float scale = number % 2 == 0 ? 1.0F : 3.0F;
  for (std::size_t i = 0; i < frame.depth.pixelCount(); ++i) frame.depth.pixel(i)[0] *= scale;
  return packFrame(std::move(frame));
}

constexpr std::array kContents = {
    Content{"wall", "a wall and a slab that moves in front of it",
            [](fg::Extent extent, int frame) { return slabFrame(extent, frame).packed; }},
    Content{"fence", "the same with bars of one pixel, eight pixels apart, in front of it", behindFence},
    Content{"cuts", "wall and slab three times as far away in every second frame, so that no history is accepted",
            afterCut},
    Content{"dark", "wall and slab without light", dark},
    Content{"half sky", "wall and slab with sky in the upper half",
            [](fg::Extent extent, int frame) { return underSky(extent, frame, 0.5); }},
    Content{"mostly sky", "sky except in the lowest tenth",
            [](fg::Extent extent, int frame) { return underSky(extent, frame, 0.9); }},
    Content{"sky", "sky only", [](fg::Extent extent, int frame) { return underSky(extent, frame, 1.0); }},
};

}  // namespace

std::span<const Content> contents() {
  return kContents;
}

std::vector<ContentTimes> contentTimes(const GpuDevice& device, std::span<const Variant> variants, fg::Extent extent,
                                       std::size_t repetitions, const std::function<void()>& frameDone) {
  std::vector<std::array<PackedFrame, 2>> frames;
  for (const Content& content : kContents) frames.push_back({content.frame(extent, 8), content.frame(extent, 9)});
  std::vector<ContentTimes> all;
  for (const Variant& variant : variants) {
    std::vector<TimedLane> lanes;
    for (const auto& pair : frames) {
      lanes.push_back({GpuDenoiser(device, *makeVariant(variant), extent, projectLayout()), &pair});
    }
    timeBeside(lanes, repetitions, frameDone);
    ContentTimes& times = all.emplace_back();
    times.variant = variant.name;
    for (const TimedLane& lane : lanes) times.timings.push_back(lane.times.timing(lanes.front().times));
  }
  return all;
}

}  // namespace walr
