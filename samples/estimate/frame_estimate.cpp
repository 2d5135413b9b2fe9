#include "samples/estimate/frame_estimate.h"

namespace walr {

void FrameEstimate::add(std::uint32_t batch, const std::optional<Bounds>& bounds) {
  const auto [known, isFirst] = batches_.emplace(batch, bounds);
  if (isFirst) return;
  std::optional<Bounds>& sum = known->second;
  sum = sum && bounds ? std::optional(sideBySide(*sum, *bounds)) : std::nullopt;
}

std::optional<double> FrameEstimate::microseconds() const {
  double sum = 0.0;
  for (const auto& [batch, bounds] : batches_) {
    if (!bounds) return std::nullopt;
    sum += bounds->largest();
  }
  return sum;
}

}  // namespace walr
