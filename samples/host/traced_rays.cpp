#include "samples/host/traced_rays.h"

#include <array>
#include <cstdio>

namespace walr::host {

TracedRays& TracedRays::operator+=(const TracedRays& other) {
  rays += other.rays;
  seconds += other.seconds;
  return *this;
}

std::optional<double> TracedRays::perSecond() const {
  if (!(seconds > 0.0)) return std::nullopt;
  return static_cast<double>(rays) / seconds;
}

std::string rateText(const TracedRays& traced) {
  const std::optional<double> rate = traced.perSecond();
  if (!rate) return "no times";
  constexpr double kMillion = 1e6;
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), "%.3g million rays/s", *rate / kMillion);
  return text.data();
}

}  // namespace walr::host
