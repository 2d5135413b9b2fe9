#pragma once

#include <vector>

#include "framegraph/declare/graph.h"

namespace walr::host {

/// Chooses the size of the picture so that a frame takes a wanted time: if the median of eight frames is above the
/// target or below 80 % of it, the number of pixels changes by the factor that leads to 90 %, and the sides stay
/// between half and all of the full size. Within that band the size stays, so that it does not change all the time.
class ResolutionControl {
 public:
  /// @param full  the largest size
  explicit ResolutionControl(fg::Extent full);

  /// Time that a frame shall take, milliseconds; 0: any, and pictures have the full size.
  void setTarget(double milliseconds);
  [[nodiscard]] double target() const { return target_; }
  /// To be called for every frame.
  /// @param milliseconds  time that a frame of `extent` took
  void frameTook(double milliseconds);
  /// Size of the next frame.
  [[nodiscard]] fg::Extent extent() const { return extent_; }

 private:
  void change(fg::Extent extent);

  fg::Extent full_;
  fg::Extent extent_;
  double target_ = 0.0;
  std::vector<double> times_;  // Of the frames since the last change that count.
  int settling_ = 0;           // Frames to come that do not count.
};

}  // namespace walr::host
