#include "samples/host/resolution_control.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace walr::host {
namespace {

constexpr std::size_t kFrames = 8;
constexpr double kLeast = 0.8;        // Of the target.
constexpr double kAim = 0.9;          // Of the target.
constexpr double kLeastShare = 0.25;  // Of the pixels: half of each side.
// Frames in flight still have the old size, and the first frames of a size make their graph.
constexpr int kSettling = 4;

fg::Extent scaled(fg::Extent full, double share) {
  const double side = std::sqrt(share);
  const auto length = [&](std::uint32_t whole) {
    return std::max(1U, static_cast<std::uint32_t>(std::lround(side * whole)));
  };
  return {length(full.width), length(full.height)};
}

}  // namespace

ResolutionControl::ResolutionControl(fg::Extent full) : full_(full), extent_(full) {}

void ResolutionControl::setTarget(double milliseconds) {
  if (milliseconds == target_) return;
  target_ = milliseconds;
  times_.clear();
  if (!(target_ > 0.0)) change(full_);
}

void ResolutionControl::frameTook(double milliseconds) {
  if (!(target_ > 0.0) || !(milliseconds > 0.0)) return;
  if (settling_ > 0) {
    --settling_;
    return;
  }
  times_.push_back(milliseconds);
  if (times_.size() < kFrames) return;
  const auto middle = times_.begin() + kFrames / 2;
  std::ranges::nth_element(times_, middle);
  const double median = *middle;
  times_.clear();
  if (median <= target_ && median >= kLeast * target_) return;
  const double pixels = static_cast<double>(extent_.width) * extent_.height;
  const double all = static_cast<double>(full_.width) * full_.height;
  change(scaled(full_, std::clamp(pixels / all * kAim * target_ / median, kLeastShare, 1.0)));
}

void ResolutionControl::change(fg::Extent extent) {
  if (extent == extent_) return;
  extent_ = extent;
  settling_ = kSettling;
}

}  // namespace walr::host
