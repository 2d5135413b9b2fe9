#include "samples/bench/frame_errors.h"

#include <algorithm>

#include "samples/denoise/report.h"

namespace walr {

namespace {

/// Mean of a figure over the frames that have it.
template <typename Figure>
std::optional<double> meanOver(const std::vector<FrameErrors>& frames, Figure figureOf) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const FrameErrors& frame : frames) {
    const std::optional<double>& figure = figureOf(frame);
    sum += figure.value_or(0.0);
    count += figure.has_value() ? 1 : 0;
  }
  return count > 0 ? std::optional(sum / static_cast<double>(count)) : std::nullopt;
}

}  // namespace

std::optional<double> meanOf(const std::vector<FrameErrors>& frames, const Metric& metric) {
  return meanOver(
      frames, [&](const FrameErrors& frame) -> const auto& { return frame.*metric.figure; });
}

FiguresByRoughness meanByRoughness(const std::vector<FrameErrors>& frames) {
  FiguresByRoughness means;
  for (std::size_t i = 0; i < means.size(); ++i) {
    means.at(i) = meanOver(
        frames, [&](const FrameErrors& frame) -> const auto& { return frame.byRoughness.at(i); });
  }
  return means;
}

std::optional<double> worstOf(const std::vector<FrameErrors>& frames, const Metric& metric) {
  std::optional<double> worst;
  for (const FrameErrors& frame : frames) {
    const std::optional<double>& figure = frame.*metric.figure;
    if (!figure || metric.better == Metric::Better::AsReference) continue;
    const bool lower = metric.better == Metric::Better::Lower;
    worst = !worst ? *figure : (lower ? std::max(*worst, *figure) : std::min(*worst, *figure));
  }
  return worst;
}

std::vector<FrameErrors> afterWarmUp(const std::vector<FrameErrors>& frames) {
  const std::size_t skipped = frames.size() > kWarmUpFrames ? kWarmUpFrames : 0;
  return {frames.begin() + static_cast<std::ptrdiff_t>(skipped), frames.end()};
}

}  // namespace walr
